"""`masonry new wall`: a wall in mortar, pressed, and pushed in its plane."""

from typing import Any

from masonry.starting.coursed import units_of
from masonry.starting.mortar import MORTAR, tension_of
from masonry.starting.options import Entries, TaskOption, metres
from masonry.starting.task import DENSITY, StartTask

TEMPLATE = """\
kinematics = "rigid"
law = "exponential"  # a bond that softens; friction stays, and what is pressed too much crushes
confinement = "$pressure"  # on its top
material = { units.density = "$density", plates.density = "1 kg/m^3" }
support = [{ on = "base", fix = "all" }, { on = "beam", fix = $top_fix }]  # $top_says
traction = [{ on = "beam.z+", stress = { z = "-confinement" } }]
gravity.z = "-9.81 m/s^2"
settle.steps = 8000  # pressure and weight first, then the push
curve.y = "force"

[specimen]
kind = "wall"
length = "$length"
height = "$height"
thickness = "$thickness"
unit_length = "$unit_fit"  # $fitted
unit_height = "$course_fit"
joint_thickness = "$joint"
base = "100 mm"
beam = "100 mm"
points_per_edge = { x = 12, y = 2, z = 4 }  # toes crush on part of an edge

[contact.unit_unit]
normal_stiffness = "$stiffness"  # modulus over a course: a course deforms in its joint
shear_stiffness = "$shear_stiffness"
tensile_strength = "$tension"
cohesion = "$cohesion"
tan_friction_angle = $friction
fracture_energy_mode_1 = "10 N/m"
fracture_energy_mode_2 = "100 N/m"
compressive_strength = "$strength"
crushing = "cut-off"

[contact.plate]  # the joints to base and beam
normal_stiffness = "$stiffness"
shear_stiffness = "$shear_stiffness"
tensile_strength = "$tension"
cohesion = "$cohesion"
tan_friction_angle = $friction
fracture_energy_mode_1 = "10 N/m"
fracture_energy_mode_2 = "100 N/m"
compressive_strength = "$strength"
crushing = "cut-off"

[drive]
on = "beam"
direction = "x"
displacement = "$push"
accuracy = "1 %"
"""
TOPS = {
    "level": ('["y", "rotation"]', "level, free to rise"),
    "free": ('["y", "rotation x", "rotation z"]', "free to turn in its plane"),
}


def values(entries: Entries) -> dict[str, Any]:
    """The placeholders of TEMPLATE."""
    units = units_of(entries, entries.si("joint"))
    rise = units.height + entries.si("joint")
    stiffness, friction = entries.si("modulus") / rise / 1e9, entries.si("friction")
    tension = tension_of(entries)
    length, area = entries.si("length"), entries.si("length") * entries.si("thickness")
    force, strength = entries.si("pressure") * area, entries.si("strength")
    if entries.si("pressure") >= strength:
        raise entries.refusal("pressure", f"{entries.text('pressure')}; the joints crush at {entries.text('strength')}")
    fix, says = TOPS[entries.text("top")]
    weight = area * entries.si("height") * entries.si("density") * 9.81
    arm = 0.5 * length * ((1.0 - (force + weight) / area / strength) * (force + weight))
    arm += 0.5 * length * (1.0 - force / area / strength) * force if entries.text("top") == "level" else 0.0
    return {
        "title": f"Wall of {entries.text('length')} by {entries.text('height')}, pressed and pushed",
        "unit_fit": metres(units.length),
        "course_fit": metres(units.height),
        "fitted": units.words,
        "stiffness": f"{stiffness:.4g} GPa/m",
        "shear_stiffness": f"{0.4 * stiffness:.4g} GPa/m",
        "tension": tension,
        "top_fix": fix,
        "top_says": says,
        "rocking": f"{arm / entries.si('height') / 1e3:.4g}",
        "sliding": f"{friction * (force + weight) / 1e3:.4g}",
    }


TASK = StartTask(
    "wall",
    "a wall in mortar, pressed and pushed in its plane: what force does it bear?",
    (
        TaskOption("length", "of the wall", default="1", allowed="[0.05, 50]"),
        TaskOption("height", "of the wall", default="1", allowed="[0.02, 50]"),
        TaskOption("thickness", "of the wall", default="0.2", allowed="[0.01, 5]"),
        TaskOption("unit_length", "of a unit, about: it is fitted", default="240 mm", allowed="[0.01, 10]"),
        TaskOption("unit_height", "of a unit, about: it is fitted", default="115 mm", allowed="[0.01, 5]"),
        TaskOption("joint", "thickness of the joints", default="10 mm", allowed="[0, 0.1]"),
        TaskOption("pressure", "on its top", "stress", "MPa", "0.5", "[0, 1e8]"),
        TaskOption("push", "how far its top is pushed", default="3 mm", allowed="[1e-5, 1]"),
        TaskOption("top", "kept level by a floor, or free to turn", "", "", "level", words=tuple(TOPS)),
        TaskOption(
            "modulus",
            "of elasticity of the wall, pressed upright",
            "stress",
            "GPa",
            "3",
            "[1e7, 1e11]",
            key="contact.unit_unit.normal_stiffness",
            guess="of a modulus of the wall of 3 GPa: 500 to 1000 times its strength; its share for shear is 0.4",
        ),
        TaskOption(
            "strength",
            "of the wall in compression",
            "stress",
            "MPa",
            "6",
            "[1e5, 1e9]",
            key="contact.unit_unit.compressive_strength",
            guess="brick in lime mortar 2 to 4, in cement mortar 5 to 12 MPa; Eurocode 6, or a test of a prism",
        ),
        TaskOption(
            "cohesion",
            "of the joints",
            "stress",
            "MPa",
            "0.2",
            "[1e3, 1e8]",
            key="contact.unit_unit.cohesion",
            guess=f"mortar joints: 0.1 to 0.5 MPa; {MORTAR}",
        ),
        TaskOption(
            "friction",
            "tangent of their friction angle",
            "number",
            "",
            "0.6",
            "[0.05, 5]",
            key="contact.unit_unit.tan_friction_angle",
            guess="mortar joints: 0.5 to 0.9; 0.4 in Eurocode 6",
        ),
        TaskOption(
            "tension",
            "their tensile strength (default: two thirds of the cohesion)",
            "stress",
            "MPa",
            "",
            "[100, 1e8]",
            key="contact.unit_unit.tensile_strength",
            guess="two thirds of the cohesion, at most cohesion / friction",
        ),
        DENSITY,
    ),
    TEMPLATE,
    values,
    ("masonry view $file", "masonry check $file", "masonry run $file"),
    (
        ("contact.unit_unit.fracture_energy_mode_1", "mortar joints: 5 to 20 N/m"),
        ("contact.unit_unit.fracture_energy_mode_2", "ten times that of tension, as is usual"),
        ("contact.plate", "as between the units"),
        ("material.plates.density", "base and beam weigh nothing: what they bear is the pressure"),
    ),
    ("By hand, without tension: it rocks on crushed toes at $rocking kN, and slides, once cracked, at $sliding kN.",),
)
