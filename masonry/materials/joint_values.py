"""From what is known to the numbers of a contact group, each with its range and its source."""

from typing import NamedTuple

from masonry.errors import SceneError
from masonry.materials import eurocode_6, published_rules
from masonry.materials.contact_data import CHARACTERISTIC, ContactData
from masonry.materials.course_data import CourseData, course_data
from masonry.materials.joint_strengths import JointStrength, JointStrengths, joint_strengths
from masonry.materials.published_rules import PublishedRule

SCATTER = 0.5
"""Share by which fracture energies of a few tests are off."""


class ShownUnit(NamedTuple):
    """In which a number is written, and its size in SI."""

    name: str
    size: float


MPA, STIFFNESS, ENERGY, NUMBER = (
    ShownUnit("MPa", 1e6),
    ShownUnit("GPa/m", 1e9),
    ShownUnit("N/m", 1.0),
    ShownUnit("", 1.0),
)
SLOPE, LENGTH = ShownUnit("N/m/MPa", 1e-6), ShownUnit("mm", 1e-3)


class JointValue(NamedTuple):
    """A number of a contact group: its key, value and range in SI, unit, source; whether nobody measured it.

    characteristic  beside a mean, or the mean beside a characteristic value; None where there is one value alone
    """

    key: str
    unit: ShownUnit
    value: float
    low: float
    high: float
    source: str
    is_assumed: bool
    characteristic: float | None = None
    mean: float | None = None


class JointNumbers(NamedTuple):
    """Those of the joint and of the contacts within units, the modulus of a stack (Pa), and what to mind."""

    joint: tuple[JointValue, ...]
    within: tuple[JointValue, ...]
    course: CourseData
    notes: tuple[str, ...]


THICKEST = 3e-3
"""m, of a joint of thin layer mortar."""


def joint_numbers(data: ContactData) -> JointNumbers:
    """All numbers that the law of the joint needs. Raises SceneError for what is missing or contradicts itself."""
    course = course_data(data)
    values = _stiffness(course)
    notes = list(course.notes)
    if data.mortar is not None and data.mortar.is_thin and (data.joint or 0.0) > THICKEST:
        notes.append(
            "thin layer mortar has joints of 0.5 to 3 mm (EN 1996-1-1, 8.1.5); a thicker joint has other values"
        )
    law = data.joint_law
    if law == "elastic" and data.crushing is not None:
        raise SceneError(f"{data.name('crushing')} {data.crushing}: law elastic has no strength; choose another law")
    if law != "elastic":
        strengths = joint_strengths(data)
        notes += strengths.notes
        values += _strengths(data, strengths, notes) if law != "friction" else [_dry_friction(data, strengths, notes)]
        values += _compression(data, strengths, course, notes)
    within = [] if course.stiffness.within is None else _within(course)
    notes += _annex([*values, *within])
    return JointNumbers(tuple(values), tuple(within), course, tuple(notes))


def _stiffness(course: CourseData) -> list[JointValue]:
    low, bed, high = course.low, course.stiffness.bed, course.high
    share, why = course.shear_share
    return [
        JointValue("normal_stiffness", STIFFNESS, bed, low, high, course.source, course.is_assumed),
        JointValue(
            "shear_stiffness", STIFFNESS, share * bed, share * low, share * high, f"{share:.4g} k_n: {why}", True
        ),
    ]


def _within(course: CourseData) -> list[JointValue]:
    within, (share, why) = course.stiffness.within or 0.0, course.shear_share
    source = "10 times the joints" if course.deforms else f"n E_u / H for {course.divisions} rigid blocks in a unit"
    return [
        JointValue("normal_stiffness", STIFFNESS, within, within, within, source, True),
        JointValue("shear_stiffness", STIFFNESS, share * within, share * within, share * within, why, True),
    ]


def _written(data: ContactData, key: str, unit: ShownUnit, strength: JointStrength) -> JointValue:
    """A strength as the user wants it: its mean or its characteristic value."""
    characteristic = data.strengths == CHARACTERISTIC
    value = strength.characteristic if characteristic else strength.mean
    other = {"mean": strength.mean} if characteristic else {"characteristic": strength.characteristic}
    low, high = min(strength.low, value), max(strength.high, value)
    return JointValue(key, unit, value, low, high, strength.source, strength.is_assumed, **other)


