"""Keys of large displacement, weight that varies, initial motion, real time and floors: what they hold, and refuse."""

import math

import pytest

from masonry.errors import SceneError
from masonry.scene import load, to_toml
from tests.scenes import load as load_text

GRAVITY = '[gravity]\nz = "-9.81 m/s^2"\n'
COMMON = """
law = "friction"
{top}
[specimen]
kind = "prism"
units = 2
length = "0.2 m"
width = "0.2 m"
height = "0.1 m"
{specimen}
[material.units]
density = "2000 kg/m^3"
[contact.{contact}]
normal_stiffness = "10 GPa/m"
shear_stiffness = "5 GPa/m"
tan_friction_angle = 0.4
{dashpot}
[[support]]
on = "bottom"
fix = "all"
{more}
"""


def scene(top="", specimen="", contact="unit_unit", dashpot="", more=GRAVITY, **overrides):
    text = COMMON.format(top=top, specimen=specimen, contact=contact, dashpot=dashpot, more=more)
    return load_text(text, **overrides)


LARGE = 'displacements = "large"'
TILT = GRAVITY + 'tilt = {about = "y", angle = "25 deg", steps = 4000}\n'
REAL = '[solver]\nmasses = "real"\nduration = "2 s"\n'
MOTION = '[[motion]]\non = "top"\nvelocity = ["1 m/s", 0, 0]\nspin = [0, "-2 rad/s", 0]\n'
DRIVE = '[drive]\non = "top"\ndirection = "x"\ndisplacement = "1 mm"\nrate = "1 mm/s"\n'
WHOLE = {
    "large": scene(LARGE, contact="default", dashpot="normal_dashpot = 0.2"),
    "until": scene(LARGE, more=GRAVITY + REAL + 'until = "rest"\n'),
    "tilt": scene(more=TILT),
    "history": scene(more=GRAVITY + 'history = "sin(2 pi t / 1 s)"\nduration = "2 s"\n'),
    "motion": scene(more=MOTION + 'about = ["1 mm", 0, "0 m"]\n' + REAL),
    "mass damping": scene(more=GRAVITY + REAL + '[damping]\nmass = {ratio = "5 %", at = "2 Hz"}\n'),
    "floor": scene(more=GRAVITY + '[floor]\nlevel = "-1 m"\nsize = ["3 m", "2 m"]\nthickness = "0.5 m"\n'),
    "plain floor": scene(more=GRAVITY + "[floor]\n"),
    "turned": scene(specimen='turned = {about = "y", angle = "5 deg", through = ["1 mm", "0 m", "0 m"]}'),
    "at once": scene(more=GRAVITY + "[settle]\nsteps = 0\n" + REAL),
}


@pytest.mark.parametrize("name", WHOLE)
def test_a_scene_with_such_keys_is_written_and_read_again_bit_by_bit(name, tmp_path):
    path = tmp_path / "again.toml"
    path.write_text(to_toml(WHOLE[name]), encoding="utf-8")
    again = load(path)
    assert to_toml(again) == to_toml(WHOLE[name])
    assert (again.floor is None, again.gravity) == (WHOLE[name].floor is None, WHOLE[name].gravity)
    assert again.resolved() == {**WHOLE[name].resolved()}


def test_what_a_scene_says_is_kept_in_si():
    assert WHOLE["large"].is_large and WHOLE["large"].contact["default"].normal_dashpot == 0.2
    assert WHOLE["large"].contact["default"].properties().normal_dashpot == 0.2
    assert WHOLE["tilt"].contact["unit_unit"].properties().normal_dashpot is None
    assert (WHOLE["until"].solver.duration, WHOLE["until"].solver.until) == (2.0, "rest")
    assert WHOLE["tilt"].gravity.tilt.angle == pytest.approx(math.radians(25.0), rel=1e-15)
    assert WHOLE["motion"].motion[0].velocity == (1.0, 0.0, 0.0)
    assert WHOLE["motion"].motion[0].spin == (0.0, -2.0, 0.0)
    assert WHOLE["motion"].motion[0].about == (0.001, 0.0, 0.0)
    assert (WHOLE["floor"].floor.level, WHOLE["floor"].floor.size) == (-1.0, (3.0, 2.0))


