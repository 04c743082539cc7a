"""Small gaps and overlaps between facing faces: found with size and place, mended in one plane, or refused."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.joints import heal
from geometry.joints.find import find_joints
from geometry.joints.gaps import Unmended
from geometry.joints.heal import mend
from geometry.polyhedra.construct import concatenate, from_boxes, from_faces
from geometry.polyhedra.measures import bounds, volumes

MM = 1e-3


def boxes(*spans):
    low, high = np.array(spans, dtype=float).transpose(1, 0, 2)
    count = len(low)
    return from_boxes(low * MM, high * MM, np.arange(count), np.zeros(count, dtype=int), ["units"])


def names(blocks):
    return [f"unit {b}" for b in range(blocks.count)]


def mended(blocks, tolerance=0.1, **words):
    return mend(blocks, tolerance * MM, names(blocks), **words)


def refused(blocks, tolerance=0.1, **words):
    with pytest.raises(GeometryError) as error:
        mended(blocks, tolerance, **words)
    return str(error.value)


PAIR = ((0, 0, 0), (100, 50, 60)), ((0, 0, 60.05), (100, 50, 120))


@pytest.mark.parametrize("degrees", [0.0, 37.0])
def test_two_blocks_with_a_gap_meet_half_way(rotate, degrees):
    blocks, turn = rotate(boxes(*PAIR), degrees, shift=(0, 0, 0))
    result = mended(blocks)
    assert result.gaps.size == pytest.approx([0.05 * MM], rel=1e-9)
    assert result.gaps.place[0] == pytest.approx(turn @ (0.05, 0.025, 0.06), abs=1e-4)
    joints = find_joints(result.blocks)
    assert joints.area.sum() == pytest.approx(100 * 50 * MM**2, rel=1e-12)
    assert np.ptp(joints.point @ turn[:, 2]) < 1e-12
    assert joints.point[0] @ turn[:, 2] == pytest.approx(60.025 * MM, rel=1e-9)
    assert volumes(result.blocks) == pytest.approx(5000 * np.array([60.025, 59.975]) * MM**3, rel=1e-9)
    assert result.volume_change == pytest.approx([0.025 / 60, 0.025 / 59.95], rel=1e-6)


def test_a_joint_that_mending_would_lose_is_refused_by_name(monkeypatch):
    """Whatever goes wrong as corners move: blocks that lay against each other have a joint, or a message."""
    apart = boxes(PAIR[0], ((0, 0, 65), (100, 50, 120)))
    monkeypatch.setattr(heal, "_moved", lambda *_: apart)
    said = refused(boxes(*PAIR))
    assert "joints that would be lost: 1" in said and "gap of 0.05 mm between 'unit 0' and 'unit 1'" in said


def test_the_common_plane_is_the_mean_by_area_and_unmoved_blocks_stay_bit_for_bit():
    blocks = boxes(*PAIR, ((0, 0, -60), (100, 50, 0)), ((300, 0, 0), (400, 50, 60)))
    wide = boxes(((0, 0, 0), (300, 50, 60)), ((0, 0, 59.95), (100, 50, 120)))
    assert find_joints(mended(wide).blocks).point[0, 2] == pytest.approx((300 * 60 + 100 * 59.95) / 400 * MM, rel=1e-12)
    result = mended(blocks).blocks
    for b in (2, 3):
        for f in blocks.faces_of(b):
            assert np.array_equal(result.face(f), blocks.face(f))


def test_touching_blocks_are_not_moved_at_all():
    blocks = boxes(((0, 0, 0), (100, 50, 60)), ((50, 0, 60), (150, 50, 120)))
    result = mended(blocks)
    assert result.blocks is blocks and len(result.gaps.size) == 0


def test_a_wall_with_gaps_and_overlaps_at_random_is_tight_afterwards():
    random = np.random.default_rng(3)
    spans = []
    for j in range(5):
        for i in range(6):
            low = np.array([i * 250 + (j % 2) * 125, 0, j * 60.0])
            shake = random.uniform(-0.02, 0.02, (2, 3)) * (1, 0, 1)
            spans.append((low + shake[0], low + (250, 120, 60) + shake[1]))
    result = mended(boxes(*spans))
    assert (result.gaps.size > 0).sum() > 10 and (result.gaps.size < 0).sum() > 10
    joints = find_joints(result.blocks)
    assert joints.area.sum() == pytest.approx((5 * 5 * 60 * 120 + 4 * (6 * 250 - 125) * 120) * MM**2, rel=1e-3)
    assert len(mended(result.blocks).gaps.size) == 0


def test_larger_gaps_are_refused_with_the_tolerance_that_would_mend_them():
    blocks = boxes(((0, 0, 0), (100, 50, 60)), ((0, 0, 60.4), (100, 50, 120)))
    said = refused(blocks)
    assert "gap of 0.4 mm between 'unit 0' and 'unit 1' at (0.05, 0.025, 0.06" in said
    with pytest.raises(Unmended) as unmended:
        mended(blocks)
    assert unmended.value.needed == pytest.approx(0.41 * MM)
    assert len(mended(blocks, 0.41).gaps.size) == 1
    left = mended(blocks, open_gaps=True)
    assert left.blocks is blocks and left.left.size == pytest.approx([0.4 * MM])


def test_larger_overlaps_are_refused_even_where_gaps_may_stay_open():
    blocks = boxes(((0, 0, 0), (100, 50, 60)), ((0, 0, 59.6), (100, 50, 120)))
    assert "overlap of 0.4 mm" in refused(blocks)
    assert "overlap of 0.4 mm" in refused(blocks, open_gaps=True)
    deep = boxes(((0, 0, 0), (100, 50, 60)), ((0, 0, 40), (100, 50, 120)))
    assert "overlap by" in refused(deep)


def test_wide_openings_and_what_fills_a_gap_are_left_alone():
    apart = boxes(((0, 0, 0), (100, 50, 60)), ((0, 0, 62), (100, 50, 120)))
    assert mended(apart).blocks is apart
    bed = boxes(((0, 0, 0), (100, 50, 60)), ((0, 0, 60.5), (100, 50, 120)), ((0, 0, 60), (100, 50, 60.5)))
    assert mended(bed).blocks is bed
    thin = boxes(((0, 0, 0), (100, 50, 0.4)), ((0, 0, 0.4), (100, 50, 0.8)))
    assert mended(thin).blocks is thin


def test_gaps_that_add_up_along_a_joint_are_refused():
    spans = [((100 * i, 0, 0), (100 * (i + 1), 50, 60 + 0.08 * i)) for i in range(8)]
    spans += [((100 * i + 50, 0, 60.04 + 0.08 * i), (100 * i + 150, 50, 120)) for i in range(7)]
    assert "add up along" in refused(boxes(*spans))


def test_a_wedge_keeps_its_other_faces_in_their_planes():
    angle = np.radians(10)
    lean = np.array([np.sin(angle), 0, np.cos(angle)])
    low, high = 60 * MM, 120 * MM

    def wedge(bottom, top):
        corner = {}
        for n, (x, y) in enumerate(((0, 0), (0.1, 0), (0.1, 0.05), (0, 0.05))):
            corner[n], corner[n + 4] = (np.array([x, y, (level - x * lean[0]) / lean[2]]) for level in (bottom, top))
        return [[corner[k] for k in loop] for loop in LOOPS]

    blocks = concatenate([from_faces([wedge(*span)], [n], [0], ["units"]) for n, span in enumerate(SPANS(low, high))])
    result = mended(blocks).blocks
    assert find_joints(result).area.sum() == pytest.approx(0.1 * 0.05 / np.cos(angle), rel=1e-9)
    for b in range(2):
        assert bounds(result)[0][b, :2] == pytest.approx([0, 0], abs=1e-15)
        assert bounds(result)[1][b, :2] == pytest.approx([0.1, 0.05], abs=1e-15)


LOOPS = ((3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


def SPANS(low, high):
    return (0.02, low), (low + 0.05 * MM, high)