def _of_rule(key: str, unit: ShownUnit, rule: PublishedRule) -> JointValue:
    return JointValue(key, unit, rule.value, rule.low, rule.high, rule.source, True)


def _measured(data: ContactData, key: str, unit: ShownUnit, rule: PublishedRule) -> JointValue:
    """The user's value, else that of a rule."""
    value = getattr(data, key)
    if value is None:
        return _of_rule(key, unit, rule)
    return JointValue(key, unit, value, (1.0 - SCATTER) * value, (1.0 + SCATTER) * value, "given", False)


def _dry_friction(data: ContactData, strengths: JointStrengths, notes: list[str]) -> JointValue:
    if strengths.friction is None:
        raise SceneError(
            f"{data.name('friction')}: missing; no code has that of dry joints: give a tangent or an angle"
        )
    parts = {"cohesion": strengths.cohesion, "bond strength": strengths.flexural, "tensile strength": strengths.tension}
    known = [f"{word} of {one.mean / 1e6:.4g} MPa" for word, one in parts.items() if one is not None and one.mean > 0.0]
    if known:
        notes.append(f"law friction has friction alone: it leaves out a {' and a '.join(known)}; other laws have them")
    return _written(data, "tan_friction_angle", NUMBER, strengths.friction)


def _strengths(data: ContactData, strengths: JointStrengths, notes: list[str]) -> list[JointValue]:
    """Tension, cohesion, friction, and the energies of laws that soften."""
    if strengths.cohesion is None or strengths.friction is None:
        raise SceneError(_no_cohesion(data))
    cohesion = _written(data, "cohesion", MPA, strengths.cohesion)
    friction = _written(data, "tan_friction_angle", NUMBER, strengths.friction)
    tension = _tension(data, strengths, cohesion, friction, notes)
    residual = _residual(data, friction)
    _limit_of_shear(data, cohesion, friction, notes)
    values = [tension, cohesion, friction, residual]
    if data.joint_law == "brittle":
        return values
    if data.fracture_energy_mode_1 is None and tension.value < published_rules.TESTED_TENSION[0]:
        notes.append(
            "fracture_energy_mode_1: the tests behind its rule have bond strengths of 0.3 to 0.9 MPa; for this weaker "
            "joint it is a guess"
        )
    return [
        *values,
        _measured(data, "fracture_energy_mode_1", ENERGY, published_rules.mode_1_energy(tension.value)),
        _measured(data, "fracture_energy_mode_2", ENERGY, published_rules.mode_2_energy(cohesion.value)),
        _measured(data, "fracture_energy_mode_2_slope", SLOPE, published_rules.mode_2_slope()),
    ]


def _no_cohesion(data: ContactData) -> str:
    """Data missing for a cohesion, in a sentence."""
    if data.is_dry:
        return (
            f"{data.name('law')} {data.joint_law}: a dry joint has friction alone; leave the law out, or name friction"
        )
    if data.unit is not None and data.mortar is not None and data.mortar.strength is not None:
        strength = data.mortar.strength / 1e6
        return (
            f"{data.name('mortar')}: table 3.4 begins at M1, and {strength:g} MPa is less; give {data.name('cohesion')}"
        )
    unit, mortar = data.name("unit"), data.name("mortar")
    return (
        f"{data.name('cohesion')}: missing; give it, or {data.name('triplets')}, or {unit} and {mortar} for table 3.4 "
        f"of EN 1996-1-1, or {data.name('law')} friction for a joint without cohesion"
    )


