"""`masonry new earthquake`: a wall in weak mortar that bears a floor, on shaken ground."""

from typing import Any

from masonry.starting.coursed import units_of
from masonry.starting.mortar import MORTAR, tension_of
from masonry.starting.options import Entries, TaskOption, metres
from masonry.starting.task import DENSITY, StartTask

TEMPLATE = """\
displacements = "large"  # units may turn, slide and fall
kinematics = "rigid"
law = "exponential"  # a bond that softens; friction stays
material = { units.density = "$density", plates.density = "2400 kg/m^3" }
support = [{ on = "base", fix = "all" }]
mass = [{ on = "beam", mass = "$floor" }]  # of the floor that it bears
floor.size = ["$ground_size", "$ground_size"]  # for what falls
gauge = [{ name = "drift of the beam", at = "beam", direction = "$axis", relative_to = "base" }]
gravity.z = "-9.81 m/s^2"
settle.steps = 20000

[specimen]
kind = "wall"
length = "$length"  # along x
height = "$height"
thickness = "$thickness"
unit_length = "$unit_fit"  # $fitted
unit_height = "$course_fit"
base = "100 mm"  # of the ground
beam = "150 mm"
points_per_edge = $points  # more along edges that bend

[contact.default]  # all joints of mortar
normal_stiffness = "$stiffness"  # a modulus of the wall of 1 GPa over a course
shear_stiffness = "$shear_stiffness"
tensile_strength = "$tension"
cohesion = "$cohesion"
tan_friction_angle = $friction
fracture_energy_mode_1 = "10 N/m"
fracture_energy_mode_2 = "50 N/m"
normal_dashpot = 0.5

[contact.floor_units]  # rough ground, for what falls
law = "friction"
normal_stiffness = "5 GPa/m"
shear_stiffness = "2 GPa/m"
tan_friction_angle = 1.0
normal_dashpot = 1.0

[ground]
$axis = "first"  # the wall is shaken $direction
peak = "$peak"

[ground.made]  # a record by seed; of your own: record = "FILE" in its place
spectrum = "eurocode-8-1"
seed = $seed
duration = "$duration"
a_g = "0.35 g"
soil = "$soil"

[solver]
masses = "real"  # time is real
duration = "$until"  # and some seconds to come to rest
frames = 100
"""


def values(entries: Entries) -> dict[str, Any]:
    """The placeholders of TEMPLATE."""
    units = units_of(entries, 0.0)
    stiffness = 1.0 / units.height
    across = entries.text("direction") == "across"
    return {
        "title": f"Wall of {entries.text('length')} by {entries.text('height')}, shaken {entries.text('direction')} to "
        f"{entries.text('peak')}",
        "unit_fit": metres(units.length),
        "course_fit": metres(units.height),
        "fitted": units.words,
        "stiffness": f"{stiffness:.4g} GPa/m",
        "shear_stiffness": f"{0.4 * stiffness:.4g} GPa/m",
        "tension": tension_of(entries),
        "until": f"{entries.si('duration') + 5.0:g} s",
        "points": "{ x = 2, y = 12, z = 2 }" if across else "{ x = 4, y = 2, z = 4 }",
        "axis": "y" if across else "x",
        "ground_size": metres(10.0 * entries.si("height") + 2.0 * entries.si("length")),
        "rocks": f"{entries.si('thickness' if across else 'length') / entries.si('height'):.3g}",
    }


TASK = StartTask(
    "earthquake",
    "a wall in weak mortar that bears a floor, on shaken ground: does it stand?",
    (
        TaskOption("length", "of the wall", default="2", allowed="[0.05, 50]"),
        TaskOption("height", "of the wall", default="2", allowed="[0.05, 50]"),
        TaskOption("thickness", "of the wall", default="0.3", allowed="[0.01, 5]"),
        TaskOption("unit_length", "of a unit, about: it is fitted", default="0.4", allowed="[0.02, 10]"),
        TaskOption("unit_height", "of a course, about: it is fitted", default="0.2", allowed="[0.02, 5]"),
        TaskOption("floor", "mass that it bears", "mass", "kg", "2000", "(0, 1e7]"),
        TaskOption(
            "direction", "of the shaking: along the wall, or across it", "", "", "along", words=("along", "across")
        ),
        TaskOption("peak", "of the acceleration of the ground", "acceleration", "g", "0.3", "(0, 50]"),
        TaskOption(
            "soil",
            "of Eurocode 8",
            "",
            "",
            "C",
            words=("A", "B", "C", "D", "E"),
            key="ground.made.soil",
            guess="C: dense sand or stiff clay; a survey of the ground tells",
        ),
        TaskOption("duration", "of the shaking", "time", "s", "5", "[1, 60]"),
        TaskOption("seed", "another number is another record", "integer", "", "1", "[0, 1000000]"),
        TaskOption(
            "cohesion",
            "of the joints",
            "stress",
            "MPa",
            "0.15",
            "[1e3, 1e8]",
            key="contact.default.cohesion",
            guess=f"weak lime mortar: 0.05 to 0.2 MPa; {MORTAR}",
        ),
        TaskOption(
            "friction",
            "tangent of their friction angle",
            "number",
            "",
            "0.7",
            "[0.05, 5]",
            key="contact.default.tan_friction_angle",
            guess="mortar joints: 0.5 to 0.9",
        ),
        DENSITY,
    ),
    TEMPLATE,
    values,
    ("masonry view $file", "masonry check $file", "masonry run $file"),
    (
        ("contact.default.normal_stiffness", "a modulus of the wall of 1000 MPa; weak lime mortar has 300 to 1500"),
        ("contact.default.tensile_strength", "two thirds of the cohesion, as is usual"),
        ("contact.default.fracture_energy_mode_1", "mortar joints: 5 to 20 N/m"),
        ("contact.default.fracture_energy_mode_2", "five times that of tension"),
        ("contact.default.normal_dashpot", "half of the critical one in each joint; blows lose energy there"),
        ("contact.floor_units", "rough ground: what has fallen is of no interest"),
        ("ground", "a record by seed to a spectrum of Eurocode 8, scaled to the peak; recorded ones are better"),
    ),
    ("By hand a dry wall without a floor begins to rock at $rocks g.",),
)
