"""Where the surface triangles of tets lie on each other, and on the faces of blocks without tets."""

from dataclasses import dataclass, replace

import numpy as np

from geometry.blocks import Blocks, GeometryError, Joints, TetMesh
from geometry.joints.boundary import TET_FACES
from geometry.joints.find import face_joints
from geometry.joints.point_density import Density
from geometry.polyhedra.indexing import ranges
from geometry.polyhedra.measures import extent
from geometry.polyhedra.polygons import areas_normals_centroids, pad

FILLED = 1e-6
"""Of the area of a joint: by how much the triangles on it may miss it."""
WIDTH = 1e-9
"""Of the longest side: how far an overlap of triangles may be from the joint polygon that it lies in."""


@dataclass(frozen=True)
class OverlapPieces:
    """Overlap polygons of the surface triangles and faces of blocks that touch.

    corner, count  (Q, K, 3) m and (Q,) padded polygons
    area, parent   (Q,) m2, and the joint polygon of the blocks that each lies in
    faces          (Q, 2) faces of the surface of block a and of block b
    nodes      (F, 3) tet nodes of the faces of the surface, -1 where a face is no triangle of tets
    tet_nodes  (N, 3) m
    """

    corner: np.ndarray
    count: np.ndarray
    area: np.ndarray
    parent: np.ndarray
    faces: np.ndarray
    nodes: np.ndarray
    tet_nodes: np.ndarray

    def meshed(self, side: int) -> np.ndarray:
        """(Q,) whether an overlap has tets on a side."""
        return self.nodes[self.faces[:, side], 0] >= 0

    def places(self, side: int) -> np.ndarray:
        """(Q, 3, 3) m, corners of the surface triangle on a side; of no meaning where there are no tets."""
        return self.tet_nodes[self.nodes[self.faces[:, side]]]


def find_pieces(blocks: Blocks, joints: Joints, mesh: TetMesh) -> OverlapPieces:
    """Every overlap of two triangles, or of a triangle and a face; joints are those of the blocks themselves.

    Raises GeometryError if the tets reach beyond the faces of their block, or do not fill them.
    """
    surface, nodes = tet_surface(blocks, mesh)
    fine, faces = face_joints(surface, Density("gauss", 1))
    corner, count = pad(fine.patch_points, fine.patch_start, np.arange(len(fine.patch_points)))
    area, _, middle = areas_normals_centroids(corner)
    parent = _parents(joints, fine, middle, WIDTH * extent(blocks))
    pieces = OverlapPieces(corner, count, area, parent, faces, nodes, mesh.nodes)
    _require_covered(joints, pieces)
    return pieces


def tet_surface(blocks: Blocks, mesh: TetMesh) -> tuple[Blocks, np.ndarray]:
    """The blocks with the surface triangles of their tets as faces; nodes (F, 3) of these, -1 on other faces."""
    owner = np.repeat(np.arange(blocks.count), np.diff(mesh.tet_start))
    face = mesh.tets[:, TET_FACES].reshape(-1, 3)
    ordered = np.sort(face, axis=1)
    _, place, times = np.unique(ordered, axis=0, return_inverse=True, return_counts=True)
    outer = times[place.ravel()] == 1
    triangle, of = face[outer], np.repeat(owner, 4)[outer]
    unmeshed = np.flatnonzero(np.diff(mesh.tet_start)[blocks.face_block()] == 0)
    size = np.diff(blocks.face_start)[unmeshed]
    _, corner = ranges(blocks.face_start[unmeshed], size)
    face_block = np.concatenate([blocks.face_block()[unmeshed], of])
    order = np.argsort(face_block, kind="stable")
    sizes = np.concatenate([size, np.full(len(triangle), 3)])
    start = np.cumsum(sizes) - sizes
    corners = np.concatenate([blocks.face_points[corner], triangle.ravel() + len(blocks.points)])
    _, index = ranges(start[order], sizes[order])
    surface = replace(
        blocks,
        points=np.concatenate([blocks.points, mesh.nodes]),
        face_start=np.concatenate([[0], np.cumsum(sizes[order])]),
        face_points=corners[index],
        block_face_start=np.searchsorted(face_block[order], np.arange(blocks.count + 1)),
    )
    nodes = np.concatenate([np.full((len(unmeshed), 3), -1), triangle])[order]
    return surface, nodes


def _parents(joints: Joints, fine: Joints, middle: np.ndarray, width: float) -> np.ndarray:
    """(Q,) the joint polygon that each overlap of triangles, with centroid middle (Q, 3), lies in."""
    first = np.searchsorted(fine.patch, np.arange(len(middle)))
    count = len(joints.patch_start) - 1
    of = np.searchsorted(joints.patch, np.arange(count))
    blocks = int(max(joints.block_b.max(initial=0), fine.block_b.max(initial=0))) + 1
    key = joints.block_a[of] * blocks + joints.block_b[of]
    order = np.argsort(key, kind="stable")
    pair_key = fine.block_a[first] * blocks + fine.block_b[first]
    begin, end = (np.searchsorted(key[order], pair_key, side=side) for side in ("left", "right"))
    polygon, _ = pad(joints.patch_points, joints.patch_start, np.arange(len(joints.patch_points)))
    normal = joints.normal[of]
    edge = np.roll(polygon, -1, axis=1) - polygon
    length = np.linalg.norm(edge, axis=2, keepdims=True)
    orientation = np.sign(np.einsum("ji,ji->j", areas_normals_centroids(polygon)[1], normal))
    inward = np.cross(normal[:, None] * orientation[:, None, None], edge / np.where(length > 0, length, 1.0))
    parent, nearest = np.full(len(middle), -1), np.full(len(middle), np.inf)
    for k in range(int((end - begin).max(initial=0))):
        which = np.flatnonzero(begin + k < end)
        p = order[begin[which] + k]
        arm = middle[which, None] - polygon[p]
        outside = -np.einsum("nki,nki->nk", arm, inward[p]).min(axis=1)
        distance = np.maximum(outside, np.abs(np.einsum("ni,ni->n", arm[:, 0], normal[p])))
        distance[np.einsum("ni,ni->n", normal[p], fine.normal[first[which]]) < 0.999] = np.inf
        better = distance < nearest[which]
        parent[which[better]], nearest[which[better]] = p[better], distance[better]
    if np.any(nearest > width):
        block = int(fine.block_a[first[int(np.argmax(nearest))]])
        raise GeometryError(f"the tets of block {block} reach beyond its faces")
    return parent


def _require_covered(joints: Joints, pieces: OverlapPieces) -> None:
    touched = np.bincount(pieces.parent, pieces.meshed(0) | pieces.meshed(1), len(joints.patch_start) - 1) > 0
    whole = np.bincount(joints.patch, joints.area, len(touched))
    covered = np.bincount(pieces.parent, pieces.area, len(touched))
    short = touched & (np.abs(covered - whole) > FILLED * whole)
    if short.any():
        patch = int(np.argmax(short))
        block = int(joints.block_a[np.searchsorted(joints.patch, patch)])
        raise GeometryError(
            f"surface triangles cover {covered[patch]:.6g} m2 of a joint of {whole[patch]:.6g} m2 on block {block}: "
            "its tets do not fill it"
        )
