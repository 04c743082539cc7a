"""A dry scene that is turned, mirrored or numbered anew as a whole does the same, and says the same of it."""

import numpy as np
import pytest

from geometry.polyhedra.measures import centroids, volumes
from masonry.assembly.assemble import assemble
from tests.turned.comparing import (
    ABOUT_BEDS,
    ABOUT_X,
    CASES,
    CYCLIC,
    DRY,
    MIRRORED,
    NUMBERED,
    OBLIQUE,
    TURNS,
    apart,
    asked,
    run,
    words,
)
from verification.checks.turned import NoSuchScene, Turn, about, turned
from verification.scene_runs import load


@pytest.mark.parametrize("turn", [ABOUT_X, ABOUT_BEDS, OBLIQUE, NUMBERED])
def test_an_arch_stands_alike(turn):
    one, other = run("arch-own-weight"), run("arch-own-weight", turn)
    assert max(apart(one, other).values()) < 1e-5, "of the work, which its settling leaves open"
    assert words(one) == words(other)
    assert one["joints_opened_or_slid"] == other["joints_opened_or_slid"]


@pytest.mark.parametrize("turn", [ABOUT_X, CYCLIC, MIRRORED, NUMBERED])
def test_the_thrust_of_an_arch_that_spreads_is_the_same(turn):
    one, other = run("arch-spread"), run("arch-spread", turn)
    assert max(apart(one, other).values()) < 1e-5
    assert words(one) == words(other)
    assert one["joints_opened_or_slid"] == other["joints_opened_or_slid"] == 8


@pytest.mark.parametrize("turn", [CYCLIC, MIRRORED, NUMBERED])
def test_units_slide_alike(turn):
    one, other = run("triplet-dry"), run("triplet-dry", turn)
    assert max(apart(one, other).values()) < 1e-9
    assert words(one) == words(other)


@pytest.mark.parametrize("turn", [ABOUT_X, OBLIQUE])
def test_a_wall_falls_at_the_same_tilt_of_its_ground(turn):
    one, other = run("wall-tilted"), run("wall-tilted", turn)
    assert max(apart(one, other).values()) < asked(load("wall-tilted")) == 0.005
    assert words(one) == words(other)
    assert one["collapse_load"]["sets"] == other["collapse_load"]["sets"]


@pytest.mark.parametrize("turn", [ABOUT_X, CYCLIC, NUMBERED])
def test_a_block_rocks_alike_in_large_displacement(turn):
    """Until after its first impact, at 0.349 s."""
    one, other = (run("block-rocking", how, solver__duration="0.45 s") for how in ("", turn))
    assert one["energy_j"]["dashpot"] > 0.01 * one["energy_j"]["external_work"]
    assert max(apart(one, other).values()) < 1e-6
    assert words(one) == words(other)


def test_what_would_lie_along_no_axis_is_refused():
    for name, turn in (("triplet-dry", ABOUT_X), ("arch-spread", OBLIQUE), ("shear-wall", CYCLIC)):
        scene = load(name)
        with pytest.raises(NoSuchScene), turned(scene, TURNS[turn]) as other:
            assemble(other)


def test_a_scene_is_turned_as_a_whole():
    """Blocks, weights and the drive: a mirror image that is turned as well, with other numbers."""
    scene = load("wall-with-window")
    there = Turn("all at once", about((1.0, 1.0, 1.0), 120.0) @ np.diag([-1.0, 1.0, 1.0]), seed=3)
    one = assemble(scene)
    with turned(scene, there) as moved:
        other = assemble(moved)
    order = there.order(one.specimen.blocks.count)
    assert there.mirrors == -1.0 and moved.drive is not None and moved.drive.direction == "-y"
    assert np.allclose(centroids(other.specimen.blocks), centroids(one.specimen.blocks)[order] @ there.matrix.T)
    assert np.allclose(volumes(other.specimen.blocks), volumes(one.specimen.blocks)[order])
    assert other.joints.area.sum() == pytest.approx(one.joints.area.sum())
    weights = [built.model.bodies.rigid.load[:, :3] for built in (one, other)]
    assert np.allclose(weights[1], weights[0][order] @ there.matrix.T)


@pytest.mark.slow
@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("name", [*DRY, *CASES])
def test_a_dry_scene_does_the_same_however_it_is_turned(name, turn):
    scene = load(name)
    try:
        with turned(scene, TURNS[turn]) as other:
            assemble(other)
    except NoSuchScene as why:
        pytest.skip(str(why))
    one, other = run(name), run(name, turn)
    assert words(one) == words(other)
    assert max(apart(one, other).values()) < asked(scene)
