"""`masonry new couplet`: the shear test of a joint."""

from typing import Any

from masonry.starting.mortar import MORTAR, tension_of
from masonry.starting.options import Entries, TaskOption
from masonry.starting.task import DENSITY, StartTask

TEMPLATE = """\
kinematics = "rigid"
law = "exponential"  # a bond that softens; friction stays
confinement = "$pressure"
material.units.density = "$density"  # at this slow pace it moves nothing
support = [{ on = "bottom", fix = "all" }, { on = "top", fix = ["y", "rotation"] }]  # the upper unit does not turn
traction = [{ on = "top.z+", stress = { z = "-confinement" } }]
settle.steps = 4000  # pressure first, then shear

[specimen]  # two units and a joint
kind = "couplet"
length = "$length"  # along the shear
width = "$width"
height = "$height"

[contact.unit_unit]
normal_stiffness = "$normal_stiffness"
shear_stiffness = "$shear_stiffness"
tensile_strength = "$tension"
cohesion = "$cohesion"
tan_friction_angle = $friction
fracture_energy_mode_1 = "$energy_tension"
fracture_energy_mode_2 = "$energy_shear"

[drive]
on = "top"
direction = "x"
displacement = "$push"
accuracy = "1 %"
"""


def values(entries: Entries) -> dict[str, Any]:
    """The placeholders of TEMPLATE."""
    cohesion, pressure, friction = (entries.si(name) for name in ("cohesion", "pressure", "friction"))
    return {
        "title": f"Shear test of a joint under {entries.text('pressure')}",
        "tension": tension_of(entries),
        "peak": f"{(cohesion + friction * pressure) / 1e6:.4g}",
    }


TASK = StartTask(
    "couplet",
    "a shear test of a joint: two units, pressed and sheared",
    (
        TaskOption("length", "of a unit, along the shear", default="0.2", allowed="[0.005, 5]"),
        TaskOption("width", "of a unit, across", default="0.1", allowed="[0.005, 5]"),
        TaskOption("height", "of a unit", default="0.05", allowed="[0.005, 5]"),
        TaskOption("pressure", "on the joint", "stress", "MPa", "0.2", "[0, 1e8]"),
        TaskOption(
            "cohesion",
            "of the joint",
            "stress",
            "MPa",
            "0.2",
            "[1e3, 1e8]",
            key="contact.unit_unit.cohesion",
            guess=f"mortar joints: 0.1 to 0.5 MPa; {MORTAR}",
        ),
        TaskOption(
            "friction",
            "tangent of its friction angle",
            "number",
            "",
            "0.7",
            "[0.05, 5]",
            key="contact.unit_unit.tan_friction_angle",
            guess="mortar joints: 0.5 to 0.9; shear tests under three pressures tell (docs/calibrate-a-law.md)",
        ),
        TaskOption(
            "tension",
            "its tensile strength (default: two thirds of the cohesion)",
            "stress",
            "MPa",
            "",
            "[100, 1e8]",
            key="contact.unit_unit.tensile_strength",
            guess="two thirds of the cohesion, at most cohesion / friction; bending tests tell",
        ),
        TaskOption("push", "how far the upper unit is pushed", default="1 mm", allowed="[1e-5, 0.05]"),
        TaskOption(
            "energy_tension",
            "fracture energy in tension",
            "energy",
            "N/m",
            "10",
            "[0.1, 1e4]",
            key="contact.unit_unit.fracture_energy_mode_1",
            guess="mortar joints: 5 to 20 N/m",
        ),
        TaskOption(
            "energy_shear",
            "fracture energy in shear",
            "energy",
            "N/m",
            "100",
            "[0.1, 1e5]",
            key="contact.unit_unit.fracture_energy_mode_2",
            guess="ten times that of tension, as is usual; 10 to 200 N/m, more under pressure",
        ),
        TaskOption(
            "normal_stiffness",
            "of the joint",
            "stiffness",
            "GPa/m",
            "100",
            "[1e8, 1e13]",
            key="contact.unit_unit.normal_stiffness",
            guess="mortar joints of 10 mm: 50 to 200 GPa/m (docs/stiffness.md)",
        ),
        TaskOption(
            "shear_stiffness",
            "of the joint",
            "stiffness",
            "GPa/m",
            "45",
            "[1e8, 1e13]",
            key="contact.unit_unit.shear_stiffness",
            guess="0.4 to 0.5 of the normal one",
        ),
        DENSITY,
    ),
    TEMPLATE,
    values,
    ("masonry view $file", "masonry check $file", "masonry run $file"),
    notes=("By hand the peak is cohesion + friction times pressure, $peak MPa.",),
)
