"""Walls that crack in small and in large displacement: they differ by what linear turns leave out, a share theta^2.

A turn theta moves a point at a distance r by theta r; a linear turn leaves theta^2 r / 2 out. So much may gaps differ,
which is no share theta^2 of the stress: joints open by little, and stress is their stiffness times that. So the curves
agree within theta^2 h over the opening at which a joint cracks, h the size of a block, which is what turns.
"""

from functools import cache

import numpy as np
import pytest

from geometry.polyhedra.measures import bounds
from masonry import scene
from masonry.assembly.assemble import assemble
from masonry.laboratory import laboratory

ROLLERS = {
    "contact.rollers_rollers.law": "friction",
    "contact.rollers_rollers.normal_stiffness": "250 GPa/m",
    "contact.rollers_rollers.shear_stiffness": "104 GPa/m",
    "contact.rollers_rollers.tan_friction_angle": 0.6,
}
"""Rollers never meet, but in large displacement it must be said what would happen."""
SCENES = {
    "wallette-mode-1-218": ({"drive.displacement": "0.03 mm", "specimen.points_per_edge": 4}, {}),
    "wallette-mode-2-218": ({"drive.displacement": "0.06 mm", "specimen.points_per_edge": 4}, {}),
    "bending-0": ({"drive.displacement": "0.1 mm"}, ROLLERS),
}
SAME = {
    "drive.accuracy": None,
    "drive.steps": 20000,
    "solver.masses": "real",
    "solver.damping": 0,
    "specimen.contact_points": "vertex",
}
"""One motion: the same masses, time step, contact points and drive; local damping would enlarge rounding."""
TERMS = ("external_work", "elastic_contacts", "fracture_mode_1", "fracture_mode_2")


@cache
def both(name: str):
    settings, more = SCENES[name]
    more = more | {"displacements": "large"}
    step = {"solver.time_step": f"{assemble(scene.load(name, SAME | settings | more)).model.dt!r} s"}
    return tuple(laboratory.run(scene.load(name, SAME | settings | step | own)) for own in ({}, more))


def allowed(name: str) -> tuple[float, float]:
    """m by which gaps may differ somewhere in the wall; and the share by which its curves may."""
    small, large = both(name)
    low, high = bounds(small.specimen.blocks)
    square = max(run.summary["rotation_max_rad"] for run in (small, large)) ** 2
    wall, block = float((high.max(axis=0) - low.min(axis=0)).max()), float((high - low).max(axis=1).mean())
    joint = scene.load(name).contact_of("unit_unit")
    return square * wall, square * block * joint.normal_stiffness / joint.tensile_strength


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_gaps_differ_by_what_linear_turns_leave_out(name):
    small, large = (run.history.frames[-1] for run in both(name))
    gap, _ = allowed(name)
    for key in ("opening", "slip"):
        apart = np.abs(getattr(small, key) - getattr(large, key)).max()
        assert 0.0 < apart < gap, key
    assert ((small.damage > 0.9) == (large.damage > 0.9)).all(), "the crack"


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_curves_and_energies_differ_by_that_over_the_opening_at_which_joints_crack(name):
    small, large = both(name)
    _, share = allowed(name)
    assert large.summary["peak_stress_pa"] == pytest.approx(small.summary["peak_stress_pa"], rel=share)
    for key in ("stress", *TERMS):
        one, other = (run.history.rows[key] for run in (small, large))
        assert other == pytest.approx(one, rel=0, abs=share * np.abs(one).max()), key
    for line in ("redetection", "area"):
        assert abs(large.history.rows[line][-1]) < 1e-6 * large.history.rows["external_work"][-1], line
    assert large.summary["energy_imbalance"] < 1e-12
