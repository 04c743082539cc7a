"""The convex pieces that bodies consist of, as flat arrays in the frames of their bodies.

A point of a body at X, from its centroid, is at x = position + frame @ X: frame is a rotation, or the deformation
gradient of an affine block, which stays convex; normals turn with the cofactor of the frame.
"""

from typing import NamedTuple

import numpy as np

from geometry.blocks import Blocks, GeometryError
from geometry.polyhedra.intersect import are_convex
from geometry.polyhedra.measures import centroids, extent
from geometry.polyhedra.polygons import areas_normals_centroids, pad
from masonry.detection.convex_parts import NEAR, Convex, convex_block, convex_parts, covered, welded
from masonry.detection.features import MOST_CORNERS, MOST_FACES
from masonry.detection.tet_pieces import SurfaceTets, as_pieces

SNAP, SNAP_OF_TETS = 1e-12, 5e-4
"""Of the radius of a piece. Triangles of two meshes that match lie on each other but for elastic slips: where their
edges crossed, the areas of corners would change with each of them, and with those the energy of an uneven pressure."""
EQUAL_PLACES = 6
"""Digits of a place, in sizes of a block, by which blocks are put in order: rounding is no difference."""


class ConvexPieces(NamedTuple):
    """P convex pieces of N bodies, with V corners, F faces and E edges in all.

    body          (P,) number of the body; its pieces are piece_start[body]..piece_start[body + 1]
    piece_start   (N + 1,)
    rank          (P,) order of the pieces by their place in the specimen, whatever their numbers; where some are tets,
                  by number: which of two triangles is snapped to the other one is then the same however all is turned
    vertex_start  (P + 1,) corners of piece p in vertex
    vertex        (V, 3) m, from the body's centroid
    face_start    (P + 1,) faces of piece p
    loop_start    (F + 1,) corners of face f in loop
    loop          numbers into vertex, counter-clockwise seen from outside
    normal        (F, 3) outward unit normals
    inner         (F,) True where other pieces of the body cover the face: never a contact face
    edge_start    (P + 1,) edges of piece p
    edge          (E, 4) two corners, two faces; edges of inner faces are left out
    centre        (P, 3) m, mean of the corners, from the body's centroid
    radius        (P,) m, from the centre to the farthest corner
    reach         (N,) m, from a body's centroid to its farthest corner
    block         (N,) the block that a body is: itself, or of a tet the one that it belongs to
    snap          (P,) of the radius: corners that are nearer to a line of the clip lie on it
    """

    body: np.ndarray
    piece_start: np.ndarray
    rank: np.ndarray
    vertex_start: np.ndarray
    vertex: np.ndarray
    face_start: np.ndarray
    loop_start: np.ndarray
    loop: np.ndarray
    normal: np.ndarray
    inner: np.ndarray
    edge_start: np.ndarray
    edge: np.ndarray
    centre: np.ndarray
    radius: np.ndarray
    reach: np.ndarray
    block: np.ndarray
    snap: np.ndarray


def pieces_of(blocks: Blocks, tets: SurfaceTets | None = None, nodes: np.ndarray | None = None) -> ConvexPieces:
    """The convex pieces of some blocks: one for a convex block, several for another; of a meshed one its outer tets.

    tets, nodes  the bodies behind those of the blocks, and (., 3) m the nodes of their mesh. A block with such tets has
                 no pieces of its own
    Raises GeometryError where a piece has too many faces or corners of a face.
    """
    origin = centroids(blocks)
    convex = are_convex(blocks, NEAR * extent(blocks))
    pieces: list[tuple[int, Convex, list[bool]]] = []
    together = welded(blocks)
    meshed = set() if tets is None else set(tets.block.tolist())
    for b in range(blocks.count):
        if b in meshed:
            continue
        if convex[b]:
            part = convex_block(blocks, b, together)
            pieces.append((b, part, [False] * len(part.loops)))
            continue
        parts = convex_parts(blocks, b)
        width = NEAR * extent(blocks)
        for k, part in enumerate(parts):
            pieces.append((b, part, covered(part, parts[:k] + parts[k + 1 :], width)))
    for b, part, _ in pieces:
        if len(part.loops) > MOST_FACES or max(map(len, part.loops)) > MOST_CORNERS:
            raise GeometryError(
                f"block {b} (unit {blocks.unit[b]}) has {len(part.loops)} faces, of up to {max(map(len, part.loops))} "
                f"corners; at most {MOST_FACES} faces of {MOST_CORNERS} corners can be detected"
            )
    block = np.arange(blocks.count)
    if tets is None or nodes is None:
        return _flat(pieces, origin, block)
    pieces += as_pieces(tets, nodes, blocks.count)
    return _flat(pieces, np.concatenate([origin, tets.centre]), np.concatenate([block, tets.block]))


def _flat(pieces: list[tuple[int, Convex, list[bool]]], origin: np.ndarray, block: np.ndarray) -> ConvexPieces:
    """All pieces in one set of arrays; block (N,) of the bodies."""
    body = np.array([b for b, _, _ in pieces], dtype=np.int64)
    vertices = [part.corners - origin[b] for b, part, _ in pieces]
    vertex_start = _starts(len(v) for v in vertices)
    face_start = _starts(len(part.loops) for _, part, _ in pieces)
    loops = [np.array(loop) + vertex_start[p] for p, (_, part, _) in enumerate(pieces) for loop in part.loops]
    vertex, inner = np.concatenate(vertices), np.array([x for _, _, flags in pieces for x in flags], dtype=bool)
    loop_start, loop = _starts(map(len, loops)), np.concatenate(loops)
    normal = areas_normals_centroids(pad(vertex, loop_start, loop)[0])[1]
    edges = [_edges(loops, face_start[p], face_start[p + 1], inner) for p in range(len(pieces))]
    centre = np.array([v.mean(axis=0) for v in vertices])
    radius = np.array([np.linalg.norm(v - c, axis=1).max() for v, c in zip(vertices, centre, strict=True)])
    far = np.maximum.reduceat(np.linalg.norm(vertex, axis=1), vertex_start[:-1])
    reach = np.zeros(len(origin))
    np.maximum.at(reach, body, far)
    place, meshed = centre + origin[body], not np.array_equal(block, np.arange(len(block)))
    rank = np.empty(len(pieces), dtype=np.int64)
    by_place = np.lexsort(np.round(place / radius.mean(), EQUAL_PLACES).T[::-1])
    rank[np.arange(len(pieces)) if meshed else by_place] = np.arange(len(pieces))
    return ConvexPieces(
        body, np.searchsorted(body, np.arange(len(origin) + 1)), rank, vertex_start, vertex, face_start,
        loop_start, loop, normal, inner, _starts(map(len, edges)),
        np.array([edge for some in edges for edge in some], dtype=np.int64).reshape(-1, 4), centre, radius, reach,
        block, np.where(block[body] == body, SNAP, SNAP_OF_TETS),
    )  # fmt: skip


def _starts(counts) -> np.ndarray:
    return np.cumsum([0, *counts]).astype(np.int64)


def _edges(loops: list[np.ndarray], first: int, last: int, inner: np.ndarray) -> list[tuple[int, int, int, int]]:
    """Edges of one piece between two faces that are both free: corners and faces."""
    side: dict[tuple[int, int], int] = {}
    for f in range(first, last):
        loop = loops[f].tolist()
        side.update({edge: f for edge in zip(loop, [*loop[1:], loop[0]], strict=True)})
    return [
        (a, b, f, side[b, a])
        for (a, b), f in side.items()
        if a < b and (b, a) in side and not inner[f] and not inner[side[b, a]]
    ]
