"""What damps once the dead loads have settled: none, of the mass, or local; and that a run goes on so after a stop."""

import numpy as np
import pytest

from masonry.configuration.energy import open_in_contacts
from masonry.errors import Stopped
from masonry.laboratory import laboratory
from masonry.laboratory.summary.measurements.free_swing import swing
from masonry.model.damping import Swing, flat_branches
from tests.scenes import load

SCENE = """
law = "elastic"
kinematics = "rigid"
[specimen]
kind = "prism"
units = 2
length = "0.2 m"
width = "0.2 m"
height = "0.1 m"
[material.units]
density = "2000 kg/m^3"
[contact.unit_unit]
normal_stiffness = "1 GPa/m"
shear_stiffness = "0.5 GPa/m"
[[support]]
on = "bottom"
fix = "all"
[gravity]
z = "-9.81 m/s^2"
[settle]
steps = 8000
[[motion]]
on = "top"
velocity = [0, 0, "1 mm/s"]
[solver]
masses = "real"
duration = "30 ms"
rows = 20000
step_fraction = 0.01
frames = 1
[[gauge]]
name = "z"
at = "top"
direction = "z"
{damping}
"""
OMEGA = float(np.sqrt(1e9 * 0.04 / (2000.0 * 0.004)))
HZ = OMEGA / (2.0 * np.pi)


def decay(damping: str) -> tuple[float, dict]:
    """Logarithmic decrement over 2 pi, from the largest kinetic energies of the half swings."""
    result = laboratory.run(load(SCENE.format(damping=damping)))
    rows = result.history.rows
    after = rows["step"] >= 8000
    energy = rows["kinetic"][after][2:]
    top = energy[1:-1][(energy[1:-1] > energy[:-2]) & (energy[1:-1] >= energy[2:])][:20]
    assert np.abs(open_in_contacts(rows)).max() < 1e-9 * energy.max()
    return float(np.polyfit(np.pi * np.arange(len(top)), -0.5 * np.log(top), 1)[0]), result.summary


@pytest.mark.parametrize(
    ("damping", "ratio", "tolerance"),
    [
        ("", None, 0.0),
        ("[damping]\n", 0.0, 1e-6),
        ("[damping]\nlocal = 0.157\n", np.log(1.157 / 0.843) / (2.0 * np.pi), 1e-3),
        (f'[damping]\nstiffness = "{0.1 / OMEGA!r} s"\n', 0.05, 1e-4),
        (f'[damping]\nrayleigh = {{ratio = "5 %", between = ["{HZ / 2} Hz", "{2 * HZ} Hz"]}}\n', 0.04, 1e-4),
        (f'[damping]\nmaxwell = {{ratio = "5 %", between = ["{HZ / 3} Hz", "{3 * HZ} Hz"]}}\n', 0.050236, 1e-4),
        (f'[damping]\nmass = "{0.1 * OMEGA!r} s^-1"\n', 0.05, 1e-4),
    ],
)
def test_what_damps_after_the_settling_is_what_the_scene_says(damping, ratio, tolerance):
    measured, summary = decay(damping)
    assert (summary["damping_after_settling"] is None) == (damping == "")
    if ratio is None:
        assert measured > 0.2, "solver.damping goes on"
    else:
        assert measured == pytest.approx(ratio / np.sqrt(1.0 - ratio**2), abs=tolerance)
        assert summary["free_swings"]["z"]["ratio"] == pytest.approx(ratio, abs=max(tolerance, 2e-5))
        assert summary["free_swings"]["z"]["frequency_hz"] == pytest.approx(HZ, rel=0.1)


FLOATING = """
law = "elastic"
kinematics = "rigid"
[specimen]
kind = "prism"
units = 2
length = "0.3 m"
width = "0.2 m"
height = "0.1 m"
[material.units]
density = "2000 kg/m^3"
[contact.unit_unit]
normal_stiffness = "1 GPa/m"
shear_stiffness = "0.05 GPa/m"
[[motion]]
on = "top"
velocity = ["0.3 mm/s", "-0.2 mm/s", "1 mm/s"]
[solver]
masses = "real"
damping = 0
duration = "2 ms"
rows = 2000
time_step = "{step}"
frames = 1
[damping]
stiffness = "0.02 s"
"""


@pytest.mark.parametrize(("times", "grows"), [(0.98, False), (1.02, True)])
def test_two_equal_blocks_of_stiff_dashpots_calm_down_below_the_bound_and_not_beyond(times, grows):
    """Equal blocks that swing against each other along their normal have all the damping by which each is bounded."""
    bound = laboratory.assemble(load(FLOATING.format(step="gershgorin"))).model.bound
    scene = load(FLOATING.format(step=f"{times * bound!r} s"))
    if grows:
        with pytest.raises(Stopped, match="time step"):
            laboratory.run(scene)
        return
    kinetic = laboratory.run(scene).history.rows["kinetic"]
    assert np.abs(kinetic).max() == kinetic[0]
    assert kinetic[-1] < 0.6 * kinetic[0], "what is left is the motion of both together"
    assert np.ptp(kinetic[-50:]) < 1e-3 * kinetic[-1]


@pytest.mark.parametrize(
    ("ratio", "wide", "within"),
    [
        (0.01, 6.0, 0.04),
        (0.04, 6.0, 0.04),
        (0.05, 5.5, 0.04),
        (0.05, 7.1, 0.04),
        (0.03, 33.0, 0.04),
        (0.05, 900.0, 0.04),
    ]
    + [(0.1, 9.0, 0.04), (0.1, 100.0, 0.13)],
)
def test_maxwell_branches_damp_all_over_their_band_as_they_are_asked_to(ratio, wide, within):
    stiffer, relaxation = flat_branches(ratio, 2.0, 2.0 * wide)
    swing = Swing(stiffer=stiffer, relaxation=relaxation)
    ratios = [swing.ratio_at(frequency) for frequency in np.geomspace(2.0, 2.0 * wide, 60)]
    assert np.abs(np.array(ratios) / ratio - 1.0).max() < 1.01 * within


def test_what_does_not_swing_has_no_ratio():
    time = np.linspace(0.0, 10.0, 2000)
    assert swing(time, np.exp(-time)) is None
    assert swing(time, np.sin(time**2)) is None, "its half swings get shorter"
    assert swing(time, np.random.default_rng(1).normal(size=2000)) is None
    damped = 3.0 + np.exp(-0.5 * time) * np.cos(8.0 * time)
    assert swing(time, damped)["ratio"] == pytest.approx(0.5 / np.hypot(8.0, 0.5), rel=1e-3)
