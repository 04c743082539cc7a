"""Strengths of a joint with their mean and characteristic values, from tests, or from the tables of Eurocode 6."""

from collections.abc import Iterator
from typing import Any, NamedTuple

from masonry.errors import SceneError
from masonry.materials import eurocode_6
from masonry.materials.contact_data import CHARACTERISTIC, ContactData
from masonry.materials.eurocode_6 import CodeStrength
from masonry.materials.triplets import SPECIMENS, ShearLine, shear_line

CODE_IS_LOW = 2.0
"""Means of tests reach so many times what a table of a code gives, which is low on purpose."""

HIGH_COHESION = 2e6
"""Pa; thin layers of strong mortar come near."""


class CharacteristicShare(NamedTuple):
    """Characteristic value over mean of a kind of test, and the standard that says so."""

    value: float
    source: str


SHEAR = CharacteristicShare(0.8, "characteristic = 0.8 mean (EN 1052-3)")
BENDING = CharacteristicShare(1.0 / 1.5, "characteristic = mean / 1.5 (EN 1052-2, five specimens)")
COMPRESSION = CharacteristicShare(1.0 / 1.2, "characteristic = mean / 1.2 (EN 1052-1)")


class JointStrength(NamedTuple):
    """Mean and characteristic value, the range of the mean, where they are from; whether nobody measured it."""

    mean: float
    characteristic: float
    low: float
    high: float
    source: str
    is_assumed: bool = False


def measured(value: float, share: CharacteristicShare, basis: str | None, test: str) -> JointStrength:
    """A strength that the user hands over, as a mean or as a characteristic value."""
    mean = value / share.value if basis == CHARACTERISTIC else value
    characteristic = mean * share.value
    word = basis or "mean"
    return JointStrength(
        mean, characteristic, characteristic, 2.0 * mean - characteristic, f"{test}, {word}; {share.source}"
    )


def of_code(strength: CodeStrength, share: CharacteristicShare, high: float = CODE_IS_LOW) -> JointStrength:
    """A strength of a table, with its range from there to `high` times the mean."""
    mean = strength.value / share.value
    return JointStrength(mean, strength.value, strength.value, high * mean, f"{strength.source}; {share.source}", True)


class JointStrengths(NamedTuple):
    """Strengths of a joint; None where nothing gives one. `friction` is a tangent; `notes` say what to mind."""

    cohesion: JointStrength | None
    friction: JointStrength | None
    flexural: JointStrength | None
    tension: JointStrength | None
    compression: JointStrength | None
    notes: tuple[str, ...] = ()


def joint_strengths(data: ContactData) -> JointStrengths:
    """Tests first, then the code. Raises SceneError where two keys say one thing."""
    _require_one(data, "triplets", "cohesion")
    _require_one(data, "triplets", "friction")
    _require_one(data, "bond_strength", "tensile_strength")
    line = None if data.triplets is None else shear_line(data.triplets.pairs, data.name("triplets"))
    cohesion = _cohesion(data, line)
    return JointStrengths(
        cohesion,
        _friction(data, line),
        _flexural(data),
        _given(data, "tensile_strength", BENDING, "direct tension tests"),
        compression(data),
        tuple(_notes(data, cohesion, line)),
    )


def _notes(data: ContactData, cohesion: JointStrength | None, line: ShearLine | None) -> Iterator[str]:
    """Of few tests, and of a cohesion that few joints have."""
    if line is not None:
        yield from data.triplets.notes
        if line.tests < SPECIMENS or line.pressures < 3:
            yield (
                f"{data.name('triplets')}: {line.tests} tests at {line.pressures} pressures; EN 1052-3 asks for "
                f"{SPECIMENS}, three at each of three pressures"
            )
    if cohesion is not None and cohesion.mean > HIGH_COHESION:
        yield (
            f"cohesion: {cohesion.mean / 1e6:.3g} MPa is high, joints with mortar have 0.1 to 1 MPa; look at its unit"
        )


def compression(data: ContactData) -> JointStrength | None:
    """Across the bed joints, measured or by 3.6.1.2 of the code."""
    if data.masonry_strength is not None:
        return _given(data, "masonry_strength", COMPRESSION, "compression tests (EN 1052-1)")
    if data.unit is None or data.unit_strength is None or data.mortar is None or not data.mortar.has_code:
        return None
    f_m = None if data.mortar.is_thin else data.mortar.strength
    strength = eurocode_6.compressive_strength(data.unit, data.group or 1, data.unit_strength, f_m)
    return None if strength is None else of_code(strength, COMPRESSION, 1.5)


def _given(data: ContactData, key: str, share: CharacteristicShare, test: str) -> JointStrength | None:
    value = getattr(data, key)
    return None if value is None else measured(value, share, data.basis, test)


def _cohesion(data: ContactData, line: ShearLine | None) -> JointStrength | None:
    if line is not None:
        return _of_line(line.cohesion, line.cohesion_error, line)
    if data.cohesion is not None:
        return _given(data, "cohesion", SHEAR, "shear tests (EN 1052-3)")
    return _of_table(data, eurocode_6.shear_strength, SHEAR)


def _friction(data: ContactData, line: ShearLine | None) -> JointStrength | None:
    if line is not None:
        return _of_line(line.tan, line.tan_error, line)
    if data.friction is not None:
        return _given(data, "friction", SHEAR, "shear tests (EN 1052-3)")
    if data.is_dry:
        return None
    share = CodeStrength(eurocode_6.FRICTION, f"{eurocode_6.CODE}, eq. (3.5): 0.4 sigma_d")
    return of_code(share, SHEAR, 1.6)


def _flexural(data: ContactData) -> JointStrength | None:
    if data.bond_strength is not None:
        return _given(data, "bond_strength", BENDING, "bond wrench tests (EN 1052-5)")
    return _of_table(data, eurocode_6.bending_strength, BENDING)


def _of_table(data: ContactData, table: Any, share: CharacteristicShare) -> JointStrength | None:
    if data.unit is None or data.mortar is None or not data.mortar.has_code:
        return None
    strength = table(data.unit, None if data.mortar.is_thin else data.mortar.strength)
    return None if strength is None else of_code(strength, share)


def _of_line(value: float, error: float, line: ShearLine) -> JointStrength:
    test = f"line through {line.tests} shear tests at {line.pressures} pressures (EN 1052-3); {SHEAR.source}"
    return JointStrength(value, SHEAR.value * value, max(value - error, 0.0), value + error, test)


def _require_one(data: ContactData, first: str, second: str) -> None:
    if getattr(data, first) is not None and getattr(data, second) is not None:
        raise SceneError(f"{data.name(second)} is known from {data.name(first)} already; give one of the two")
