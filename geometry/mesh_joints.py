"""Contact points at the nodes of a mesh: each joint triangle gives a third of its area to each of its corners."""

from dataclasses import dataclass, replace

import numpy as np

from geometry.blocks import Joints, TetMesh


@dataclass(frozen=True)
class PatchTriangles:
    """Surface meshes of joint polygons, in the mesher's own node tags.

    nodes       (., 3) m by tag
    triangles   joint polygon -> (., 3) tags
    block_tags  meshed block -> tags of its nodes, rising, in the order of the TetMesh
    """

    nodes: np.ndarray
    triangles: dict[int, np.ndarray]
    block_tags: dict[int, np.ndarray]


def mesh_joints(joints: Joints, mesh: TetMesh, surface: PatchTriangles) -> Joints:
    """The joints with the contact points of meshed polygons moved to the mesh nodes; in the order of polygons."""
    has_mesh = np.zeros(len(joints.patch_start) - 1, dtype=bool)
    has_mesh[list(surface.triangles)] = True
    kept = np.flatnonzero(~has_mesh[joints.patch])
    origin, tags, areas = [kept], [np.full(len(kept), -1)], [joints.area[kept]]
    first = np.searchsorted(joints.patch, np.arange(len(has_mesh)))
    for patch, triangles in surface.triangles.items():
        tag, area = _node_areas(surface.nodes, triangles)
        origin.append(np.full(len(tag), first[patch]))
        tags.append(tag)
        areas.append(area)
    source, tag, area = np.concatenate(origin), np.concatenate(tags), np.concatenate(areas)
    order = np.argsort(joints.patch[source], kind="stable")
    source, tag, area = source[order], tag[order], area[order]
    return replace(
        joints,
        block_a=joints.block_a[source],
        block_b=joints.block_b[source],
        node_a=_node_numbers(joints.block_a[source], tag, mesh, surface.block_tags),
        node_b=_node_numbers(joints.block_b[source], tag, mesh, surface.block_tags),
        point=np.where((tag >= 0)[:, None], surface.nodes[tag], joints.point[source]),
        normal=joints.normal[source],
        area=area,
        patch=joints.patch[source],
    )


def _node_areas(nodes: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Node tags of a surface mesh, rising, and the area (m2) that belongs to each."""
    a, b, c = (nodes[triangles[:, k]] for k in range(3))
    third = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 6
    tag, place = np.unique(triangles, return_inverse=True)
    return tag, np.bincount(place.ravel(), weights=np.repeat(third, 3), minlength=len(tag))


def _node_numbers(block: np.ndarray, tag: np.ndarray, mesh: TetMesh, block_tags: dict[int, np.ndarray]) -> np.ndarray:
    """(C,) number in the mesh of each tag's node within the block, -1 where the block or the point has none."""
    number = np.full(len(block), -1, dtype=np.int64)
    for b in np.intersect1d(block, list(block_tags)):
        here = (block == b) & (tag >= 0)
        number[here] = mesh.node_start[b] + np.searchsorted(block_tags[b], tag[here])
    return number
