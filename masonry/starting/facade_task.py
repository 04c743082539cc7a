"""`masonry new facade`: a dry facade with returns and a door, tilted until it falls."""

from typing import Any

from masonry.starting.coursed import facade_of
from masonry.starting.options import Entries, TaskOption, metres
from masonry.starting.task import BOUND, DENSITY, DRY_STIFFNESS, FRICTION, StartTask

TEMPLATE = """\
kinematics = "rigid"
law = "friction"  # joints press and rub; nothing is glued, as in old lime mortar that has crumbled
material = { units.density = "$density", plates.density = "$density"$lintels_density }
contact.unit_unit = { normal_stiffness = "30 GPa/m", shear_stiffness = "12 GPa/m", tan_friction_angle = $friction }
contact.plate = { normal_stiffness = "30 GPa/m", shear_stiffness = "12 GPa/m", tan_friction_angle = $friction }
${lintel_joints}support = [{ on = "base", fix = "all" }]
gauge = [{ name = "top of the facade", at = "top course", direction = "-y" }]
gravity.z = "-9.81 m/s^2"
settle.steps = 5000  # its own weight first

[specimen]  # its front is at y = 0
kind = "wall"
length = "$length"
height = "$height"
thickness = "$thickness"
unit_length = "$unit_fit"  # fitted: about twice the thickness
unit_height = "$course_fit"
$returns_lines
base = "200 mm"
contact_points = "vertex"  # at the corners of the stones, about which they turn
$door_lines
[limit]  # what grows, until it falls: the factor is the tangent of the tilt, forwards
pattern = "tilt"
about = "-x"
accuracy = "2 %"  # of the factor in a run
"""
LINTEL = (
    'contact.lintels_units = {{ normal_stiffness = "30 GPa/m", shear_stiffness = "12 GPa/m", '
    "tan_friction_angle = {friction} }}\n"
)
DOOR = """
[[specimen.opening]]
name = "door"
left = "{left}"
width = "{width}"  # fitted: whole half stones
height = "{height}"  # fitted: whole courses
"""


def values(entries: Entries) -> dict[str, Any]:
    """The placeholders of TEMPLATE."""
    height, thick = entries.si("height"), entries.si("thickness")
    plan = facade_of(entries)
    courses = max(1, round(height / entries.si("unit_height")))
    rise = height / courses
    door = ""
    if plan.door:
        rows = round(entries.si("door_height") / rise)
        if not 1 <= rows <= courses - 2:
            raise entries.refusal(
                "door_height",
                f"{entries.text('door_height')}; allowed: {rise:.4g} to {rise * (courses - 2):.4g} m, "
                "with a lintel and a course above it; --door-width 0 leaves the door out",
            )
        door = DOOR.format(left=metres(plan.door[0]), width=metres(plan.door[1]), height=metres(rise * rows))
    returns = (
        f'returns = "both"\nreturn_length = "{metres(plan.returns)}"  # from the front; fitted' if plan.returns else ""
    )
    back = f'return_thickness = "{metres(thick)}"\n' if plan.returns else ""
    return {
        "title": f"Facade of {entries.text('length')} by {entries.text('height')}, tilted until it falls",
        "unit_fit": plan.unit_length,
        "course_fit": metres(rise),
        "returns_lines": f"{back}{returns}" if returns else '# returns = "both"  # no walls return from its corners',
        "door_lines": door,
        "lintels_density": f', lintels.density = "{entries.text("density")}"' if door else "",
        "lintel_joints": LINTEL.format(friction=entries.text("friction")) if door else "",
        "alone": f"{thick / height:.3f}",
    }


TASK = StartTask(
    "facade",
    "a dry facade with walls that return from its corners: at which tilt does it fall?",
    (
        TaskOption("length", "of the facade", default="4", allowed="[0.1, 100]"),
        TaskOption("height", "of the facade", default="3", allowed="[0.1, 50]"),
        TaskOption("thickness", "of its walls", default="0.4", allowed="[0.02, 5]"),
        TaskOption("unit_height", "of a course, about: it is fitted", default="0.3", allowed="[0.02, 5]"),
        TaskOption(
            "returns", "length of the walls that return, from the front; 0: none", default="1.6", allowed="[0, 50]"
        ),
        TaskOption("door_width", "of a door in its middle; 0: none", default="1", allowed="[0, 50]"),
        TaskOption("door_height", "of the door", default="2.1", allowed="(0, 50]"),
        DENSITY,
        FRICTION,
    ),
    TEMPLATE,
    values,
    ("masonry view $file", "masonry check $file", "masonry limit $file", "masonry run $file"),
    (DRY_STIFFNESS,),
    (
        BOUND,
        "By hand a facade that nothing holds at its ends falls at thickness / height, $alone.",
    ),
)
