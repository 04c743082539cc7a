"""Known data of units, mortar and masonry: each key with its kind and its usual range, read from texts to SI."""

import math
import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from masonry.errors import SceneError, did_you_mean, nearest, visible
from masonry.materials.eurocode_6 import UNITS
from masonry.materials.triplets import read_triplets
from masonry.quantity import convert

KINEMATICS = ("rigid", "affine", "tets")
SOFTENING = ("exponential", "linear", "brittle")
LAWS = (*SOFTENING, "friction", "elastic")
MEAN, CHARACTERISTIC = "mean", "characteristic"
THIN, DRY = "thin-layer", "none"


class Amount(NamedTuple):
    """A quantity: kind, least and largest that is usual (SI), unit and its size in which they are shown, meaning."""

    kind: str
    low: float
    high: float
    unit: str
    size: float
    says: str

    def shown(self, value: float) -> str:
        """With its unit."""
        return f"{value / self.size:.4g} {self.unit}".rstrip()


class WordChoice(NamedTuple):
    """One of some words."""

    words: tuple[str, ...]
    says: str


class Special(NamedTuple):
    """A key with a reading of its own."""

    example: str
    says: str


def _modulus(low: float, high: float, says: str) -> Amount:
    return Amount("stress", low, high, "GPa", 1e9, says)


def _strength(low: float, high: float, says: str) -> Amount:
    return Amount("stress", low, high, "MPa", 1e6, says)


def _length(low: float, high: float, says: str) -> Amount:
    return Amount("length", low, high, "mm", 1e-3, says)


def _energy(low: float, high: float, says: str) -> Amount:
    return Amount("energy", low, high, "N/m", 1.0, says)


KEYS: dict[str, Amount | WordChoice | Special] = {
    "unit": WordChoice(UNITS, "what the units are made of, for the tables of EN 1996-1-1"),
    "group": Special("1", "group of the units by EN 1996-1-1, 1 to 4 (default 1)"),
    "unit_strength": _strength(0.3e6, 400e6, "f_b, normalised mean compressive strength (EN 772-1)"),
    "unit_modulus": _modulus(0.05e9, 200e9, "Young's modulus"),
    "unit_height": _length(5e-3, 3.0, "without the joint"),
    "poisson": Amount("number", 0.0, 0.49, "", 1.0, "Poisson ratio; without it G = 0.4 E (EN 1996-1-1, 3.7.3)"),
    "mortar": Special("M5", "class such as M5, f_m such as '5.3 MPa' (EN 1015-11), thin-layer, or none: a dry joint"),
    "mortar_modulus": _modulus(0.01e9, 60e9, "Young's modulus"),
    "joint": _length(0.3e-3, 60e-3, "thickness of the bed joints"),
    "masonry_strength": _strength(0.1e6, 200e6, "compressive strength across bed joints (EN 1052-1)"),
    "masonry_modulus": _modulus(0.02e9, 150e9, "Young's modulus across bed joints (EN 1052-1)"),
    "triplets": Special(
        "tests.csv", "CSV file of shear tests (EN 1052-3): pressure and shear strength, in MPa or as its heading says"
    ),
    "cohesion": _strength(0.0, 8e6, "initial shear strength (EN 1052-3)"),
    "friction": Special("0.6", "of the intact joint: a tangent, or an angle such as '31 deg'"),
    "residual_friction": Special("0.5", "of a joint that has slid: a tangent, or an angle"),
    "bond_strength": _strength(0.0, 8e6, "flexural, by the bond wrench (EN 1052-5)"),
    "tensile_strength": _strength(0.0, 8e6, "direct tension across the joint"),
    "fracture_energy_mode_1": _energy(0.05, 2e3, "of opening"),
    "fracture_energy_mode_2": _energy(0.1, 2e4, "of sliding, without compression"),
    "fracture_energy_mode_2_slope": Amount("energy per stress", 0.0, 1e-2, "N/m/MPa", 1e-6, "more for each MPa"),
    "fracture_energy_compression": _energy(10.0, 2e5, "of crushing"),
    "closing_at_peak": _length(1e-6, 20e-3, "plastic closing at the peak of a cap"),
    "crushing": WordChoice(("cap", "cut-off"), "model crushing at the compressive strength of masonry"),
    "law": WordChoice(LAWS, "law of the joint (default exponential; friction for a dry joint)"),
    "kinematics": WordChoice(KINEMATICS, "how units move in the scene (default rigid)"),
    "divisions": Special("1", "blocks in the height of a unit (default 1)"),
    "contact": Special("unit_unit", "contact group (default unit_unit)"),
    "basis": WordChoice((MEAN, CHARACTERISTIC), "what your strengths are (default mean, as of tests)"),
    "strengths": WordChoice((MEAN, CHARACTERISTIC), "what to write (default mean, as a simulation needs it)"),
}
"""Every key, in the order in which they are shown."""
TANGENT = Amount("number", 0.02, 3.0, "", 1.0, "")
CLASS = re.compile(r"M ?(\d+(?:\.\d+)?)", re.ASCII | re.IGNORECASE)
MORTAR = _strength(0.1e6, 100e6, "")


class MortarData(NamedTuple):
    """Strength f_m in Pa, None where it is not known; whether the joint is thin, whether there is none."""

    strength: float | None = None
    is_thin: bool = False
    is_dry: bool = False

    @property
    def has_code(self) -> bool:
        """Whether the tables of the code know it."""
        return self.is_thin or self.strength is not None


