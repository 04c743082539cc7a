"""Expressions of time in a scene, "0.1 mm * sin(2 pi t / 1 s) * ramp(t / 4 s)": read by a small grammar, never run.

A number may carry a unit of length, time or angle, which binds it first: `t / 4 s` is t over four seconds. Factors side
by side are multiplied. Units are checked like those of any other key.
"""

import re
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from masonry.quantity import GRAVITY, convert

LONGEST, DEEPEST = 400, 20
"""Characters of an expression, and parentheses within each other, at most."""
LOOKS = 20_001
"""Times at which an expression is looked at before it is used."""
UNITS = {"length": (1, 0), "time": (0, 1), "angle": (0, 0)}
"""Kinds of quantities that may occur: powers of length and time."""
MOTIONS = {"displacement": (1, 0), "velocity": (1, -1), "acceleration": (1, -2)}
RESULTS = {"length": (1, 0), **MOTIONS}
"""Kinds that a whole expression may be of besides a plain number; those of a motion of the ground."""
WORDS = {
    **{(1, 0): "a length", (0, 1): "a time", (0, 0): "a plain number"},
    **{(1, -1): "a velocity", (1, -2): "an acceleration"},
}
ALLOWED = "allowed: numbers with units, t, pi, sin, cos, ramp, triangle, + - * / and parentheses"
_NUMBER = r"(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3}(?![A-Za-z]))?"
_NAME = re.compile("[A-Za-zµμ°]+")
_TOKEN = re.compile(rf"\s*({_NUMBER}|{_NAME.pattern}|[-+*/()])", re.ASCII)
Values = np.ndarray


class Term(NamedTuple):
    """Part of an expression: powers of length and time, and its values (SI) at times (s)."""

    powers: tuple[int, int]
    at: Callable[[Values], Values]


def ramp(x: Values) -> Values:
    """From 0 at x = 0 straight to 1 at x = 1, and constant outside."""
    return np.clip(x, 0.0, 1.0)


def triangle(x: Values) -> Values:
    """As the sine, with straight lines between its peaks: period 2 pi, 1 at pi / 2."""
    return 1.0 - 2.0 * np.abs((x / np.pi + 0.5) % 2.0 - 1.0)


FUNCTIONS: dict[str, Callable[[Values], Values]] = {"sin": np.sin, "cos": np.cos, "ramp": ramp, "triangle": triangle}
NAMES = {"t": Term((0, 1), lambda t: t), "pi": Term((0, 0), lambda t: np.full_like(t, np.pi))}
GRAVITY_ALONE = {"g": Term((1, -2), lambda t: np.full_like(t, float(GRAVITY)))}


def read(text: str, kind: str) -> Callable[[Values], Values]:
    """The values (SI) at times (n,) s of an expression; ValueError says what is wrong.

    kind  "number" or one of RESULTS; in a motion of the ground, g is the acceleration of gravity
    """
    if len(text) > LONGEST:
        raise ValueError(f"an expression of {len(text)} characters; at most {LONGEST} are allowed")
    reader = _Reader(text, NAMES | GRAVITY_ALONE if kind in MOTIONS else NAMES)
    term = reader.sum()
    reader.end()
    wanted = RESULTS.get(kind, (0, 0))
    if term.powers != wanted:
        is_a = WORDS.get(term.powers, f"in m^{term.powers[0]} s^{term.powers[1]}")
        raise ValueError(f"the expression is {is_a}, and must be {WORDS[wanted]}")
    return term.at


def require_finite(at: Callable[[Values], Values], duration: float) -> Values:
    """The values at LOOKS times from 0 to `duration` (s); ValueError where one of them is not finite."""
    with np.errstate(all="ignore"):
        values = at(np.linspace(0.0, duration, LOOKS))
    if not (finite := np.isfinite(values)).all():
        when = duration * int(np.argmin(finite)) / (LOOKS - 1)
        raise ValueError(f"the expression has no finite value at t = {when:g} s")
    return values


