"""Contact points on meshes that came with their blocks: on nodes where two surfaces match, between nodes where not.

Where all surface triangles on a joint polygon match, each gives a third of its area to each of its corners. Elsewhere
every overlap of two triangles has points of its own, whose displacement each side takes from its triangle by shape
functions: forces of a uniform stress are those of the tets exactly, and no moment is lost.
"""

from dataclasses import replace
from typing import Any

import numpy as np

from geometry.blocks import Blocks, Joints, TetMesh
from geometry.meshes.nonmatching_pieces import OverlapPieces, find_pieces
from geometry.polyhedra.indexing import ranges
from geometry.polyhedra.polygons import unpad

SAME = 1e-6
"""Of the area of a triangle: how far an overlap may be from it to count as the whole triangle."""
LEAST = 1e-15
"""Of the largest: triangles of a fan that are smaller get no points."""
INSIDE = np.array([[4.0, 1.0, 1.0], [1.0, 4.0, 1.0], [1.0, 1.0, 4.0]]) / 6
PER_CONTACT = ("block_a", "block_b", "node_a", "node_b", "point", "normal", "area", "patch")
BETWEEN = ("corner_a", "share_a", "corner_b", "share_b")
Values = dict[str, np.ndarray]


def surface_joints(blocks: Blocks, joints: Joints, mesh: TetMesh) -> Joints:
    """The joints with points for the tets inside the blocks; polygons between blocks without tets keep theirs.

    joints  as find_joints gives them for these blocks
    Raises GeometryError if the surface of a mesh is not that of its block.
    """
    if len(mesh.tets) == 0:
        return joints
    pieces = find_pieces(blocks, joints, mesh)
    count = len(joints.patch_start) - 1
    of_parent = np.searchsorted(joints.patch, np.arange(count))
    has_tets = np.diff(mesh.tet_start) > 0
    touched = has_tets[joints.block_a[of_parent]] | has_tets[joints.block_b[of_parent]]
    matched = touched & _matched(joints, pieces)
    parts = [
        _kept(joints, np.flatnonzero(~touched[joints.patch])),
        _at_nodes(joints, pieces, matched, of_parent),
        _between_nodes(joints, pieces, np.flatnonzero((touched & ~matched)[pieces.parent]), of_parent),
    ]
    return _joined(joints, pieces, parts)


def _matched(joints: Joints, pieces: OverlapPieces) -> np.ndarray:
    """(J,) whether every overlap in a joint polygon is a whole triangle on each side that has tets."""
    whole = np.ones(len(pieces.area), dtype=bool)
    for side in (0, 1):
        corner = pieces.places(side)
        area = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1) / 2
        whole &= ~pieces.meshed(side) | (np.abs(area - pieces.area) <= SAME * area)
    every = np.ones(len(joints.patch_start) - 1, dtype=bool)
    np.logical_and.at(every, pieces.parent, whole)
    return every


def _at_nodes(joints: Joints, pieces: OverlapPieces, matched: np.ndarray, of_parent: np.ndarray) -> Values:
    """Points at the nodes of matched joint polygons (J,): a third of each triangle to each of its corners."""
    which = np.flatnonzero(matched[pieces.parent])
    node = [pieces.nodes[pieces.faces[which, side]] for side in (0, 1)]
    place = [pieces.places(side)[which] for side in (0, 1)]
    both = pieces.meshed(0)[which] & pieces.meshed(1)[which]
    gap = np.linalg.norm(place[0][:, :, None] - place[1][:, None], axis=3)
    node[1] = np.where(both[:, None], np.take_along_axis(node[1], gap.argmin(axis=2), axis=1), node[1])
    key = np.stack([np.repeat(pieces.parent[which], 3), node[0].ravel(), node[1].ravel()], axis=1)
    unique, number = np.unique(key, axis=0, return_inverse=True)
    source = of_parent[unique[:, 0]]
    columns = {name: getattr(joints, name)[source] for name in ("block_a", "block_b", "normal")}
    columns |= {
        "node_a": unique[:, 1],
        "node_b": unique[:, 2],
        "point": pieces.tet_nodes[np.where(unique[:, 1] >= 0, unique[:, 1], unique[:, 2])],
        "area": np.bincount(number.ravel(), np.repeat(pieces.area[which] / 3, 3), len(unique)),
        "patch": unique[:, 0],
    }
    return columns | _nothing_between(len(unique))


