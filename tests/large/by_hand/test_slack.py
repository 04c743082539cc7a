"""What patches gain and lose as blocks slide from slab to slab: who pays for whom, and who gets slack."""

from math import sqrt

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.patches.arrays import DASHPOT, NORMAL_GAINED
from masonry.patches.refreshing import refresh
from tests.large.by_hand.patch_calls import stored_energy
from tests.large.made import dry
from tests.scenes import box

DEPTH = 1e-5
UNIT = 0.5 * 1e10 * DEPTH**2
"""J/m2 that springs hold over an area that is sunk by DEPTH."""
SLABS = {  # x and y from and to
    "left low": ((-0.5, 0.0), (-0.2, -0.01)),
    "left high": ((-0.5, 0.0), (0.02, 0.2)),
    "right low": ((0.0, 0.38), (-0.2, 0.0)),
    "right high": ((0.0, 0.38), (0.0, 0.2)),
    "far": ((1.0, 1.2), (-0.2, 0.2)),
}
BLOCKS = {"block": (-0.06, -0.05), "neighbour": (0.29, 0.05), "lone": (1.13, -0.03)}
"""Low corners (m) of blocks of 0.1 m; the second shares a slab with the first, the third one with nobody."""


@pytest.fixture(scope="module")
def built():
    boxes = [
        box(name, (x[0], y[0], -0.1), (x[1] - x[0], y[1] - y[0], 0.1), "units", number)
        for number, (name, (x, y)) in enumerate(SLABS.items())
    ]
    boxes += [
        box(name, (x, y, 0.0), (0.1, 0.1, 0.05), "units", len(SLABS) + number)
        for number, (name, (x, y)) in enumerate(BLOCKS.items())
    ]
    return dry(boxes, supports=tuple(f'on = "{name}"\nfix = "all"' for name in SLABS))


def sunk(scene):
    """The model with all blocks sunk by DEPTH and looked at."""
    model = assemble(scene).model
    model.bodies.rigid.q[len(SLABS) :, 2] = -DEPTH
    assert refresh(model.large.near) >= 0.0
    return model


def slide(model, ways: dict[str, float]) -> None:
    """Move blocks by ways (m) along x, and look."""
    for name, way in ways.items():
        number = len(SLABS) + list(BLOCKS).index(name)
        model.bodies.rigid.q[number, 0] += way
        model.large.near.motion.travel[number] += abs(way)
    assert refresh(model.large.near) >= 0.0


def area(slab: str, block: str, way: float = 0.0) -> float:
    """m2, that a block has on a slab after a way (m) along x."""
    (x0, x1), (y0, y1) = SLABS[slab]
    x, y = BLOCKS[block][0] + way, BLOCKS[block][1]
    return max(min(x + 0.1, x1) - max(x, x0), 0.0) * max(min(y + 0.1, y1) - max(y, y0), 0.0)


def pair(model, slab: str, block: str) -> int:
    """The number of the pair of a slab and a block."""
    ends = {list(SLABS).index(slab), len(SLABS) + list(BLOCKS).index(block)}
    pairs = model.large.near.pairs
    return next(p for p in range(pairs.number[0]) if set(pairs.body[p].tolist()) == ends)


def slack_with(energy: float, over: float) -> float:
    """m, by which springs over an area (m2) that is sunk by DEPTH hold an energy (J)."""
    return DEPTH - sqrt(energy / (0.5 * 1e10 * over))


@pytest.mark.parametrize("damped", [0.0, 0.0003])
def test_who_loses_area_pays_once_for_who_gains_it_in_the_order_of_the_pairs(built, damped):
    """To the right it gains more than it loses on the left: the first of two patches is paid for, of the second what
    is left, and what its dashpot has taken."""
    model, way = sunk(built), 0.02
    near, before = model.large.near, stored_energy(model.large.near)
    gains = {name: area(name, "block", way) - area(name, "block") for name in SLABS}
    first, second = "right low", "right high"
    p, q = (pair(model, name, "block") for name in (first, second))
    assert p < q
    near.pairs.damped[[p, q]] = damped * UNIT
    dashpot, gained = near.account[DASHPOT], near.account[NORMAL_GAINED]
    slide(model, {"block": way})
    lost = -gains["left low"] - gains["left high"]
    paid = lost - gains[first] + damped
    assert gains[first] < lost < gains[first] + gains[second] - damped, "the sample asks what it is to ask"
    holds = UNIT * (area(second, "block") + paid)
    assert near.pairs.slack[p] == 0.0
    assert near.pairs.slack[q] == pytest.approx(slack_with(holds, area(second, "block", way)), abs=1e-9 * DEPTH)
    assert stored_energy(near) == pytest.approx(before + UNIT * damped, rel=1e-9)
    assert near.account[DASHPOT] == pytest.approx(dashpot - UNIT * damped, abs=1e-12 * before)
    assert near.account[NORMAL_GAINED] == pytest.approx(gained, abs=1e-9 * before)
    assert near.pairs.damped[[p, q]] == pytest.approx([damped * UNIT, 0.0], abs=1e-12 * before)


def test_a_loss_on_another_face_of_the_same_slab_pays_and_one_elsewhere_does_not(built):
    """The neighbour slides over the end of a slab on which the block gains; the lone block loses on a slab of its own,
    and holds what it held by negative slack."""
    model, way = sunk(built), 0.02
    near, before = model.large.near, stored_energy(model.large.near)
    slide(model, {"block": way, "neighbour": way, "lone": 0.05})
    right = [pair(model, name, "block") for name in ("right low", "right high")]
    assert near.pairs.slack[right[1]] == 0.0 == near.pairs.slack[pair(model, "right high", "neighbour")]
    assert near.pairs.slack[right[0]] == 0.0, "the left slabs pay for it once the neighbour pays for the other"
    alone, left = area("far", "lone"), area("far", "lone", 0.05)
    expected = slack_with(UNIT * alone, left)
    assert near.pairs.slack[pair(model, "far", "lone")] == pytest.approx(expected, abs=1e-9 * DEPTH) and expected < 0.0
    changes = [area(s, b, way) - area(s, b) for s in list(SLABS)[:4] for b in ("block", "neighbour")]
    assert stored_energy(near) == pytest.approx(before + UNIT * sum(changes), rel=1e-9)


@pytest.mark.parametrize("way", [0.02, -0.02])
def test_what_shares_a_slab_gets_no_slack_for_a_loss(built, way):
    """It loses as it slides over the end of the slab, where none gains, and gets back no more than that."""
    model = sunk(built)
    near, before = model.large.near, stored_energy(model.large.near)
    number = pair(model, "right high", "neighbour")
    slide(model, {"neighbour": way})
    change = area("right high", "neighbour", way) - area("right high", "neighbour")
    holds = UNIT * min(area("right high", "neighbour"), area("right high", "neighbour", way))
    expected = slack_with(holds, area("right high", "neighbour", way))
    assert near.pairs.slack[number] == pytest.approx(max(expected, 0.0), abs=1e-9 * DEPTH)
    assert stored_energy(near) == pytest.approx(before + UNIT * min(change, 0.0), rel=1e-9)
    assert np.all(near.pairs.gained == 0.0)
