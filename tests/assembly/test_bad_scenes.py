"""Scenes that cannot be run say so in one message that names the place, what is wrong, and the nearest right choice."""

import subprocess
import sys

import pytest

from geometry.blocks import GeometryError
from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from tests.large.made import dry
from tests.scenes import box, load

GOOD = """kinematics = {default = "rigid", soft = "affine"}
confinement = "0.5 MPa"
[specimen]
kind = "boxes"
section = "0.02 m^2"
box = [
  {name = "low", origin = ["0 m", "0 m", "0 m"], size = ["0.2 m", "0.1 m", "0.05 m"], group = "hard"},
  {name = "top", origin = ["0 m", "0 m", "0.05 m"], size = ["0.2 m", "0.1 m", "0.05 m"], group = "soft", unit = 1},
]
[material.hard]
density = "1900 kg/m^3"
[material.soft]
density = "1900 kg/m^3"
young_modulus = "5 GPa"
poisson_ratio = 0.2
[contact.hard_soft]
law = "linear"
normal_stiffness = "150 GPa/m"
shear_stiffness = "70 GPa/m"
tensile_strength = "0.5 MPa"
cohesion = "0.8 MPa"
tan_friction_angle = 1.0
tan_residual_friction_angle = 0.7
fracture_energy_mode_1 = "5 N/m"
fracture_energy_mode_2 = "50 N/m"
[[support]]
on = "low"
fix = "all"
[drive]
on = "top"
direction = "x"
displacement = "0.1 mm"
steps = 1000
[[traction]]
on = "top.z+"
stress = {z = "-confinement"}
[settle]
steps = 500
"""
SUPPORT_LOW = '[[support]]\non = "low"\nfix = "all"\n'

SPARE = """
  {name = "spare", origin = ["0 m", "0 m", "0.3 m"], size = ["0.2 m", "0.1 m", "0.01 m"], group = "soft", unit = 2},
]
[material.hard]"""

BAD = {
    "support on nothing": ('on = "low"', 'on = "lwo"', r"support\.0\.on = 'lwo' selects nothing.*'low'"),
    "drive on nothing": (
        'on = "top"\ndirection',
        'on = "topp"\ndirection',
        r"drive\.on = 'topp' selects nothing.*'top'",
    ),
    "support on a face that is covered": ('on = "low"', 'on = "low.z+"', r"support\.0\.on = 'low\.z\+'.*joint.*z-"),
    "support on a face that is none": ('on = "low"', 'on = "low.w+"', r"support\.0\.on = 'low\.w\+'.*x-, x\+"),
    "traction without a face": ('on = "top.z+"', 'on = "top"', r"traction\.0\.on = 'top'.*face.*'top\.z\+'"),
    "traction on a face in a joint": ('on = "top.z+"', 'on = "top.z-"', r"traction\.0\.on = 'top\.z-'.*joint.*z\+"),
    "blocks that overlap": (
        '"0.05 m"], size',
        '"0.04 m"], size',
        r"'low' and 'top' overlap by 10 mm.*moving 'top' by 10 mm along z parts them",
    ),
    "a block held by nothing": (
        "\n]\n[material.hard]",
        SPARE,
        r"block 2 .*at \(0\.1, 0\.05, 0\.305\).*\[\[support\]\]",
    ),
    "contact group missing": ("[contact.hard_soft]", "[contact.within_soft]", r"\[contact\.hard_soft\] is missing"),
    "contact group misspelt": (
        "[contact.hard_soft]",
        "[contact.hard_sfot]",
        r"\[contact\.hard_soft\] is missing.*hard_sfot",
    ),
    "material missing": ('[material.hard]\ndensity = "1900 kg/m^3"\n', "", r"\[material\.hard\] is missing"),
    "material of no block": (
        "[material.hard]",
        '[material.hrad]\ndensity = "1 kg/m^3"\n[material.hard]',
        r"hrad.*'hard'",
    ),
    "kinematics of no block": ('soft = "affine"', 'sfot = "affine"', r"kinematics\.sfot.*'soft'"),
    "drive against a support": ('on = "low"\nfix', 'on = "top"\nfix', r"drive\.on = 'top': a support holds it"),
    "missing energy": ('fracture_energy_mode_1 = "5 N/m"\n', "", r"contact\.hard_soft.*fracture_energy_mode_1"),
    "snap-back in tension": ('_1 = "5 N/m"', '_1 = "0.5 N/m"', r"fracture_energy_mode_1 = 0\.5.*above 0\.83"),
    "snap-back in shear": ('_2 = "50 N/m"', '_2 = "1 N/m"', r"fracture_energy_mode_2 = 1 .*above 6\.44"),
    "a face of an affine block held alone": (
        SUPPORT_LOW,
        SUPPORT_LOW + '[[support]]\non = "top.x+"\nfix = "x"\n',
        r"affine",
    ),
    "a face of a rigid block held askew": ('on = "low"\nfix = "all"', 'on = "low.z-"\nfix = ["x"]', r"rigid.*roller"),
    "equation-11 with scaled masses": (
        "[settle]",
        '[solver]\ntime_step = "equation-11"\n[settle]',
        r"equation-11.*real",
    ),
    "no modulus for an affine block": ('young_modulus = "5 GPa"\n', "", r"young_modulus"),
    "negative stiffness": ('"150 GPa/m"', '"-150 GPa/m"', r"normal_stiffness"),
    "wrong unit": ('"150 GPa/m"', '"150 GPa"', r"normal_stiffness"),
    "unknown key": ("cohesion =", "cohesoin =", r"cohesoin.*cohesion"),
}


def spoilt(name: str) -> str:
    old, new, _ = BAD[name]
    assert old in GOOD, name
    place = GOOD.rindex(old) if name == "blocks that overlap" else GOOD.index(old)
    return GOOD[:place] + new + GOOD[place + len(old) :]


def test_the_scene_is_good_before_it_is_spoilt():
    assert laboratory.check(load(GOOD))["blocks"] == 2


@pytest.mark.parametrize("name", BAD)
def test_a_bad_scene_is_refused_with_one_clear_message(name):
    with pytest.raises((SceneError, GeometryError), match=r"(?s)" + BAD[name][2]) as error:
        laboratory.check(load(spoilt(name)))
    assert len(str(error.value)) < 700
    assert "Traceback" not in str(error.value)


@pytest.mark.parametrize("name", ["support on nothing", "blocks that overlap", "snap-back in tension", "unknown key"])
def test_masonry_check_ends_with_code_2_and_the_message_alone(name, tmp_path):
    (tmp_path / "bad.toml").write_text(spoilt(name), encoding="utf-8")
    command = [sys.executable, "-m", "masonry", "check", str(tmp_path / "bad.toml")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith("masonry: ")
    assert "Traceback" not in done.stderr


def test_a_support_may_hold_turns_where_the_drive_takes_a_face():
    """Both hold the turns of the top; that is no contradiction, since neither moves them."""
    text = GOOD.replace('soft = "affine"', 'soft = "rigid"').replace(
        'on = "top"\ndirection', 'on = "top.x+"\ndirection'
    )
    text = text.replace(SUPPORT_LOW, SUPPORT_LOW + '[[support]]\non = "top"\nfix = ["rotation"]\n')
    assert laboratory.check(load(text))["blocks"] == 2


def test_a_specimen_that_touches_nothing_is_asked_for_a_time_step():
    with pytest.raises(SceneError, match="solver.time_step: nothing here limits the time step; give one"):
        assemble(dry([box("cube", (0.0, 0.0, 0.0), (0.1, 0.1, 0.1), "units", 0)], supports=()))
