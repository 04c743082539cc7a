"""Convex pieces: of blocks that are convex, cut in triangles, or not convex."""

import numpy as np
import pytest

from geometry.polyhedra.construct import from_faces
from geometry.polyhedra.convexity import convex_pieces
from geometry.polyhedra.measures import centroids
from masonry.detection.narrow import NONE
from masonry.detection.pieces import pieces_of
from tests.detection.touching import Bodies, box_blocks, cells, subset


def prism(outline, low: float, high: float, cut=None) -> list[np.ndarray]:
    """Faces of a prism over a polygon (n, 2); its ends are cut into convex pieces."""
    bottom, top = (np.column_stack([outline, np.full(len(outline), z)]) for z in (low, high))
    ends = cut or [list(range(len(outline)))]
    faces = [bottom[piece][::-1] for piece in ends] + [top[piece] for piece in ends]
    after = np.roll(np.arange(len(outline)), -1)
    return faces + [np.array([bottom[i], bottom[j], top[j], top[i]]) for i, j in enumerate(after)]


ELL = np.array([[0.0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]])
ELL_ENDS = [[0, 1, 2, 3], [0, 3, 4, 5]]


def volume(pieces, p: int) -> float:
    total = 0.0
    for f in range(pieces.face_start[p], pieces.face_start[p + 1]):
        loop = pieces.vertex[pieces.loop[pieces.loop_start[f] : pieces.loop_start[f + 1]]]
        for k in range(1, len(loop) - 1):
            total += np.linalg.det(loop[[0, k, k + 1]]) / 6
    return total


def blocks_of(*faces):
    return from_faces(faces, list(range(len(faces))), [0] * len(faces), ["units"])


def test_convex_blocks_are_one_piece_each_with_all_edges():
    pieces = pieces_of(cells(25, 1))
    assert len(pieces.body) == 25 and not pieces.inner.any()
    assert sum(volume(pieces, p) for p in range(25)) == pytest.approx(1.0, rel=1e-12)
    corners, faces, edges = (np.diff(s) for s in (pieces.vertex_start, pieces.face_start, pieces.edge_start))
    assert np.all(corners + faces - edges == 2)  # Euler


def test_a_face_that_was_cut_into_triangles_is_one_again():
    box = box_blocks(np.zeros((1, 3)), np.ones((1, 3)))
    triangles = [t for f in range(6) for t in (box.face(f)[[0, 1, 2]], box.face(f)[[0, 2, 3]])]
    pieces = pieces_of(blocks_of(triangles))
    assert len(pieces.normal) == 6 and len(pieces.edge) == 12 and len(pieces.vertex) == 8


def test_an_ell_is_cut_into_convex_pieces_that_fill_it():
    pieces = pieces_of(blocks_of(prism(ELL, 0, 1, ELL_ENDS)))
    assert len(pieces.body) == 2 and np.all(pieces.body == 0)
    assert sum(volume(pieces, p) for p in range(2)) == pytest.approx(3.0, rel=1e-12)
    assert len(pieces.edge) == 12 + 8 and not pieces.inner[pieces.edge[:, 2:]].any()
    assert pieces.inner.sum() == 1  # the other side of the cut is longer than the face that covers it


def test_a_ring_is_cut_into_convex_pieces_that_fill_it():
    angle = np.linspace(0, 2 * np.pi, 9)[:-1]
    outer, inner = (r * np.column_stack([np.cos(angle), np.sin(angle)]) for r in (2.0, 1.0))
    faces = []
    for i in range(8):
        j = (i + 1) % 8
        quad = np.array([inner[i], outer[i], outer[j], inner[j]])
        faces += [np.c_[quad, np.zeros(4)][::-1], np.c_[quad, np.ones(4)]]
        for a, b in ((outer[i], outer[j]), (inner[j], inner[i])):
            faces.append(np.array([[*a, 0], [*b, 0], [*b, 1], [*a, 1]]))
    pieces = pieces_of(blocks_of(faces))
    area = 8 * np.sin(np.pi / 4) / 2 * 3
    assert sum(volume(pieces, p) for p in range(len(pieces.body))) == pytest.approx(area, rel=1e-9)
    assert pieces.inner.sum() >= 8


def test_a_block_on_the_pieces_of_a_body_feels_no_seam():
    """Wherever it lies over the cuts, the areas add up, and nothing pushes sideways."""
    slab = prism(np.array([[0.2, 0.3], [1.2, 0.3], [1.2, 1.3], [0.2, 1.3]]), 1.0, 1.5)
    for shift in np.linspace(-0.3, 0.4, 15):
        bodies = Bodies(blocks_of(prism(ELL, 0, 1, ELL_ENDS), slab))
        bodies.put(1, bodies.position[1] + [shift, -0.5 * shift, -1e-5])
        x, y = 0.2 + shift, 0.3 - 0.5 * shift
        shared = max(0.0, min(x + 1, 2) - x) * max(0.0, min(y + 1, 1) - y) if y < 1 else 0.0
        shared += max(0.0, min(x + 1, 1) - max(x, 0)) * (y + 1 - max(y, 1))
        shared -= max(0.0, -x) * max(0.0, min(y + 1, 1) - y)
        contacts = [bodies.touch(p, 2, skin=0.1, reach=0.1) for p in range(2)]
        assert sum(f.area.sum() for f in contacts) == pytest.approx(shared, rel=1e-9)
        assert all(f.kind == NONE or np.allclose(f.axis, [0, 0, 1], atol=1e-9) for f in contacts)


def test_order_by_place_does_not_depend_on_the_numbers():
    blocks = cells(20, 3)
    pieces, mixed = pieces_of(blocks), np.random.default_rng(4).permutation(20)
    assert np.array_equal(pieces_of(subset(blocks, mixed)).rank, pieces.rank[mixed])
    middle = [np.unique(pieces_of(subset(blocks, [b])).vertex, axis=0).mean(axis=0)[0] for b in range(20)]
    along = np.array(middle) + centroids(blocks)[:, 0]
    assert np.all(np.diff(along[np.argsort(pieces.rank)]) > -1e-12)


def test_the_ends_of_the_ell_are_the_convex_pieces_of_its_face():
    fan = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]])
    assert len(convex_pieces(np.c_[ELL, np.zeros(6)], fan, 1e-9)) == len(ELL_ENDS)
