"""What is known of a pair goes with it, in whatever column: as it is copied, as room grows, as neighbours change, as a
run is kept and goes on. Each column of each pair has a number of its own."""

import numpy as np

from masonry.assembly.assemble import assemble
from masonry.configuration import model_state
from masonry.configuration.room import make_room
from masonry.patches.arrays import NEED_PAIRS, REASON, ROOM
from masonry.patches.pair_search import searching_for
from masonry.patches.pairs import COLUMNS, FAR, PatchPairs, copy_pairs, no_pairs
from masonry.patches.refreshing import refresh
from tests.large.made import dry, slab
from tests.scenes import box


def fill(pairs: PatchPairs) -> None:
    """Distinct numbers in all columns of the pairs that are there."""
    first = 1
    for name in COLUMNS:
        column = getattr(pairs, name)[: pairs.number[0]]
        column[...] = first + np.arange(column.size).reshape(column.shape)
        first += column.size


def columns(pairs: PatchPairs) -> dict[str, np.ndarray]:
    """Copies of what the columns hold of the pairs that are there."""
    return {name: getattr(pairs, name)[: pairs.number[0]].copy() for name in COLUMNS}


def assert_same(one: dict[str, np.ndarray], other: dict[str, np.ndarray]) -> None:
    for name in COLUMNS:
        np.testing.assert_array_equal(one[name], other[name], err_msg=name)


def blocks():
    """Five cubes on a slab, 0.3 m apart, after a first look."""
    boxes = [box(f"b{k}", (0.3 * k, 0.0, 0.0), (0.1, 0.1, 0.1), "units", k + 1) for k in range(5)]
    model = assemble(dry([slab(), *boxes])).model
    assert refresh(model.large.near) >= 0.0 and model.large.near.pairs.number[0] == 5
    return model


def test_columns_are_all_arrays_of_a_pair_and_lie_side_by_side_without_a_gap():
    pairs = no_pairs(3)
    assert (*PatchPairs._fields[:2], *COLUMNS) == PatchPairs._fields == ("number", "memory", *COLUMNS)
    pairs.number[0] = 3
    pairs.memory[:] = -7
    fill(pairs)
    assert not (pairs.memory == -7).any()
    assert sum(array.size for array in columns(pairs).values()) == pairs.memory.size
    assert all(getattr(pairs, name).flags.c_contiguous for name in COLUMNS)


def test_a_copy_into_more_room_has_all_columns():
    small, large = no_pairs(4), no_pairs(9)
    small.number[0] = 3
    fill(small)
    copy_pairs(small, large)
    assert large.number[0] == 3
    assert_same(columns(large), columns(small))
    assert (large.slot[3:] == -1).all() and (large.mark[3:] == -FAR).all() and not large.pose[3:].any()


def test_more_room_for_pairs_keeps_all_columns():
    model = blocks()
    near = model.large.near
    fill(near.pairs)
    before, room = columns(near.pairs), len(near.pairs.slot)
    near.search.refusal[REASON], near.search.refusal[ROOM] = NEED_PAIRS, 3 * room
    make_room(model, model.large)
    assert len(model.large.near.pairs.slot) == 6 * room
    assert_same(columns(model.large.near.pairs), before)


def search(near) -> bool:
    """What `refresh` begins with."""
    call, answer = searching_for(near)
    call()
    return bool(answer[0])


def test_pairs_that_stay_near_keep_all_columns_as_another_one_goes_and_comes_back_as_new():
    model = blocks()
    near, height = model.large.near, model.bodies.rigid.q[:, 2]
    pairs, piece = near.pairs, near.pairs.piece[:5].copy()
    fill(pairs)
    pairs.piece[:5], pairs.slot[1] = piece, -1
    before, stay = columns(pairs), [0, 2, 3, 4]
    height[2] += 5.0
    assert search(near) and pairs.number[0] == 4
    assert_same(columns(pairs), {name: column[stay] for name, column in before.items()})
    height[2] -= 5.0
    assert search(near) and pairs.number[0] == 5
    after = columns(pairs)
    assert_same({name: column[stay] for name, column in after.items()}, {n: c[stay] for n, c in before.items()})
    assert (after["piece"][1] == piece[1]).all() and (after["body"][1] == (0, 2)).all()
    for name, (_, new) in COLUMNS.items():
        assert name in ("piece", "body", "law") or (after[name][1] == new).all(), name


def test_a_run_that_is_kept_goes_on_with_all_columns_however_much_room_it_had():
    model, other = blocks(), blocks()
    near = model.large.near
    fill(near.pairs)
    kept = model_state.state(model)
    assert {f"pairs.{name}" for name in COLUMNS} < kept.keys()
    other.large.near = other.large.near._replace(pairs=no_pairs(1))
    model_state.restore(other, kept)
    assert other.large.near.pairs.number[0] == 5
    assert_same(columns(other.large.near.pairs), columns(near.pairs))


def test_columns_of_whole_numbers_and_of_lengths_are_told_apart_whatever_python_takes_for_equal():
    """Python 3.11.2, that of Debian 12, takes Annotated[array, (), 0] and Annotated[array, (), 0.0] for one."""
    pairs = no_pairs(2)
    whole = {name for name in COLUMNS if getattr(pairs, name).dtype.kind == "i"}
    assert whole == {"piece", "body", "slot", "points_of", "witness", "face", "law"}
