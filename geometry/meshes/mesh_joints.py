"""Contact points at the nodes of a mesh: each joint triangle gives a third of its area to each of its corners."""

from dataclasses import dataclass, replace

import numpy as np

from geometry.blocks import Joints


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


def mesh_joints(joints: Joints, surface: PatchTriangles) -> Joints:
    """The joints with the contact points of meshed polygons moved to the mesh nodes; in the order of polygons."""
    empty = np.zeros((0, 3), dtype=np.int64)
    patches = np.array(sorted(surface.triangles), dtype=np.int64)
    triangle = np.concatenate([empty, *(surface.triangles[p] for p in patches.tolist())])
    patch = np.repeat(patches, [len(surface.triangles[p]) for p in patches.tolist()])
    count = len(surface.nodes)
    keys = np.concatenate([[], *(b * count + surface.block_tags[b] for b in sorted(surface.block_tags))])
    return joints_at_nodes(joints, surface.nodes, triangle, patch, keys.astype(np.int64))


def joints_at_nodes(
    joints: Joints, points: np.ndarray, triangle: np.ndarray, patch: np.ndarray, node_key: np.ndarray
) -> Joints:
    """The same from triangles (M, 3) of points (P, 3) and their joint polygons (M,).

    node_key  (N,) block * P + point of every mesh node, in the order of the mesh, rising
    """
    a, b, c = (points[triangle[:, k]] for k in range(3))
    third = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 6
    pair, place = np.unique((patch[:, None] * len(points) + triangle).ravel(), return_inverse=True)
    meshed, point = np.divmod(pair, len(points))
    has_mesh = np.zeros(len(joints.patch_start) - 1, dtype=bool)
    has_mesh[meshed] = True
    unmeshed = np.flatnonzero(~has_mesh[joints.patch])
    first = np.searchsorted(joints.patch, np.arange(len(has_mesh)))
    source = np.concatenate([unmeshed, first[meshed]])
    point = np.concatenate([np.full(len(unmeshed), -1), point])
    area = np.concatenate([joints.area[unmeshed], np.bincount(place, np.repeat(third, 3), len(pair))])
    order = np.argsort(joints.patch[source], kind="stable")
    source, point, area = source[order], point[order], area[order]
    return replace(
        joints,
        block_a=joints.block_a[source],
        block_b=joints.block_b[source],
        node_a=_node_numbers(joints.block_a[source], point, len(points), node_key),
        node_b=_node_numbers(joints.block_b[source], point, len(points), node_key),
        point=np.where((point >= 0)[:, None], points[point], joints.point[source]),
        normal=joints.normal[source],
        area=area,
        patch=joints.patch[source],
    )


def _node_numbers(block: np.ndarray, point: np.ndarray, count: int, node_key: np.ndarray) -> np.ndarray:
    """(C,) the mesh node of each point within the block, -1 where the block or the point has none."""
    key = block * count + point
    number = np.minimum(np.searchsorted(node_key, key), len(node_key) - 1)
    return np.where((point >= 0) & (node_key[number] == key), number, -1)
