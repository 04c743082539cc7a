"""`masonry new house`: four dry walls, a floor on them and ties under it, tilted until they fall."""

from typing import Any

from masonry.starting.options import Entries, TaskOption, metres
from masonry.starting.task import BOUND, DENSITY, DRY_STIFFNESS, FRICTION, StartTask

SLAB = 0.2
"""m, the thickness of the floor."""
TEMPLATE = """\
kinematics = "rigid"
law = "friction"  # joints press and rub; nothing is glued
material = { units.density = "$density", plates.density = "$density", slabs.density = "$slab_density" }
contact.unit_unit = { normal_stiffness = "40 GPa/m", shear_stiffness = "16 GPa/m", tan_friction_angle = $friction }
contact.plate = { normal_stiffness = "40 GPa/m", shear_stiffness = "16 GPa/m", tan_friction_angle = $friction }
contact.slabs_units = { normal_stiffness = "40 GPa/m", shear_stiffness = "16 GPa/m", tan_friction_angle = $friction }
support = [{ on = "base", fix = "all" }]
gravity.z = "-9.81 m/s^2"
settle.steps = 5000  # dead loads first

[specimen]  # its axis is at x = y = 0; the front wall is towards y-
kind = "tower"
width = "$width"
thickness = "$thickness"
courses = $courses
unit_length = "$unit_fit"
unit_height = "$course_fit"
base = "300 mm"
contact_points = "vertex"  # at the corners of the stones, about which they turn

[[specimen.slab]]  # a floor that keeps its shape, on all four walls
name = "floor"
origin = ["-$half_width", "-$half_width", "$height_fit"]
size = ["$width_fit", "$width_fit", "200 mm"]
$tie_lines
[limit]  # what grows, until it falls: the factor is the tangent of the tilt, forwards
pattern = "tilt"
about = "-x"
accuracy = "2 %"  # of the factor in a run
"""
TIES = """
[[bar]]  # from the front wall to the back wall, in the uppermost course
name = "tie"
ends = [["{x}", "-{y}", "{z}"], ["{x}", "{y}", "{z}"]]
area = "3.14 cm^2"  # rods of 20 mm
young_modulus = "210 GPa"
strength = "25 MPa"  # what their anchor plates bear, over the area: 7.85 kN
"""


def values(entries: Entries) -> dict[str, Any]:
    """The placeholders of TEMPLATE."""
    width, thick, height = (entries.si(name) for name in ("width", "thickness", "height"))
    if width <= 3.0 * thick:
        raise entries.refusal("width", f"{width:g} m; more than three walls, {3.0 * thick:g} m")
    courses = max(1, round(height / entries.si("unit_height")))
    rise, count = height / courses, int(entries.si("ties"))
    if courses * 4.0 * width / (3.0 * thick) > MOST_STONES:
        raise entries.refusal("unit_height", f"{rise:.3g} m makes more than {MOST_STONES} stones; take higher courses")
    gap = (width - 2.0 * thick) / (count + 1)
    first = f"{-0.5 * gap * (count - 1):.6g} m"
    ties = TIES.format(x=first, y=metres(0.5 * (width - thick)), z=metres(height - 0.5 * rise)) if count else ""
    if count > 1:
        ties += f'repeat = {count}\nspacing = ["{gap:.6g} m", "0 m", "0 m"]\n'
    return {
        "title": f"House of {entries.text('width')} by {entries.text('height')} with a floor, tilted until it falls",
        "slab_density": f"{entries.si('floor') / 9.81 / SLAB:.4g} kg/m^3",
        "courses": courses,
        "unit_fit": metres(3.0 * thick),
        "course_fit": metres(rise),
        "height_fit": metres(height),
        "width_fit": metres(width),
        "half_width": metres(0.5 * width),
        "tie_lines": ties,
    }


MOST_STONES = 1000
"""Of a first scene: more run for hours."""

TASK = StartTask(
    "house",
    "four dry walls, a floor and ties: at which tilt does it fall?",
    (
        TaskOption("width", "of the outside, of a square plan", default="4", allowed="[0.2, 50]"),
        TaskOption("height", "of its walls", default="2.4", allowed="[0.1, 50]"),
        TaskOption("thickness", "of its walls", default="0.4", allowed="[0.02, 5]"),
        TaskOption("unit_height", "of a course, about: it is fitted", default="0.4", allowed="[0.02, 5]"),
        TaskOption(
            "floor",
            "its weight with what it bears, over its area",
            "stress",
            "kN/m^2",
            "3",
            "[10, 1e6]",
            key="material.slabs.density",
            guess="a timber floor with what it bears: 2 to 4 kN/m2, of concrete 5 to 8",
        ),
        TaskOption("ties", "under the floor, from front to back; 0: none", "integer", "", "2", "[0, 20]"),
        DENSITY,
        FRICTION,
    ),
    TEMPLATE,
    values,
    ("masonry view $file", "masonry check $file", "masonry limit $file", "masonry run $file"),
    (DRY_STIFFNESS,),
    (BOUND,),
)