def _between_nodes(joints: Joints, pieces: OverlapPieces, which: np.ndarray, of_parent: np.ndarray) -> Values:
    """Points in the overlaps `which` of triangles that do not match: three in each triangle of a fan (to degree 2)."""
    owner, k = ranges(np.ones(len(which), dtype=np.int64), pieces.count[which] - 2)
    q = which[owner]
    corner = np.stack([pieces.corner[q, 0], pieces.corner[q, k], pieces.corner[q, k + 1]], axis=1)
    place = np.einsum("pc,tci->tpi", INSIDE, corner).reshape(-1, 3)
    area = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1) / 2
    is_broad = area > LEAST * area.max(initial=0.0)
    q, place, area = np.repeat(q[is_broad], 3), place[np.repeat(is_broad, 3)], np.repeat(area[is_broad] / 3, 3)
    source = of_parent[pieces.parent[q]]
    none = np.full(len(q), -1)
    columns = {name: getattr(joints, name)[source] for name in ("block_a", "block_b", "normal")}
    columns |= {"node_a": none, "node_b": none, "point": place, "area": area}
    for side, name in enumerate("ab"):
        columns[f"corner_{name}"] = pieces.nodes[pieces.faces[q, side]]
        fractions = _shape_functions(pieces.places(side)[q], place)
        columns[f"share_{name}"] = np.where(pieces.meshed(side)[q, None], fractions, 0.0)
    return columns | {"patch": len(of_parent) + q}


def _shape_functions(corner: np.ndarray, point: np.ndarray) -> np.ndarray:
    """(n, 3) shape functions of triangles (n, 3, 3) at points within them (n, 3)."""
    side_a, side_b, arm = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0], point - corner[:, 0]
    normal = np.cross(side_a, side_b)
    square = np.einsum("ni,ni->n", normal, normal)
    square = np.where(square > 0, square, 1.0)
    second = np.einsum("ni,ni->n", np.cross(arm, side_b), normal) / square
    third = np.einsum("ni,ni->n", np.cross(side_a, arm), normal) / square
    fraction = np.maximum(np.stack([1.0 - second - third, second, third], axis=1), 0.0)
    return fraction / fraction.sum(axis=1, keepdims=True)


def _kept(joints: Joints, which: np.ndarray) -> Values:
    """Some contact points as they are."""
    return {name: getattr(joints, name)[which] for name in PER_CONTACT} | _nothing_between(len(which))


def _nothing_between(count: int) -> Values:
    corner, fraction = np.full((count, 3), -1), np.zeros((count, 3))
    return {"corner_a": corner, "share_a": fraction, "corner_b": corner, "share_b": fraction}


def _joined(joints: Joints, pieces: OverlapPieces, parts: list[Values]) -> Joints:
    """All parts in the order of polygons; patches count through those of joints, then the pieces."""
    values: dict[str, Any] = {name: np.concatenate([part[name] for part in parts]) for name in (*PER_CONTACT, *BETWEEN)}
    order = np.argsort(values["patch"], kind="stable")
    values = {name: value[order] for name, value in values.items()}
    used, values["patch"] = np.unique(values["patch"], return_inverse=True)
    start, corner = unpad(pieces.corner, pieces.count)
    start = np.concatenate([joints.patch_start, joints.patch_start[-1] + start[1:]])
    size = np.diff(start)[used]
    _, place = ranges(start[used], size)
    values["patch_start"] = np.concatenate([[0], np.cumsum(size)])
    values["patch_points"] = np.concatenate([joints.patch_points, corner])[place]
    if np.all(values["corner_a"] < 0) and np.all(values["corner_b"] < 0):
        values |= dict.fromkeys(BETWEEN)
    return replace(joints, **values)
