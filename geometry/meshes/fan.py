"""Tets without a mesher: from the centroid of each block to the triangles on its faces, matched across joints."""

import numpy as np

from geometry.blocks import Blocks, GeometryError, Joints, TetMesh
from geometry.meshes.mesh_joints import joints_at_nodes
from geometry.meshes.skeleton import Imprint, imprint
from geometry.meshes.surface_triangles import surface_triangles
from geometry.polyhedra.indexing import ranges
from geometry.polyhedra.measures import centroids, volumes

THINNEST = 1e-9
"""Of the block's volume: the least tet."""


def mesh_by_fans(blocks: Blocks, meshed: np.ndarray, joints: Joints) -> tuple[TetMesh, Joints]:
    """A fan of tets in each meshed block (B,), and the joints with points at their nodes, as by mesher.mesh_blocks.

    One triangulation of each joint polygon serves both blocks, so their nodes coincide there. Raises GeometryError for
    a block that is not seen whole from its centroid, and for a face that goes all round a joint.
    """
    meshed = np.asarray(meshed, dtype=bool)
    skeleton = imprint(blocks, meshed, joints)
    _require_whole_faces(blocks, skeleton)
    points, triangle, surface = surface_triangles(skeleton.vertices, skeleton.loops)
    order = np.argsort(surface, kind="stable")
    triangle, surface = triangle[order], surface[order]
    patch = np.full(len(skeleton.surface_start) - 1, -1)
    on = np.flatnonzero(skeleton.patch_surface >= 0)
    patch[skeleton.patch_surface[on]] = on
    owner, t = _faces_of_blocks(skeleton, surface)
    base = len(points)
    points = np.concatenate([points, centroids(blocks)])
    inward = owner == np.append(_side_b(joints), -1)[patch[surface[t]]]  # patch -1, a free face: looks outward
    corner = np.where(inward[:, None], triangle[t][:, ::-1], triangle[t])
    _require_filled(blocks, owner, points, corner, base)
    tet = np.column_stack([base + owner, corner])
    key, number = np.unique(owner[:, None] * len(points) + tet, return_inverse=True)
    every = np.arange(blocks.count + 1)
    mesh = TetMesh(
        nodes=points[key % len(points)],
        node_start=np.searchsorted(key, every * len(points)),
        tets=number.reshape(-1, 4),
        tet_start=np.searchsorted(owner, every),
    )
    mine = patch[surface] >= 0
    return mesh, joints_at_nodes(joints, points, triangle[mine], patch[surface[mine]], key)


def _require_whole_faces(blocks: Blocks, skeleton: Imprint) -> None:
    has_holes = np.diff(skeleton.surface_start) > 1
    holed = np.flatnonzero(has_holes[skeleton.block_surfaces.entry])
    if len(holed):
        b = int(np.searchsorted(skeleton.block_surfaces.start, holed[0], side="right")) - 1
        raise GeometryError(
            f"a fan of tets cannot fill block {b} (unit {blocks.unit[b]}): a face of it goes all round a joint; "
            "mesh it by mesh_size"
        )


def _faces_of_blocks(skeleton: Imprint, surface: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Block and triangle of every triangle on every block, block by block; surface (M,) of each triangle, rising."""
    first, entry = np.searchsorted(surface, np.arange(len(skeleton.surface_start))), skeleton.block_surfaces.entry
    block = np.repeat(np.arange(skeleton.block_surfaces.count), skeleton.block_surfaces.lengths)
    pair, triangle = ranges(first[entry], np.diff(first)[entry])
    return block[pair], triangle


def _side_b(joints: Joints) -> np.ndarray:
    """(J,) the second block of each joint polygon; its surface looks outward from the first."""
    side = np.zeros(len(joints.patch_start) - 1, dtype=np.int64)
    side[joints.patch] = joints.block_b
    return side


def _require_filled(blocks: Blocks, owner: np.ndarray, points: np.ndarray, corner: np.ndarray, base: int) -> None:
    """Every tet from the block's centroid has a volume above zero, and together they fill the block."""
    arm = points[corner] - points[base + owner][:, None]
    volume = np.einsum("ti,ti->t", arm[:, 0], np.cross(arm[:, 1], arm[:, 2])) / 6
    whole = volumes(blocks)
    flat = np.flatnonzero(volume <= THINNEST * whole[owner])
    if len(flat):
        b = int(owner[flat[0]])
        raise GeometryError(
            f"a fan of tets cannot fill block {b} (unit {blocks.unit[b]}): its centroid does not see all of its faces; "
            "mesh it by mesh_size"
        )