def _tension(
    data: ContactData, strengths: JointStrengths, cohesion: JointValue, friction: JointValue, notes: list[str]
) -> JointValue:
    """Direct tension: measured, from bending, or from the cohesion; not beyond the apex of the Coulomb line."""
    key = "tensile_strength"
    if strengths.tension is not None:
        value = _written(data, key, MPA, strengths.tension)
    elif strengths.flexural is not None:
        bending = _written(data, key, MPA, strengths.flexural)
        rule = published_rules.direct_tension(bending.value)
        value = bending._replace(
            value=rule.value,
            low=published_rules.direct_tension(bending.low).low,
            high=bending.high,
            source=f"{bending.source}; {rule.source}",
            is_assumed=True,
            characteristic=None if bending.characteristic is None else bending.characteristic / 1.5,
            mean=None if bending.mean is None else bending.mean / 1.5,
        )
    else:
        value = _of_rule(key, MPA, published_rules.tension_from_cohesion(cohesion.value))
    apex = cohesion.value / friction.value
    if value.value <= apex:
        return value
    source = f"{value.source}; cut at cohesion / tan, where the Coulomb line ends"
    if data.bond_strength is not None or data.tensile_strength is not None:
        notes.append(
            f"tensile_strength: {value.value / 1e6:.4g} MPa is beyond the apex of the Coulomb line, cohesion / tan = "
            f"{apex / 1e6:.4g} MPa, and is cut there; are cohesion and bond strength of the same joint?"
        )
    return value._replace(value=apex, low=min(value.low, apex), high=apex, source=source)


def _residual(data: ContactData, friction: JointValue) -> JointValue:
    key, value = "tan_residual_friction_angle", data.residual_friction
    if value is None:
        return _of_rule(key, NUMBER, published_rules.residual_friction(friction.value))
    if value > friction.value:
        raise SceneError(
            f"{data.name('residual_friction')} = {value:g}: is above that of the intact joint, {friction.value:.4g}; "
            "strength never grows on sliding"
        )
    return JointValue(key, NUMBER, value, 0.9 * value, min(1.1 * value, friction.value), "given", False)


def _limit_of_shear(data: ContactData, cohesion: JointValue, friction: JointValue, notes: list[str]) -> None:
    """The code ends shear along the joint where units tear; a joint's law has no such end."""
    if data.unit_strength is None or eurocode_6.CODE not in cohesion.source:
        return
    limit = eurocode_6.LIMIT_OF_SHEAR * data.unit_strength
    if limit > cohesion.low:
        pressure = (limit - cohesion.low) / eurocode_6.FRICTION
        notes.append(
            f"above a compression of {pressure / 1e6:.3g} MPa the code limits the shear strength to 0.065 f_b, where "
            "units tear; the law of a joint has no such limit"
        )


def _compression(
    data: ContactData, strengths: JointStrengths, course: CourseData, notes: list[str]
) -> list[JointValue]:
    """Compressive strength, and its softening where crushing is modelled."""
    if strengths.compression is None:
        if data.crushing is not None:
            need = data.name("masonry_strength")
            raise SceneError(f"{data.name('crushing')} {data.crushing}: needs the strength of masonry; give {need}")
        return []
    strength = _written(data, "compressive_strength", MPA, strengths.compression)
    if data.crushing is None:
        notes.append("compressive_strength is checked and not modelled; crushing = 'cap' or 'cut-off' models it")
        return [strength]
    energy = published_rules.crushing_energy(strength.value)
    values = [strength, _measured(data, "fracture_energy_compression", ENERGY, energy)]
    if data.crushing == "cap":
        closing = published_rules.closing_at_peak(course.course.height, strength.value, course.modulus)
        if closing is None and data.closing_at_peak is None:
            raise SceneError(
                f"{data.name('closing_at_peak')}: missing; this masonry shortens elastically by more than 0.2 % before "
                "it crushes, which is what the rule for it has in all: give it, or look at the modulus"
            )
        values.append(_measured(data, "closing_at_peak", LENGTH, closing or PublishedRule(0.0, 0.0, 0.0, "")))
    return values


def _annex(values: list[JointValue]) -> list[str]:
    if not any(eurocode_6.CODE in value.source for value in values if value.key != "shear_stiffness"):
        return []
    return [
        f"numbers of {eurocode_6.CODE} are its recommended ones: a national annex may have others, and tests often "
        "give twice as much"
    ]
