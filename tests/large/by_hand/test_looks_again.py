"""When a patch is looked at again: after a hundredth of its size, where its two blocks moved against each other."""

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.patches.arrays import LOOKS, SEARCHES
from masonry.patches.refreshing import count_travel, refresh
from tests.kinematics.bricks import turn
from tests.large.by_hand.patch_calls import stored_energy
from tests.large.made import dry, slab
from tests.scenes import box

SIDE = 0.1


def standing(pressed: float = 1e-5):
    """A cube of 0.1 m on a slab, pressed into it by so much (m) and looked at."""
    block = box("block", (-0.5 * SIDE, -0.5 * SIDE, 0.0), (SIDE, SIDE, SIDE), "units", 1)
    model = assemble(dry([slab(1.0), block])).model
    model.bodies.rigid.q[1, 2] = -pressed
    model.large.near.motion.travel[1] += pressed
    assert refresh(model.large.near) >= 0.0
    assert model.large.near.pairs.slot[0] >= 0
    return model


def looks(model, moved=(0.0, 0.0, 0.0), travel: float | None = None, turned=None) -> int:
    """How many pairs are looked at after the block has moved (m) and turned."""
    near, before = model.large.near, int(model.large.near.search.tally[LOOKS])
    model.bodies.rigid.q[1, :3] += moved
    if turned is not None:
        model.bodies.rigid.frame[1] = turned @ model.bodies.rigid.frame[1]
    near.motion.travel[1] += np.linalg.norm(moved) if travel is None else travel
    assert refresh(near) >= 0.0
    return int(near.search.tally[LOOKS]) - before


@pytest.mark.parametrize(("lean", "limit"), [(0.0, 0.001), (0.02, 0.01)])
def test_the_limit_of_a_patch_is_a_hundredth_of_its_size_or_a_tenth_of_that_where_two_faces_lie_flat(lean, limit):
    """Flat on each other the normal is the mean of two faces; that of a block that leans is the slab's."""
    model = standing()
    model.bodies.rigid.frame[1] = turn(1, lean)
    near = model.large.near
    near.motion.travel[1] += lean
    near.search.built[1] += lean
    assert refresh(near) >= 0.0
    assert near.pairs.limit[0] == pytest.approx(limit * SIDE, rel=0.01) == near.pairs.reach[0]


@pytest.mark.parametrize(("share", "looked"), [(0.99, 0), (1.01, 1)])
@pytest.mark.parametrize("way", [(1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.6, 0.8, 0.0)])
def test_a_block_that_slides_is_looked_at_after_a_hundredth_of_its_patch(share, looked, way):
    model = standing()
    limit = float(model.large.near.pairs.limit[0])
    assert looks(model, share * limit * np.array(way)) == looked


def test_what_has_been_looked_at_is_measured_anew_from_there():
    model = standing()
    limit = float(model.large.near.pairs.limit[0])
    assert [looks(model, (0.6 * limit, 0.0, 0.0)) for _ in range(6)] == [0, 1, 0, 1, 0, 1]


@pytest.mark.parametrize(("moved", "looked"), [(0.74, 0), (0.76, 1)])
def test_travel_alone_is_no_reason_until_a_quarter_of_the_way_is_left(moved, looked):
    model = standing()
    limit = float(model.large.near.pairs.limit[0])
    assert looks(model, (moved * limit, 0.0, 0.0), travel=3.0 * limit) == looked


def test_blocks_that_move_together_are_not_looked_at():
    model = standing()
    near, rigid = model.large.near, model.bodies.rigid
    before, way = int(near.search.tally[LOOKS]), turn(1, 0.3)
    for b in (0, 1):
        rigid.q[b, :3] += (way - np.eye(3)) @ model.layout.centroid[b] + (0.4, 0.0, 0.2)
        rigid.frame[b] = way
        near.motion.travel[b] += 1e-3
    energy = stored_energy(near)
    assert refresh(near) >= 0.0
    assert int(near.search.tally[LOOKS]) == before
    assert stored_energy(near) == pytest.approx(energy, rel=1e-9)


@pytest.mark.parametrize(("share", "looked"), [(0.7, 0), (1.1, 1)])
def test_a_turn_counts_by_the_sphere_round_the_smaller_block(share, looked):
    """The norm of the change of its three axes is root 2 times the angle."""
    model = standing()
    limit, radius = float(model.large.near.pairs.limit[0]), SIDE * 0.75**0.5
    angle = 0.75 * share * limit / (2.0**0.5 * radius)
    assert looks(model, travel=3.0 * limit, turned=turn(2, angle)) == looked


def test_travel_is_counted_by_the_speed_of_the_farthest_point_and_a_search_follows_the_skin():
    model = standing()
    near, rigid = model.large.near, model.bodies.rigid
    before = near.motion.travel.copy()
    rigid.v[1] = 3.0, 0.0, 4.0, 0.0, 0.0, 12.0
    count_travel(near.motion, 1e-5)
    step = (5.0 + 12.0 * SIDE * 0.75**0.5) * 1e-5
    assert near.motion.travel - before == pytest.approx([0.0, step], rel=1e-9)
    searches, skin = int(near.search.tally[SEARCHES]), float(near.search.skin[0])
    near.motion.travel[1] = near.search.built[1] + 0.99 * skin
    refresh(near)
    assert int(near.search.tally[SEARCHES]) == searches
    near.motion.travel[1] = near.search.built[1] + 1.01 * skin
    refresh(near)
    assert int(near.search.tally[SEARCHES]) == searches + 1
