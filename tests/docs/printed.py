"""Whether a page shows what its commands print: word by word, numbers to a thousandth, times not at all."""

import re

CLOSE = 2e-3
"""How far a number on a page may be off what is printed here, as a share; processors differ by less."""
NOTHING = 1e-9
"""Numbers below it are rounding, and as good as each other."""
CLOCK = ("s", "ms", "min", "GB")
"""Units of what differs from run to run."""
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?")


def not_printed(text: str, output: str) -> list[str]:
    """The lines of a text that the output lacks; `...` stands for any lines."""
    printed = [_parts(line) for line in output.splitlines()]
    lines = [line for line in text.splitlines() if line.strip() not in ("", "...")]
    return [line.strip() for line in lines if not any(_alike(_parts(line), other) for other in printed)]


def _parts(line: str) -> tuple[list[str], list[float]]:
    """The words around the numbers of a line, and its numbers; those before a unit of time are none."""
    words = _NUMBER.sub("#", line).split()
    numbers = [float(number) for number in _NUMBER.findall(line)]
    clock = [
        n
        for n, place in enumerate(_places(words))
        if words[place + 1 : place + 2] and words[place + 1].strip(".,;:") in CLOCK
    ]
    return words, [number for n, number in enumerate(numbers) if n not in clock]


def _places(words: list[str]) -> list[int]:
    """Which word each number stands in."""
    return [place for place, word in enumerate(words) for _ in range(word.count("#"))]


def _alike(one: tuple[list[str], list[float]], other: tuple[list[str], list[float]]) -> bool:
    if one[0] != other[0] or len(one[1]) != len(other[1]):
        return False
    pairs = zip(one[1], other[1], strict=True)
    return all(abs(a - b) <= CLOSE * max(abs(a), abs(b)) or max(abs(a), abs(b)) < NOTHING for a, b in pairs)
