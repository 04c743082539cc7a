"""Blocks that are not convex: a square tube and what stands in, on and through it."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.polyhedra.construct import concatenate, from_boxes, from_faces
from geometry.polyhedra.convexity import convex_pieces
from geometry.polyhedra.intersect import are_convex
from geometry.polyhedra.measures import volumes
from geometry.polyhedra.overlaps import check_overlaps
from geometry.polyhedra.shells import outward

SQUARE = np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]])


def sides(polygon, low=0.0, high=1.0):
    at = lambda p, z: np.array([*p, z])  # noqa: E731
    pairs = zip(polygon, np.roll(polygon, -1, axis=0), strict=True)
    return [np.array([at(p, low), at(q, low), at(q, high), at(p, high)]) for p, q in pairs]


def tube():
    """3 x 3 x 1 with a hole of 1 x 1 along z in the middle."""
    outer, hole = SQUARE * 3, SQUARE + 1
    caps = []
    for k in range(4):
        ring = np.array([outer[k], outer[(k + 1) % 4], hole[(k + 1) % 4], hole[k]])
        caps += [np.column_stack([ring, np.ones(4)]), np.column_stack([ring, np.zeros(4)])[::-1]]
    return from_faces([[*sides(outer), *sides(hole[::-1]), *caps]], [0], [0], ["units"])


def box(low, high):
    return from_boxes(low, high, [1], [0], ["units"])


def refused(*parts):
    try:
        check_overlaps(concatenate(parts))
    except GeometryError:
        return True
    return False


def test_a_tube_has_the_volume_of_its_walls_and_is_not_convex():
    assert volumes(tube()) == pytest.approx(8.0, rel=1e-14)
    assert are_convex(concatenate([tube(), box((5, 0, 0), (6, 1, 1))]), 1e-9).tolist() == [False, True]


@pytest.mark.parametrize(
    ("what", "low", "high", "overlaps"),
    [
        ("a plug that fits", (1, 1, 0), (2, 2, 1), False),
        ("a plug that sticks out", (1, 1, -1), (2, 2, 3), False),
        ("a loose plug", (1.2, 1.2, 0.2), (1.8, 1.8, 0.8), False),
        ("a plug too wide by a micrometre", (1, 1, 0), (2 + 1e-6, 2, 1), True),
        ("a lid", (0, 0, 1), (3, 3, 2), False),
        ("a lid that sinks in", (0, 0, 1 - 1e-6), (3, 3, 2), True),
        ("a bar through the walls", (-1, 1.2, 0.2), (4, 1.8, 0.8), True),
        ("a bar flush with the hole's walls", (-1, 1, 0), (4, 2, 1), True),
        ("a box within one wall", (0.2, 0.2, 0.2), (0.8, 0.8, 0.8), True),
        ("a box round all", (-1, -1, -1), (4, 4, 2), True),
        ("a neighbour", (3, 0, 0), (4, 3, 1), False),
        ("a quarter of it", (0, 0, 0), (1, 1, 1), True),
    ],
)
def test_what_stands_in_the_hole_of_a_tube_does_not_overlap_it(rotate, what, low, high, overlaps):
    for degrees in (0.0, 33.0):
        pair, _ = rotate(concatenate([tube(), box(low, high)]), degrees)
        assert refused(pair) is overlaps, what


def test_two_tubes_in_one_place_overlap_and_two_on_each_other_do_not(rotate):
    other, _ = rotate(tube(), 0.0, shift=(0, 0, 1))
    assert refused(tube(), tube())
    assert not refused(tube(), other)


def test_triangles_of_a_tube_become_few_convex_pieces_with_the_same_volume():
    points, number = np.unique(np.concatenate([f for f in tube_triangles()]), axis=0, return_inverse=True)
    triangles = number.reshape(-1, 3)
    turned = triangles.copy()
    turned[::3] = turned[::3, ::-1]
    looking = outward(points, turned, "the tube")
    pieces = [points[p] for p in convex_pieces(points, looking, 1e-9)]
    merged = from_faces([pieces], [0], [0], ["units"])
    assert volumes(merged) == pytest.approx(8.0, rel=1e-14)
    assert len(pieces) <= 8 + 2 * 8
    assert sum(len(piece) == 4 for piece in pieces) >= 8


def tube_triangles():
    block = tube()
    for f in block.faces_of(0):
        face = block.face(f)
        for k in range(1, len(face) - 1):
            yield np.stack([face[0], face[k], face[k + 1]])


def test_a_solid_with_a_missing_or_a_twisted_face_is_refused_by_name():
    points, number = np.unique(np.concatenate(list(tube_triangles())), axis=0, return_inverse=True)
    triangles = number.reshape(-1, 3)
    with pytest.raises(GeometryError, match="the tube is not closed"):
        outward(points, triangles[1:], "the tube")


def test_a_cavity_counts_against_the_volume():
    def shell(low, high):
        block = box(low, high)
        return [block.face(f) for f in block.faces_of(0)]

    faces = [*shell((0, 0, 0), (3, 3, 3)), *shell((1, 1, 1), (2, 2, 2))]
    triangles = [np.stack([f[0], f[k], f[k + 1]]) for f in faces for k in (1, 2)]
    points, number = np.unique(np.concatenate(triangles), axis=0, return_inverse=True)
    looking = outward(points, number.reshape(-1, 3), "the box")
    arm = points[looking]
    assert np.einsum("ti,ti->", arm[:, 0], np.cross(arm[:, 1], arm[:, 2])) / 6 == pytest.approx(26.0, rel=1e-14)


@pytest.mark.parametrize("dent", [0.0, 0.05])
def test_a_scan_of_many_triangles_is_known_as_convex_or_not_in_little_memory(dent):
    """Corners times faces would be 630 MB."""
    import tracemalloc

    import trimesh

    ball = trimesh.creation.icosphere(4)
    points = np.array(ball.vertices)
    points[0] *= 1 - dent
    blocks = from_faces([list(points[ball.faces])], [0], [0], ["units"])
    tracemalloc.start()
    assert are_convex(blocks, 1e-9).tolist() == [dent == 0.0]
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 50e6