def test_a_scene_that_names_none_of_them_is_written_without_them():
    written = to_toml(load("arch"))
    for word in ("displacements", "tilt", "motion", "floor", "turned", "until", "normal_dashpot"):
        assert word not in written
    assert "duration" not in written


def test_limits_of_small_displacement_are_written_where_the_scene_gives_them():
    assert "rotation_limit = 0.1" in to_toml(load("arch", {"solver.rotation_limit": 0.1}))
    assert "rotation_limit" not in to_toml(load("arch"))
    assert "rotation_limit" not in to_toml(WHOLE["large"]) and "slip_limit" not in to_toml(WHOLE["large"])


WRONG = {
    "displacements": ({"top": 'displacements = "larg"'}, "displacements: 'larg' is not allowed; did you mean 'large'"),
    "rotation": ({"top": LARGE, "more": GRAVITY + "[solver]\nrotation_limit = 0.1\n"}, "solver.rotation_limit: a run"),
    "slip": ({"top": LARGE, "more": GRAVITY + "[solver]\nslip_limit = 0.25\n"}, "solver.slip_limit: a run of"),
    "dashpot": ({"dashpot": "normal_dashpot = 0.2"}, 'unit_unit.normal_dashpot: needs displacements = "large"'),
    "restitution": ({"dashpot": "restitution = 0.5"}, 'unit_unit.restitution: needs displacements = "large"'),
    "restitution twice": (
        {"top": LARGE, "dashpot": "restitution = 0.5\nnormal_dashpot = 0.2"},
        "unit_unit.restitution: normal_dashpot and restitution exclude each other",
    ),
    "dashpot 0": ({"top": LARGE, "dashpot": "normal_dashpot = 0"}, "normal_dashpot must be in (0, 100]"),
    "default": ({"contact": "default"}, 'contact.default: needs displacements = "large"'),
    "patches": ({"specimen": 'patch_points = "spread"'}, 'specimen.patch_points: needs displacements = "large"'),
    "until": ({"more": GRAVITY + REAL + 'until = "rest"\n'}, 'solver.until: needs displacements = "large"'),
    "until when": (
        {"top": LARGE, "more": GRAVITY + '[solver]\nuntil = "rest"\n'},
        "solver.duration: missing; until = 'rest' needs it",
    ),
    "scaled": ({"more": GRAVITY + '[solver]\nduration = "1 s"\n'}, "solver.duration: needs solver.masses = 'real'"),
    "scaled motion": ({"more": GRAVITY + MOTION}, "motion.0: needs solver.masses = 'real'"),
    "scaled damping": (
        {"more": GRAVITY + "[damping]\n"},
        "damping: needs solver.masses = 'real': scaled masses do not",
    ),
    "mass and local": (
        {"more": GRAVITY + REAL + '[damping]\nmass = "1 s^-1"\nlocal = 0.1\n'},
        "damping.local: mass and local exclude each other",
    ),
    "mass at": (
        {"more": GRAVITY + REAL + '[damping]\nmass = {ratio = "5 %"}\n'},
        "damping.mass: mass takes a quantity, or {ratio = '5 %', at = '2 Hz'}",
    ),
    "mass and drive": (
        {"more": REAL + '[damping]\nmass = "1 s^-1"\n' + DRIVE},
        "damping.mass: brakes motion relative to the ground",
    ),
    "at once": ({"more": GRAVITY + "[settle]\nsteps = 0\n"}, "settle.steps: 0 needs solver.masses = 'real'"),
    "no end": ({"more": MOTION + '[solver]\nmasses = "real"\n'}, "solver.duration: missing; without a drive"),
    "no unit": ({"more": MOTION.replace('"1 m/s"', "1") + REAL}, "1 has no unit; velocity is a velocity"),
    "still": ({"more": '[[motion]]\non = "top"\n' + REAL}, "motion.0.velocity: missing; give a velocity, a spin"),
    "two": (
        {"more": TILT + 'history = [["0 s", 0], ["1 s", 1]]\n'},
        "gravity.tilt: history and tilt exclude each",
    ),
    "pace": ({"more": TILT.replace(", steps = 4000", "")}, "gravity.tilt.steps: missing; give duration or steps"),
    "paces": ({"more": TILT.replace("4000", '4000, duration = "1 s"')}, "duration and steps exclude each other"),
    "axis": ({"more": TILT.replace('"y"', '"z"')}, "gravity.tilt.about: gravity acts along z alone"),
    "no axis": ({"more": TILT.replace('"y"', '"w"')}, "gravity.tilt.about: 'w' is not allowed"),
    "angle": ({"more": TILT.replace("25 deg", "200 deg")}, "angle must be in [-180, 180] deg"),
    "nothing": ({"more": TILT.replace("25 deg", "0 deg")}, "gravity.tilt.angle: a tilt by 0 turns nothing"),
    "misspelt": ({"more": GRAVITY + 'hystory = "t"\n'}, "did you mean 'history'?"),
    "accuracy": (
        {"more": TILT + '[drive]\non = "top"\ndirection = "x"\ndisplacement = "1 mm"\n'},
        "gravity.tilt: an accuracy controls the drive only",
    ),
    "steps twice": (
        {"more": TILT + '[drive]\non = "top"\ndirection = "x"\ndisplacement = "1 mm"\nsteps = 9\n'},
        "gravity.tilt.steps: with a drive",
    ),
    "gauge": (
        {"more": TILT + '[[gauge]]\nname = "tilt_of_gravity"\nat = "top"\ndirection = "x"\n'},
        "'tilt_of_gravity' is a column of the results already",
    ),
    "curve": ({"more": GRAVITY + '[curve]\nx = "tilt_of_gravity"\n'}, "'tilt_of_gravity' is no gauge"),
    "floor": ({"more": GRAVITY + '[floor]\nlevl = "0 m"\n'}, "floor.levl: unknown key; did you mean 'level'?"),
    "scatter": (
        {"top": LARGE, "contact": "default", "more": GRAVITY + "[scatter.default]\ncohesion = 0.1\n"},
        "scatter.default: scatter needs a group of its own",
    ),
    "soft floor": ({"top": 'kinematics = {floor = "affine"}', "more": GRAVITY + "[floor]\n"}, "kinematics.floor: a fl"),
    "turned": ({"specimen": 'turned = {about = "y"}'}, "specimen.turned.angle: missing; angle is an angle"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_does_not_fit_is_told_in_one_message(name):
    given, wanted = WRONG[name]
    with pytest.raises(SceneError) as told:
        scene(**given)
    assert wanted in str(told.value)


def test_a_tilt_takes_the_place_of_a_history_and_its_duration():
    changed = WHOLE["history"].with_({"gravity.tilt": {"about": "x", "angle": "5 deg", "steps": 10}})
    assert changed.gravity.history is None and changed.gravity.duration is None


def test_a_curve_may_be_drawn_over_the_tilt():
    assert scene(more=TILT + '[curve]\nx = "tilt_of_gravity"\n').curve.x == "tilt_of_gravity"


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ('rayleigh = {ratio = "5 %", between = ["2 Hz", "1 Hz"]}', "damping.rayleigh.between: between takes a lower"),
        ('maxwell = {ratio = "20 %", between = ["1 Hz", "2 Hz"]}', "damping.maxwell.ratio: must be 10 % at most"),
        (
            'rayleigh = {ratio = 0.05, between = ["1 Hz", "2 Hz"]}\nmass = "1 s^-1"',
            "damping.rayleigh: mass and rayleigh",
        ),
        ('stiffness = "2 Hz"', "damping.stiffness: Hz is a frequency; stiffness is a time"),
        ('maxwel = "1 s"', "damping.maxwel: unknown key; did you mean 'maxwell'?"),
    ],
)
def test_what_damping_cannot_be_is_refused(table, words):
    with pytest.raises(SceneError) as error:
        scene(more=GRAVITY + REAL + f"[damping]\n{table}\n")
    assert words in str(error.value)


def test_rayleighs_numbers_follow_from_a_ratio_at_two_frequencies():
    damping = scene(
        more=GRAVITY + REAL + '[damping]\nrayleigh = {ratio = "5 %", between = ["2 Hz", "10 Hz"]}\n'
    ).damping
    for omega in (4.0 * math.pi, 20.0 * math.pi):
        ratio = 0.5 * (damping.mass_rate / omega + damping.stiffness_time * omega)
        assert ratio == pytest.approx(0.05, rel=1e-14)
