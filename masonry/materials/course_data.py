"""From what is known to the stiffness of a joint: heights, moduli, and the code where there are none."""

from typing import NamedTuple

from masonry.errors import SceneError
from masonry.materials import eurocode_6
from masonry.materials.contact_data import ContactData
from masonry.materials.joint_stiffness import (
    STIFF_JOINT,
    JointStiffness,
    MasonryCourse,
    course_of_parts,
    joint_stiffness,
)
from masonry.materials.joint_strengths import compression

GPA = 1e9
ALIKE = 0.2
"""Moduli that differ by less agree."""


class CourseData(NamedTuple):
    """A course and its joint; range of the normal stiffness (Pa/m), share of the shear stiffness in it and why."""

    course: MasonryCourse
    stiffness: JointStiffness
    low: float
    high: float
    shear_share: tuple[float, str]
    source: str
    is_assumed: bool
    divisions: int
    deforms: bool
    notes: tuple[str, ...]

    @property
    def modulus(self) -> float:
        """Of a stack of such courses in the model, Pa."""
        return self.stiffness.modulus(self.course, self.divisions, self.deforms)


class ModulusSource(NamedTuple):
    """A course, the softest and the stiffest one that it may be, and where they are from."""

    courses: list[MasonryCourse]
    source: str
    is_assumed: bool


def course_data(data: ContactData) -> CourseData:
    """The stiffness of the joint. Raises SceneError for what is missing."""
    divisions, deforms = data.divisions or 1, data.deforms
    height, joint = _heights(data)
    modulus = _modulus(data, height, joint)
    if (deforms or divisions > 1) and data.unit_modulus is None:
        why = f"{data.name('kinematics')} {data.kinematics}" if deforms else f"{data.name('divisions')} {divisions}"
        raise SceneError(f"{data.name('unit_modulus')}: missing; {why} needs it, as blocks shorten besides the joint")
    course = modulus.courses[0]
    stiffness, soft, stiff = (joint_stiffness(one, divisions, deforms) for one in modulus.courses)
    share = (eurocode_6.SHEAR_SHARE, f"G = 0.4 E ({eurocode_6.CODE}, 3.7.3)")
    if data.poisson is not None:
        share = (0.5 / (1.0 + data.poisson), f"1 / (2 (1 + nu)), nu = {data.poisson:g}")
    blocks = "blocks that deform" if deforms else "rigid blocks"
    model = f"for {blocks}, {divisions} in the height of a unit, courses of {1e3 * course.height:g} mm"
    return CourseData(
        course,
        stiffness,
        min(soft.bed, stiffness.bed),
        max(stiff.bed, stiffness.bed),
        share,
        f"{modulus.source}; {model}",
        modulus.is_assumed,
        divisions,
        deforms,
        tuple(_notes(data, course, stiffness, divisions, deforms, height)),
    )


def _heights(data: ContactData) -> tuple[float, float]:
    """Of a unit and of a joint, m."""
    dry = data.is_dry
    if dry and data.joint is not None:
        raise SceneError(f"{data.name('joint')}: {data.name('mortar')} none is a dry joint, which has no thickness")
    if data.unit_height is None:
        raise SceneError(f"{data.name('unit_height')}: missing; the stiffness of a joint depends on it: '65 mm'")
    if data.joint is None and not dry:
        raise SceneError(f"{data.name('joint')}: missing; its thickness, '10 mm', or {data.name('mortar')} none")
    joint = data.joint or 0.0
    if joint > data.unit_height:
        raise SceneError(
            f"{data.name('joint')}: {1e3 * joint:g} mm is thicker than a unit is high, {1e3 * data.unit_height:g} mm; "
            "are the two exchanged?"
        )
    return data.unit_height, joint


