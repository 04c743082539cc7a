from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from geometry.blocks import GeometryError
from geometry.polyhedra.box_pairs import overlapping_boxes
from geometry.polyhedra.construct import concatenate, from_faces
from geometry.polyhedra.overlaps import Overlapping, check_overlaps
from geometry.specimens.boxes import boxes


def two_boxes(shift, divisions=(1, 1, 1)):
    return [("left", (0, 0, 0), (1, 1, 1), "units", 0, divisions), ("right", shift, (1, 1, 1), "units", 1, (1, 1, 1))]


def test_overlapping_boxes_are_named_with_size_and_place():
    with pytest.raises(GeometryError) as refused:
        boxes(two_boxes((0.9, 0.5, 0.0)), 1.0)
    message = str(refused.value)
    assert "'left' and 'right' overlap by 100 mm around (0.95, 0.75, 0.5) m" in message
    assert "moving 'right' by 100 mm along x parts them" in message


@pytest.mark.parametrize("degrees", [0.0, 33.0])
def test_the_depth_of_an_overlap_is_the_least_move_that_parts_the_blocks(rotate, prism, degrees):
    """Two stones whose joint leans by 45 degrees and which go into each other by 5 mm square to it."""
    deep = 0.005
    left = np.array([[0, 0], [1.0, 0], [0.6, 0.4], [0, 0.4]])
    right = np.array([[1.0, 0], [1.6, 0], [1.6, 0.4], [0.6, 0.4]]) - np.array([[1], [0], [0], [1]]) * (deep * 2**0.5, 0)
    blocks = concatenate([from_faces([prism(ring, 0.0, 0.2)], [n], [0], ["g"]) for n, ring in enumerate((left, right))])
    turned, turn = rotate(blocks, degrees)
    with pytest.raises(Overlapping) as refused:
        check_overlaps(turned)
    (overlap,) = refused.value.overlaps
    assert overlap.depth == pytest.approx(deep, rel=1e-9)
    assert overlap.axis == pytest.approx(turn @ np.array([1, 1, 0]) / 2**0.5, abs=1e-9)
    middle = turn @ np.array([0.8 - deep / 2**0.5, 0.2, 0.1]) + (0.3, -0.2, 0.7)
    assert overlap.place == pytest.approx(middle, abs=deep)
    points = turned.points.copy()
    points[turned.face_points[turned.face_start[turned.block_face_start[1]] :]] += overlap.depth * overlap.axis
    check_overlaps(replace(turned, points=points))


def test_all_overlaps_are_listed_the_deepest_first():
    row = [(f"b{k}", (0.9 * k - (k == 3) * 0.05, 0, 0), (1, 1, 1), "units", k, (1, 1, 1)) for k in range(4)]
    with pytest.raises(Overlapping) as refused:
        boxes(row, 1.0)
    assert [(o.first, o.second) for o in refused.value.overlaps] == [(2, 3), (0, 1), (1, 2)]
    assert str(refused.value).count("overlap by") == 3


def test_a_stone_in_the_hollow_of_another_parts_by_the_short_way_out(prism):
    """A block in the notch of an L, 1 cm too deep: its hull would have to be left by far more."""
    corner = np.array([[0, 0], [1, 0], [1, 1], [0.5, 1], [0.5, 0.5], [0, 0.5]])
    faces = prism(corner, 0.0, 0.3)
    foot = [faces[0][[0, 1, 4, 5]], faces[0][[1, 2, 3, 4]]], [faces[1][[0, 1, 4, 5]], faces[1][[1, 2, 3, 4]]]
    small = prism(np.array([[0.1, 0.49], [0.4, 0.49], [0.4, 0.8], [0.1, 0.8]]), 0.0, 0.3)
    both = from_faces([[*foot[0], *foot[1], *faces[2:]], small], [0, 1], [0, 0], ["g"])
    with pytest.raises(Overlapping) as refused:
        check_overlaps(both)
    (overlap,) = refused.value.overlaps
    assert overlap.depth == pytest.approx(0.01, rel=1e-2) and overlap.axis == pytest.approx([0, 1, 0], abs=1e-12)


def test_a_box_thinner_than_what_counts_as_touching_is_refused_with_its_name():
    for thin, said in (
        (1e-9, r"right is 1e-09 m thin in a specimen of 2 m; it must be more than 2e-09 m"),
        (1e-8, ""),
    ):
        pair = [two_boxes((1.0, 0.0, 0.0))[0], ("right", (1, 0, 0), (1, thin, 1), "units", 1, (1, 1, 1))]
        if said:
            with pytest.raises(GeometryError, match=said):
                boxes(pair, 1.0)
        else:
            boxes(pair, 1.0)


