"""Blocks that fly or fall together are not looked at anew, however far they go, and those that meet are."""

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.configuration.chunk import Chunk
from masonry.patches.arrays import LOOKS
from masonry.timeloop.compiled_step import advance_model
from tests.scenes import MATERIAL, box, listed, load, specimen, tables

DRY = 'normal_stiffness = "1 GPa/m"\nshear_stiffness = "0.5 GPa/m"\ntan_friction_angle = 0.6\nnormal_dashpot = 0.5'
STEPS = 400


def piles(left: tuple, right: tuple):
    """Two piles of eight cubes in the air, 5 mm apart, and their velocities (m/s)."""
    motion = [
        f'on = "{name}"\nvelocity = {[f"{v} m/s" for v in velocity]}'.replace("'", '"')
        for name, velocity in (("left", left), ("right", right))
    ]
    boxes = [
        box("left", (0, 0, 0), (0.2, 0.2, 0.2), "units", 1, (2, 2, 2)),
        box("right", (0.205, 0.03, 0.02), (0.2, 0.2, 0.2), "units", 2, (2, 2, 2)),
    ]
    return load(
        'displacements = "large"\nlaw = "friction"\nkinematics = "rigid"\n'
        + specimen(boxes, 0.01)
        + tables("material", {"units": MATERIAL})
        + tables("contact", {"default": DRY})
        + '[floor]\nlevel = "-9 m"\n[gravity]\nz = "-9.81 m/s^2"\n[settle]\nsteps = 0\n'
        + listed("motion", motion)
        + '[solver]\nmasses = "real"\ndamping = 0\nduration = "1 s"\n'
    )


def flown(left: tuple, right: tuple):
    """The model after some steps, and how many looks each pair had a step."""
    model = assemble(piles(left, right)).model
    near = model.large.near
    advance_model(model, Chunk(np.ones(2), np.zeros(2), False), 1, 0, 1, np.zeros(1))
    begun = int(near.search.tally[LOOKS])
    advance_model(model, Chunk(np.ones(STEPS + 1), np.zeros(STEPS + 1), False), 1, 0, STEPS, np.zeros(STEPS))
    return model, (int(near.search.tally[LOOKS]) - begun) / STEPS / int(near.pairs.number[0])


def test_pairs_that_move_as_one_are_hardly_looked_at():
    model, looks = flown((3.0, 1.0, 0.0), (3.0, 1.0, 0.0))
    assert looks < 1e-2, "by travel alone it was every step"
    assert np.abs(model.bodies[0].q[:, 0]).max() > 0.04


def test_an_impact_is_the_same_however_fast_both_piles_fly():
    (rests, few), (flies, more) = flown((1.0, 0, 0), (-1.0, 0, 0)), flown((5.0, 1.0, 0), (3.0, 1.0, 0))
    assert few > 0.0 and more == pytest.approx(few, rel=0.2)
    one, other = rests.bodies[0], flies.bodies[0]
    free = one.dt_over_mass[:, 0] > 0.0
    boost = np.array([4.0, 1.0, 0.0])
    assert one.v[free, 0].min() < -0.2 and abs(one.v[free, 0].mean()) < 1e-9, "they have hit, and momentum is kept"
    parted = np.abs(other.v[free, :3] - boost - one.v[free, :3]).max()
    assert parted < 0.005 * 2.0, "patches are cut anew after 1 % of their size, at other moments in the two runs"
