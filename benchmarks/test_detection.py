"""Detection of large displacement: pairs that are clipped, neighbours, a patch carried over.

The reference is a chain of multiplications, each of which waits for the one before: what any processor, under any load,
does at its clock. Times are the least of many rounds; gates are ratios to that.
"""

import numpy as np
import pytest

from masonry.detection.broad import cells_of, near_pairs
from masonry.detection.narrow import FACE
from masonry.detection.transfer import transfer
from masonry.jit.compiler import jit
from tests.detection.touching import Bodies, box_blocks, cells, touch, turn
from verification.reference_step.interleaved import in_turn, require

ROUNDS, CALLS, CHAIN = 60, 500, 100_000
LINEAR = 1.4
"""How many times more a block of 50,000 may cost than one of 1,000."""


@jit
def chain(count):
    """Multiplications and additions that wait for each other."""
    value = 1.0
    for _ in range(count):
        value = value * 1.0000001 + 1e-9
    return value


@jit
def touching(pieces, turned, position, pairs, witness, axis, scratch, point, gap, area, feature, calls):
    """`touch` of all pairs, so many times, while the second bodies creep along."""
    count = 0
    for _ in range(calls):
        for m in range(len(pairs)):
            p, q = pairs[m, 0], pairs[m, 1]
            position[pieces.body[q], 0] += 1e-12
            count += touch(
                *(pieces, turned, position, p, q, 0.004, 0.004, 1e-4, False),
                *(axis, witness[m], scratch, point, gap, area, feature),
            )[1]
    return count


def per_item(figure, benchmark, row: str, work, items: int, limits, gate: float) -> float:
    """Time an item (s), shown in ns and held to `gate` multiplications."""
    chain(CHAIN)
    work()
    ours, reference = in_turn(work, lambda: chain(CHAIN), rounds=ROUNDS)
    each, one = ours.least / items, reference.least / CHAIN
    if benchmark is not None:
        benchmark.pedantic(work, rounds=5)
        benchmark.extra_info["ratio"] = each / one
    figure(row, 1e9 * each, "ns", *limits, ours.spread)
    require(each / one, gate, row)
    return each


def clipping(bodies: Bodies, pairs: np.ndarray, known: bool):
    """A call that clips all pairs CALLS times, from what was found before or from nothing."""
    k = 64
    out = np.zeros((k, 3)), np.zeros(k), np.zeros(k), np.zeros(k, dtype=np.int64)
    witness, axis = np.full((len(pairs), 3), -1), np.zeros(3)
    arguments = (bodies.pieces, bodies.turned, bodies.position, pairs, witness, axis, bodies.scratch, *out)
    assert touching(*arguments, 1) >= 3 * len(pairs)

    def work():
        if known:
            return touching(*arguments, CALLS)
        for _ in range(CALLS // 10):
            witness[:] = -1
            touching(*arguments, 1)

    return work


def brick_pair() -> Bodies:
    low = np.array([[0, 0, 0], [0.125, 0.01, 0.065]])
    return Bodies(box_blocks(low, low + [0.24, 0.115, 0.065]))


def test_a_pair_of_boxes_is_clipped_at_the_price_that_was_set(benchmark, figure):
    pairs = np.array([[0, 1]])
    work = clipping(brick_pair(), pairs, True)
    per_item(figure, benchmark, "pair of boxes, clipped anew", work, CALLS, (450, 300), 450)
    turned = brick_pair()
    turned.put(1, frame=turn(1e-4, 2e-4, 0.2))
    per_item(figure, None, "pair of boxes, turned", clipping(turned, pairs, True), CALLS, (1200, 900), 1100)


def test_a_pair_of_cells_is_clipped_at_the_price_that_was_set(benchmark, figure):
    bodies = Bodies(cells(60, 1))
    pieces, pairs = bodies.pieces, []
    for p in range(60):
        for q in range(p + 1, 60):
            faces = pieces.face_start[p + 1] - pieces.face_start[p], pieces.face_start[q + 1] - pieces.face_start[q]
            found = bodies.touch(p, q, skin=0.004, reach=0.004)
            if found.kind == FACE and len(found.gap) >= 4 and sum(faces) >= 32:
                pairs.append((p, q))
    pairs = np.array(pairs)
    work = clipping(bodies, pairs, True)
    row = f"pair of cells of {np.diff(pieces.face_start)[pairs].mean():.0f} faces"
    per_item(figure, benchmark, row, work, CALLS * len(pairs), (1800, 900), 1600)


def wall(count: int):
    """Boxes of a running bond of about this many bricks, wider by the skin."""
    side = round(count**0.5)
    k, i = (x.ravel() for x in np.indices((side, side)))
    low = np.stack([0.25 * i + 0.125 * (k % 2), 0 * i, 0.065 * k], axis=1)
    space, pairs = cells_of(np.arange(side * side), 8 * side * side), np.zeros((8 * side * side, 2), dtype=np.int64)
    space.low[:], space.high[:] = low - 0.006, low + [0.256, 0.121, 0.071]
    assert near_pairs(space, pairs) > 2.5 * side * (side - 2)
    return lambda: near_pairs(space, pairs)


def test_neighbours_cost_what_was_set_and_grow_with_the_blocks(benchmark, figure):
    costs = {}
    for count in (100, 1000, 10_000, 50_000):
        items = round(count**0.5) ** 2
        row = f"neighbours of {items} blocks"
        costs[count] = per_item(figure, benchmark if count == 1000 else None, row, wall(count), items, (200, 150), 220)
    assert costs[50_000] <= LINEAR * costs[1000], f"{costs[50_000] / costs[1000]:.2f} times as much a block"


@pytest.mark.parametrize("name", ["same points", "other points"])
def test_a_patch_is_carried_over_within_a_few_clips(benchmark, figure, name):
    bodies = brick_pair()
    first = bodies.touch()
    bodies.position[1] += [0.001, 0.0005, 0] if name == "other points" else [0, 0, 0]
    second = bodies.touch()
    tau, new = np.ones((4, 3)), np.zeros((4, 3))
    arguments = (
        first.point, first.area, first.feature, tau, 4,
        second.point, second.area, second.feature, new, 4, second.axis, bodies.scratch,
    )  # fmt: skip
    limits, gate = ((200, 100), 300) if name == "same points" else ((9000, 6000), 9000)
    per_item(
        figure,
        benchmark,
        f"patch of 4 points carried over, {name}",
        lambda: transfers(*arguments, CALLS),
        CALLS,
        limits,
        gate,
    )


@jit
def transfers(point, area, feature, tau, count, new_point, new_area, new_feature, new_tau, new_count, axis, scratch, n):
    """`transfer`, n times."""
    loss = 0.0
    for _ in range(n):
        loss += transfer(
            point, area, feature, tau, count, new_point, new_area, new_feature, new_tau, new_count, axis, scratch
        )
    return loss