def test_boxes_that_touch_or_overlap_within_rounding_are_accepted():
    boxes(two_boxes((1.0, 0.5, 0.0)), 1.0)
    boxes(two_boxes((1.0 - 1e-12, 0.5, 0.0)), 1.0)
    with pytest.raises(GeometryError):
        boxes(two_boxes((1.0 - 1e-7, 0.5, 0.0)), 1.0)


def test_a_box_wholly_inside_another_is_found():
    with pytest.raises(GeometryError, match="'big' and 'small'"):
        boxes(
            [("big", (0, 0, 0), (3, 3, 3), "g", 0, (1, 1, 1)), ("small", (1, 1, 1), (1, 1, 1), "g", 1, (1, 1, 1))], 1.0
        )


@pytest.mark.parametrize("degrees", [0.0, 45.0, 71.0])
def test_turned_blocks_overlap_by_their_shape_not_by_their_bounding_box(rotate, degrees):
    for gap, overlaps in ((0.0, False), (1e-6, False), (-1e-6, True)):
        pair = boxes(
            [("a", (0, 0, 0), (1, 1, 1), "g", 0, (1, 1, 1)), ("b", (1, 0, 0), (1, 1, 1), "g", 1, (1, 1, 1))], 1.0
        )
        points = pair.blocks.points
        points[8:] += (gap, 0.3, 0.2)
        turned, _ = rotate(pair.blocks, degrees)
        if overlaps:
            with pytest.raises(GeometryError, match=r"0 \(unit 0\) and 1 \(unit 1\)"):
                check_overlaps(turned)
        else:
            check_overlaps(turned)


def test_blocks_parted_only_by_crossed_edges_are_accepted(hull, rotate):
    ridge = np.array([[-1, 0, 0], [1, 0, 0], [-1, -0.2, -2], [1, -0.2, -1], [-1, 0.2, -2], [1, 0.2, -1.0]])
    keel = ridge[:, [1, 0, 2]] * (1, 1, -1)
    for height, overlaps in ((1e-6, False), (0.0, False), (-1e-6, True)):
        pair, _ = rotate(concatenate([hull(ridge), hull(keel + (0, 0, height))]), 35.0)
        if overlaps:
            with pytest.raises(GeometryError):
                check_overlaps(pair)
        else:
            check_overlaps(pair)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10**6), st.integers(1, 60), st.integers(2, 3))
def test_the_sweep_finds_just_the_pairs_that_meet(seed, count, dimensions):
    random = np.random.default_rng(seed)
    low = random.integers(0, 12, (count, dimensions)) * 0.5
    high = low + random.integers(0, 4, (count, dimensions)) * 0.5 * random.choice([1, 6], (count, 1), p=[0.9, 0.1])
    expected = [
        (i, j)
        for i in range(count)
        for j in range(i + 1, count)
        if np.all(low[i] <= high[j]) and np.all(low[j] <= high[i])
    ]
    assert [tuple(pair) for pair in overlapping_boxes(low, high)] == expected


@pytest.mark.parametrize("most", [1e-3, 1.0, 50.0])
def test_boxes_far_larger_than_the_others_are_found_with_all_that_they_meet(most):
    """Two floors under and beside many small boxes, which cover millions of cells as large as these."""
    rng = np.random.default_rng(1)
    low = rng.random((300, 3))
    high = low + 0.02 * rng.random((300, 3))
    low[[7, 250]], high[[7, 250]] = (-most, -most, 0.3), (most, most, 0.4)
    i, j = np.triu_indices(300, 1)
    meets = ((low[i] <= high[j]) & (low[j] <= high[i])).all(axis=1)
    assert np.array_equal(overlapping_boxes(low, high), np.column_stack([i, j])[meets])


def test_blocks_thinner_than_the_overlap_that_is_allowed_are_looked_at_too():
    thin = boxes([(f"b{k}", (k, 0, 0), (1.0, 1e-3, 1), "units", k, (1, 1, 1)) for k in range(2)], 1.0).blocks
    check_overlaps(thin, allowed=0.01)
    deep = boxes(two_boxes((1.0, 0.0, 0.0)), 1.0).blocks
    deep.points[8:, 0] -= 0.2
    with pytest.raises(Overlapping):
        check_overlaps(deep, allowed=0.1)
    check_overlaps(deep, allowed=0.3)
