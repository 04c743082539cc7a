"""A block that swings on an elastic joint in small displacement, in steps that are long or short beside its period."""

import numpy as np
import pytest

from masonry.laboratory import laboratory
from tests.scenes import load

MASS, STIFFNESS, SPEED = 2000.0, 1e8, 0.1
SCENE = """
law = "elastic"
[specimen]
kind = "boxes"
section = "1 m^2"
box = [
  {name = "base", origin = ["0 m", "0 m", "-1 m"], size = ["1 m", "1 m", "1 m"], unit = 0},
  {name = "b", origin = ["0 m", "0 m", "0 m"], size = ["1 m", "1 m", "1 m"], unit = 1},
]
[material.units]
density = "2000 kg/m^3"
[contact.unit_unit]
normal_stiffness = "1e8 Pa/m"
shear_stiffness = "4e7 Pa/m"
[[support]]
on = "base"
fix = "all"
[[support]]
on = "b"
fix = ["x", "y", "rotation"]
[[motion]]
on = "b"
velocity = ["0 m/s", "0 m/s", "0.1 m/s"]
[[gauge]]
name = "z"
at = "b"
direction = "z"
[solver]
masses = "real"
damping = 0
duration = "1 s"
sampling = "2000 Hz"
"""


@pytest.mark.parametrize("fraction", [0.8, 0.4, 0.2, 0.05])
def test_how_much_too_wide_swings_are_is_told_and_nothing_else_is_asked_of_a_free_swing(fraction):
    result = laboratory.run(load(SCENE, solver__step_fraction=fraction))
    wide = float(np.abs(result.history.rows["z"]).max()) / (SPEED * np.sqrt(MASS / STIFFNESS)) - 1.0
    told = result.summary["swing_too_wide"]
    assert told == pytest.approx(wide, rel=0.3, abs=1e-3)
    assert [doubt.name for doubt in result.doubts] == (["coarse_swings"] if told > 0.01 else [])
    in_a_step = 8.0 * told
    assert in_a_step == pytest.approx((result.summary["time_step_s"] * frequency()) ** 2, rel=0.05)


@pytest.mark.parametrize(("fraction", "told"), [(0.8, True), (0.05, False)])
def test_coarse_steps_are_told_by_the_swings_of_what_the_ground_shakes(fraction, told):
    """At 0.8 of the bound the steps would make a swing of 25 Hz too fast by 5 %."""
    shaken = {"ground": {"z": "0.1 g * sin(2 pi t / 0.04 s)", "duration": "1 s"}, "motion": []}
    result = laboratory.run(load(SCENE, solver__step_fraction=fraction).with_(shaken))
    coarse = [doubt.name for doubt in result.doubts if doubt.name.startswith("coarse")]
    assert coarse == ["coarse_swings"] * told


def test_a_coarse_swing_is_told_beside_a_fast_glide():
    glide = {"support.1.fix": ["y", "rotation"], "contact.unit_unit.shear_stiffness": "0 Pa/m"}
    motion = [{"on": "b", "velocity": ["0.1 m/s", "0 m/s", "0.01 m/s"]}]
    result = laboratory.run(load(SCENE).with_({**glide, "motion": motion, "solver.slip_limit": 10.0}))
    wide = float(np.abs(result.history.rows["z"]).max()) / (0.1 * SPEED * np.sqrt(MASS / STIFFNESS)) - 1.0
    assert result.summary["swing_too_wide"] == pytest.approx(wide, rel=0.3) and wide > 0.05


def frequency() -> float:
    """rad/s, of the exact swing, which steps make faster by a third of that share."""
    return float(np.sqrt(STIFFNESS / MASS))
