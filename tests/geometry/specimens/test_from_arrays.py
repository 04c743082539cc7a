"""Blocks from vertices and faces: however they are given, the body is the same; what is no body is refused."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.joints.find import find_joints
from geometry.joints.heal import mend
from geometry.polyhedra.measures import centroids, volumes
from geometry.polyhedra.overlaps import check_overlaps
from geometry.polyhedra.validate import require_sound
from geometry.specimens.from_arrays import polyhedra

QUADS = [[0, 1, 2, 3], [7, 6, 5, 4], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]]
CUBE = np.array([[0, 0, 0], [0, 1, 0], [1, 1, 0], [1, 0, 0], [0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]], dtype=float)


def build(*solids):
    count = len(solids)
    specimen = polyhedra(solids, [f"stone {b}" for b in range(count)], range(count), ["units"] * count)
    require_sound(specimen)
    return specimen


def in_triangles(faces):
    return np.array([[face[0], face[k], face[k + 1]] for face in faces for k in range(1, len(face) - 1)])


def prism(outline, low, high):
    """Vertices and faces of a prism over an outline (n, 2), whose end faces are polygons of n corners."""
    n = len(outline)
    points = np.concatenate([np.insert(np.asarray(outline, dtype=float), 2, z, axis=1) for z in (low, high)])
    sides = [[i, (i + 1) % n, (i + 1) % n + n, i + n] for i in range(n)]
    return points, [list(range(n)), list(range(n, 2 * n)), *sides]


GIVEN = {
    "polygons": (CUBE, QUADS),
    "looking inwards": (CUBE, [face[::-1] for face in QUADS]),
    "numbered as it came": (CUBE, [face[:: (-1) ** k] for k, face in enumerate(QUADS)]),
    "triangles": (CUBE, in_triangles(QUADS)),
    "lists": (CUBE.tolist(), QUADS),
    "corners of their own for each face": (CUBE[np.array(QUADS).ravel()], np.arange(24).reshape(6, 4)),
    "a corner on an edge": (
        np.vstack([CUBE, [0.5, 0.0, 0.0]]),
        [[0, 1, 2, 3, 8], QUADS[1], QUADS[2], QUADS[3], QUADS[4], [3, 7, 4, 0, 8]],
    ),
}


@pytest.mark.parametrize("given", GIVEN.values(), ids=GIVEN)
def test_a_cube_is_a_cube_however_it_is_given(given):
    blocks = build(given)
    assert volumes(blocks) == pytest.approx([1.0], rel=1e-15)
    assert centroids(blocks)[0] == pytest.approx([0.5, 0.5, 0.5], rel=1e-15)
    assert sorted(len(blocks.face(f)) for f in blocks.faces_of(0)) == [4] * 6


def test_a_polygon_that_is_not_convex_keeps_its_volume_and_touches_what_lies_on_it():
    outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    below, above = prism(outline, 0, 1), prism([(0, 0), (2, 0), (2, 2), (0, 2)], 1, 2)
    blocks = build(below, above)
    assert volumes(blocks) == pytest.approx([3.0, 4.0], rel=1e-14)
    check_overlaps(blocks)
    joints = find_joints(blocks)
    assert joints.area.sum() == pytest.approx(3.0, rel=1e-12)
    assert np.all(joints.normal[:, 2] == 1.0)


def test_voussoirs_whose_corners_are_computed_one_by_one_meet_in_whole_joints():
    def voussoir(k, count=9):
        a, b = (np.pi * j / count for j in (k, k + 1))
        ring = [(r * np.cos(t), r * np.sin(t)) for r, t in ((1.0, a), (1.2, a), (1.2, b), (1.0, b))]
        points = np.array([(x, y, z) for y in (0.0, 0.3) for x, z in ring])
        return points, QUADS

    blocks = build(*[voussoir(k) for k in range(9)])
    joints = find_joints(blocks)
    assert len(joints.patch_start) - 1 == 8
    assert joints.area.sum() == pytest.approx(8 * 0.2 * 0.3, rel=1e-12)


def test_numbers_of_single_precision_make_the_same_joints_once_they_are_mended():
    def stone(k):
        outline = [(0.1, 0.2), (0.7, 0.1), (0.9, 0.5), (0.3, 0.8)]
        points, faces = prism(outline, 0.3 * k, 0.3 * (k + 1))
        turned = points @ np.array([[0.8, 0.6, 0.0], [-0.6, 0.8, 0.0], [0.0, 0.0, 1.0]])
        return turned.astype(np.float32), in_triangles(faces)

    blocks = build(*[stone(k) for k in range(3)])
    mended = mend(blocks, 1e-4, ["a", "b", "c"]).blocks
    exact = build(*[prism([(0.1, 0.2), (0.7, 0.1), (0.9, 0.5), (0.3, 0.8)], 0.3 * k, 0.3 * (k + 1)) for k in range(3)])
    assert find_joints(mended).area.sum() == pytest.approx(find_joints(exact).area.sum(), rel=1e-6)


BAD = {
    "no lid": ((CUBE, QUADS[:5]), "stone 0 is not closed"),
    "three faces": ((CUBE, QUADS[:3]), "faces must be 4 or more lists of vertex numbers, there are 3"),
    "no faces": ((CUBE, 3), "faces must be 4 or more"),
    "a bent face": (
        (CUBE + 0.01 * np.eye(8)[6][:, None], QUADS),
        r"stone 0: face 1 is not flat: a corner stands 0\.00",
    ),
    "a vertex that is not there": ((CUBE, [[0, 1, 2, 8], *QUADS[1:]]), r"face 0 names vertices .*allowed: 0 to 7"),
    "a negative number": ((CUBE, [[0, 1, 2, -1], *QUADS[1:]]), r"face 0 names vertices .*allowed: 0 to 7"),
    "an edge": ((CUBE, [[0, 1], *QUADS]), "face 0 must be a list of 3 or more vertex numbers"),
    "numbers with a point": ((CUBE, [[0.0, 1.0, 2.0], *QUADS]), "face 0 must be a list of 3 or more vertex numbers"),
    "a corner twice": ((CUBE, [[0, 1, 1, 0], *QUADS]), "face 0 has fewer than 3 corners that differ"),
    "a plane": ((CUBE[:, :2], QUADS), r"vertices must be 4 or more points \(V, 3\) in m, not of the shape \(8, 2\)"),
    "words": ((["a", "b"], QUADS), "vertices must be 4 or more points"),
    "not a number": ((np.where(CUBE == 1, np.nan, CUBE), QUADS), "vertex 1 is .*nan.*, allowed: up to 1e"),
    "far away": ((CUBE * 1e12, QUADS), "allowed: up to 1e"),
    "two bodies": (
        (np.vstack([CUBE, CUBE + 3]), [*QUADS, *(np.array(QUADS) + 8).tolist()]),
        "stone 0 consists of 2 bodies that do not touch",
    ),
    "a bow tie": ((CUBE, [[0, 2, 1, 3], *QUADS[1:]]), "stone 0: face 0: a face .* cannot be cut into triangles"),
}


@pytest.mark.parametrize(("given", "message"), BAD.values(), ids=BAD)
def test_what_is_no_body_is_refused_and_the_block_is_named(given, message):
    with pytest.raises(GeometryError, match=message):
        build(given)