def _modulus(data: ContactData, height: float, joint: float) -> ModulusSource:
    """From the masonry's modulus, from those of units and mortar, or from the strength of masonry."""
    whole, unit, mortar = height + joint, data.unit_modulus, data.mortar_modulus

    if data.masonry_modulus is not None:
        courses = [MasonryCourse(whole, whole / (data.masonry_modulus * share), unit) for share in (1.0, 0.75, 1.25)]
        return ModulusSource(courses, f"E of masonry {data.masonry_modulus / GPA:g} GPa", False)
    if unit is not None and (mortar is not None or joint == 0.0):
        courses = [course_of_parts(height, joint, unit, mortar and mortar * share) for share in (1.0, 0.5, 2.0)]
        parts = f"E of units {unit / GPA:g} GPa" + (f", of mortar {mortar / GPA:g} GPa" if joint and mortar else "")
        return ModulusSource(courses, f"{parts}; mortar in a joint is not mortar in a mould", False)
    strength = compression(data)
    if strength is None:
        raise SceneError(_no_modulus(data))
    f_k = strength.characteristic
    courses = [MasonryCourse(whole, whole / (eurocode_6.K_E * f_k * share), unit) for share in (1.0, 0.5, 2.0)]
    source = f"E = 1000 f_k ({eurocode_6.CODE}, 3.7.2), f_k = {f_k / 1e6:.4g} MPa from {strength.source}"
    return ModulusSource(courses, source, True)


def _no_modulus(data: ContactData) -> str:
    """Data missing for a modulus, in a sentence."""
    there = [key for key in ("unit_modulus", "mortar_modulus") if getattr(data, key) is not None]
    lacks = [key for key in ("unit_modulus", "mortar_modulus") if key not in there]
    first = f"{data.name(lacks[0])}: missing beside {data.name(there[0])}" if there else "no modulus is known"
    names = {key: data.name(key) for key in ("masonry_modulus", "masonry_strength", "unit", "unit_strength", "mortar")}
    known = data.unit is not None and data.unit_strength is not None and data.mortar is not None
    code = (
        f"(EN 1996-1-1 has no f_k for {data.unit} of group {data.group or 1} in this mortar)"
        if known and not data.mortar.is_dry
        else f"or {names['unit']}, {names['unit_strength']} and {names['mortar']}, from which EN 1996-1-1 has E"
    )
    return (
        f"{first}; give {data.name('unit_modulus')} and {data.name('mortar_modulus')}, or {names['masonry_modulus']}, "
        f"or {names['masonry_strength']}, {code}"
    )


def _notes(
    data: ContactData, course: MasonryCourse, stiffness: JointStiffness, divisions: int, deforms: bool, height: float
) -> list[str]:
    notes = []
    unit = data.unit_modulus
    if stiffness.is_bounded:
        has = stiffness.modulus(course, divisions, deforms) / GPA
        why = "a dry joint adds nothing to units that deform" if data.is_dry else "mortar is as stiff as the units"
        notes.append(
            f"masonry of {course.modulus / GPA:.4g} GPa leaves nothing for a joint: {why}. The joint is 10 times as "
            f"stiff as a course of units, and a stack has {has:.4g} GPa"
        )
    elif unit is not None and stiffness.bed > 2.0 * STIFF_JOINT * unit / course.height:
        notes.append(
            "the joint is far stiffer than the units, which costs steps and changes little: a softer one may do"
        )
    if data.masonry_modulus is not None and unit is not None and data.mortar_modulus is not None:
        parts = course_of_parts(height, course.height - height, unit, data.mortar_modulus).modulus
        if abs(parts / data.masonry_modulus - 1.0) > ALIKE:
            notes.append(
                f"units and mortar in a row make {parts / GPA:.4g} GPa; the masonry's own modulus is taken, "
                f"{data.masonry_modulus / GPA:.4g} GPa"
            )
    if not deforms:
        notes.append(
            "rigid units: this is the stiffness of bed joints; head joints would have another one, and the program has "
            "one group for both (docs/stiffness.md)"
        )
    return notes