class ContactData:
    """Known data, in SI: the keys of KEYS as attributes, None where nothing was given."""

    def __init__(self, known: Mapping[str, Any], dashes: bool = False) -> None:
        """Read texts such as "16.7 GPa"; `dashes` names keys as the options of a command. Raises SceneError."""
        self.dashes = dashes
        for key in known:
            if key not in KEYS:
                hint = did_you_mean(str(key), KEYS, 0.5)
                raise SceneError(f"{visible(f'{key!r:.60}')} is no key of a contact's data; {nearest('', KEYS)}{hint}")
        self.values = {key: self._read(key, value) for key, value in known.items() if value is not None}

    def __getattr__(self, key: str) -> Any:
        if key in KEYS:
            return self.values.get(key)
        raise AttributeError(key)

    def name(self, key: str) -> str:
        """The key as the user writes it."""
        return f"--{key.replace('_', '-')}" if self.dashes else key

    @property
    def is_dry(self) -> bool:
        """Whether joints have no mortar."""
        return self.mortar is not None and self.mortar.is_dry

    @property
    def deforms(self) -> bool:
        """Whether units are not rigid."""
        return self.kinematics not in (None, KINEMATICS[0])

    @property
    def joint_law(self) -> str:
        return self.law or ("friction" if self.is_dry else LAWS[0])

    def _read(self, key: str, value: Any) -> Any:
        where, kind = self.name(key), KEYS[key]
        if isinstance(kind, Amount):
            return amount(value, kind, where)
        if isinstance(kind, WordChoice):
            if value not in kind.words:
                word = visible(f"{value!r:.60}")
                raise SceneError(f"{where} {word}: {nearest(value if isinstance(value, str) else '', kind.words)}")
            return value
        if key in ("group", "divisions"):
            return _whole(value, where, 4 if key == "group" else 1000)
        if key in ("friction", "residual_friction"):
            return _tangent(value, where)
        if key == "mortar":
            return _mortar(value, where)
        if key == "triplets":
            return read_triplets(value, where)
        if not isinstance(value, str) or not re.fullmatch(r"[A-Za-z][\w-]*", value):
            raise SceneError(
                f"{where} {visible(f'{value!r:.60}')}: give the name of a contact group such as 'unit_unit'"
            )
        return value


def amount(value: Any, kind: Amount, where: str) -> float:
    """SI, of a text. Raises SceneError for what is no such quantity, is negative, or is far from what is usual."""
    try:
        si = convert(value, kind.kind, where)
    except ValueError as error:
        raise SceneError(f"{error}" if str(error).startswith(where) else f"{where}: {error}") from None
    if kind.low <= si <= kind.high:
        return si
    shown = visible(f"{value}"[:60])
    if si < 0.0:
        raise SceneError(f"{where} = {shown}: is negative; give a value from {kind.shown(kind.low)} on")
    likely = next((si * f for f in (1e3, 1e-3, 1e6, 1e-6, 1e9, 1e-9) if kind.low <= si * f <= kind.high), None)
    hint = f"; did you mean '{kind.shown(likely)}'?" if likely else ""
    usual = f"{kind.shown(kind.low)} to {kind.shown(kind.high)}"
    raise SceneError(f"{where} = {shown}: looks wrong; it is usually {usual}{hint}")


def _whole(value: Any, where: str, most: int) -> int:
    if isinstance(value, int) and not isinstance(value, bool) and 1 <= value <= most:
        return value
    if isinstance(value, str) and value.strip().isdecimal() and 1 <= int(value) <= most:
        return int(value)
    raise SceneError(f"{where} {visible(f'{value!r:.60}')}: give a whole number from 1 to {most}")


def _tangent(value: Any, where: str) -> float:
    """The tangent of a friction angle, from a number or an angle."""
    is_angle = isinstance(value, str) and re.search(r"[A-Za-z°]\s*$", value) is not None
    try:
        number = convert(value, "angle" if is_angle else "number", where)
    except ValueError:
        shown = visible(f"{value!r:.60}")
        raise SceneError(f"{where} = {shown}: give a tangent such as 0.6, or an angle such as '31 deg'") from None
    if is_angle and not 0.0 <= number < math.radians(89.0):
        raise SceneError(f"{where} = {visible(str(value)[:60])}: a friction angle is 0 to below 89 deg")
    tangent = math.tan(number) if is_angle else number
    if tangent > TANGENT.high:
        raise SceneError(f"{where} = {tangent:g}: looks wrong for a tangent; did you mean '{tangent:g} deg'?")
    return amount(tangent, TANGENT, where)


def _mortar(value: Any, where: str) -> MortarData:
    """A class, a strength, thin-layer or none."""
    text = value.strip() if isinstance(value, str) else ""
    if text == DRY:
        return MortarData(is_dry=True)
    if text == THIN:
        return MortarData(is_thin=True)
    if match := CLASS.fullmatch(text):
        return MortarData(amount(f"{match[1]} MPa", MORTAR, where))
    if text and (text[0].isdigit() or text[0] in "+-."):
        return MortarData(amount(text, MORTAR, where))
    hint = did_you_mean(text, (THIN, DRY, "M2.5", "M5", "M10"), 0.5)
    shown = visible(f"{value!r:.60}")
    raise SceneError(f"{where} {shown}: give a class such as M5, f_m such as '5.3 MPa', {THIN}, or {DRY}{hint}")
