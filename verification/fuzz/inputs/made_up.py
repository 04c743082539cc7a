"""A made-up result: the couplet slid a little, as a run would leave it."""

import tempfile
from functools import cache
from pathlib import Path

import numpy as np

from geometry.joints.find import find_joints
from masonry.history import UNITS, Frame, History
from masonry.laboratory.result import Result
from masonry.results.store import NUMBERS
from verification.fuzz.inputs.seeds import small

SUMMARY = {
    "scene": "couplet",
    "law": {"unit_unit": "exponential"},
    "kinematics": "rigid",
    "steps": 10,
    "seconds_run": 1.25,
    "peak_stress_pa": 1.9e5,
    "displacement_at_peak_m": 4e-5,
    "final_stress_pa": 7.7e3,
    "seconds": 2.5,
    "reaction_mismatch_max": 0.01,
    "kinetic_over_internal_max": 1e-3,
    "energy_imbalance": 1e-13,
    "energy_j": {"friction": 0.1},
    "gauges": {"deflection": {"at_peak_m": 1e-5, "final_m": 2e-5}},
    "warnings": ["none"],
}
SCENE = 'title = "A couplet"\nlaw = "exponential"\n[curve]\nx = "deflection"\ny = "force"\n'


def made_up() -> Result:
    """Eleven rows and two frames."""
    specimen = small()
    joints = find_joints(specimen.blocks)
    displacement = np.linspace(0.0, 2e-4, 11)
    rows = {name: np.linspace(0.0, 1.0, 11) for name in UNITS} | {"displacement": displacement, "step": np.arange(11.0)}
    rows |= {"stress": 1e5 * np.sin(displacement * 1e4), "deflection": displacement / 2}
    frames = [_frame(specimen.blocks.points.shape, len(joints.area), specimen.blocks.count, n) for n in (0, 10)]
    group = np.zeros(len(joints.area), dtype=np.int64)
    return Result(SUMMARY, History(rows, frames), specimen, joints, group, ("unit_unit",), None, SCENE, ["one", "two"])


def _frame(corners: tuple[int, ...], contacts: int, count: int, step: int) -> Frame:
    one = np.full(contacts, 0.09 * step)
    return Frame(
        step=step,
        time=1e-4 * step,
        displacement=2e-5 * step,
        corners=np.full(corners, 1e-6 * step),
        nodes=np.zeros((0, 3)),
        opening=1e-5 * one,
        slip=1e-5 * one,
        normal_stress=1e5 * one,
        shear_stress=one,
        damage_tension=one,
        damage_shear=one / 2,
        stress=np.ones((count, 6)),
    )


@cache
def files() -> dict[str, bytes]:
    """Name -> content of what such a run leaves."""
    with tempfile.TemporaryDirectory(prefix="masonry-fuzz-") as folder:
        made_up().save_numbers(Path(folder))
        return {name: (Path(folder) / name).read_bytes() for name in NUMBERS}