class _Reader:
    """Walks over the tokens of an expression; one method a level of the grammar."""

    def __init__(self, text: str, names: dict[str, Term]) -> None:
        self.text, self.names, self.tokens, self.k, self.depth = text, names, [], 0, 0
        place = 0
        while rest := text[place:].strip():
            match = _TOKEN.match(text, place)
            if match is None:
                raise ValueError(f"'{rest[0]}' before '{rest[1:][:20]}' has no meaning here; {ALLOWED}")
            self.tokens.append((match[1], match.start(1)))
            place = match.end()
        self.tokens.append(("", len(text)))

    @property
    def word(self) -> str:
        return self.tokens[self.k][0]

    def fail(self, why: str) -> ValueError:
        place = self.tokens[self.k][1]
        return ValueError(f"at character {place + 1}, '{self.text[place : place + 20] or 'the end'}': {why}")

    def take(self, words: str) -> str:
        """The next token if it is one of these signs, else nothing."""
        word = self.word
        if not word or word not in words:
            return ""
        self.k += 1
        return word

    def end(self) -> None:
        """Nothing may be left."""
        if self.word:
            raise self.fail("expected the end, or + - * /")

    def sum(self) -> Term:
        """Products with + and - between them."""
        left = self.product()
        while sign := self.take("+-"):
            right = self.product()
            if left.powers != right.powers:
                units = " and ".join(WORDS.get(term.powers, "another unit") for term in (left, right))
                raise self.fail(f"{units} cannot be added before here")
            left = _added(left, right, 1.0 if sign == "+" else -1.0)
        return left

    def product(self) -> Term:
        """Factors with *, / or nothing between them, from left to right."""
        left, divided = self.signed(), False
        while True:
            if sign := self.take("*/"):
                left, divided = _multiplied(left, self.signed(), -1 if sign == "/" else 1), sign == "/"
            elif self.word and self.word not in "+-)":
                if divided:
                    raise self.fail("after a division write * or parentheses")
                left = _multiplied(left, self.factor(), 1)
            else:
                return left

    def signed(self) -> Term:
        """A factor behind any number of signs."""
        sign = 1.0
        while word := self.take("+-"):
            sign = -sign if word == "-" else sign
        factor = self.factor()
        return factor if sign > 0.0 else Term(factor.powers, lambda t: -factor.at(t))

    def factor(self) -> Term:
        """A number with or without a unit, a unit alone, t, pi, a function, or something in parentheses."""
        word = self.word
        if word[:1].isdigit() or word[:1] == ".":
            self.k += 1
            unit = self.word
            if _NAME.match(unit) and unit not in self.names and unit not in FUNCTIONS:
                return self.quantity(word)
            return _constant((0, 0), float(word))
        if word in self.names:
            self.k += 1
            return self.names[word]
        if word in FUNCTIONS:
            self.k += 1
            return self.call(word)
        if word == "(":
            return self.inner()
        if _NAME.match(word):
            return self.quantity("1")
        raise self.fail(f"expected a number or a name; {ALLOWED}")

    def inner(self) -> Term:
        """Term in parentheses."""
        if not self.take("("):
            raise self.fail("expected '('")
        self.depth += 1
        if self.depth > DEEPEST:
            raise self.fail(f"more than {DEEPEST} parentheses within each other")
        term = self.sum()
        if not self.take(")"):
            raise self.fail("expected ')', or + - * /")
        self.depth -= 1
        return term

    def call(self, name: str) -> Term:
        """A function of a plain number."""
        inside = self.inner()
        if inside.powers != (0, 0):
            raise self.fail(f"{name}(...) before here takes a plain number; divide by a time, as in t / 1 s")
        function = FUNCTIONS[name]
        return Term((0, 0), lambda t: function(inside.at(t)))

    def quantity(self, number: str) -> Term:
        """A number and the unit that is next."""
        for kind, powers in UNITS.items():
            try:
                value = convert(f"{number} {self.word}", kind, "a number of a history")
            except ValueError as error:
                if "is no known unit" in str(error):
                    raise self.fail(f"{str(error).rsplit('; ', 1)[0]}, or name; {ALLOWED}") from None
                continue
            self.k += 1
            return _constant(powers, value)
        raise self.fail("only units of length, time and angle have a place in a history")


def _constant(powers: tuple[int, int], value: float) -> Term:
    return Term(powers, lambda t: np.full_like(t, value))


def _added(left: Term, right: Term, sign: float) -> Term:
    return Term(left.powers, lambda t: left.at(t) + sign * right.at(t))


def _multiplied(left: Term, right: Term, sign: int) -> Term:
    powers = left.powers[0] + sign * right.powers[0], left.powers[1] + sign * right.powers[1]
    if sign > 0:
        return Term(powers, lambda t: left.at(t) * right.at(t))
    return Term(powers, lambda t: left.at(t) / right.at(t))
