"""Blocks and joints of a page: faces as triangles, edges of units, joints as tiles, and the words of each block."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from geometry.blocks import Blocks, Joints, Specimen
from geometry.joints.covered import covered_fractions
from geometry.polyhedra.indexing import Lists, following, ranges
from geometry.polyhedra.measures import face_areas_normals_centroids, volumes
from masonry.pictures.front import group_colours
from masonry.pictures.hidden_surfaces import COVERED, unit_edges
from masonry.viewing.buffers import Buffers
from masonry.viewing.joint_tiles import JointTiles

JOINT_COLOURS = ("#2166ac", "#b2182b", "#1b7837", "#762a83", "#e08214", "#01665e", "#c51b7d", "#7f7f7f")
"""Of the contact groups, one after the other."""


def blocks_part(specimen: Specimen, joints: Joints, origin: np.ndarray, parts: bool, into: Buffers) -> dict[str, Any]:
    """Corners (from an origin (3,) m), triangles, edges, and what is known of each block; edges of the faces that no
    joint covers, or of all where blocks may part."""
    blocks = specimen.blocks
    triangles, face = _triangles(blocks)
    is_covered = (covered_fractions(blocks, joints) >= COVERED) & (not parts)
    edges, edge_face = _edges(blocks, np.flatnonzero(~is_covered))
    owner = blocks.face_block()
    return {
        "count": blocks.count,
        "points": into.add(blocks.points - origin),
        "triangles": into.add(triangles, "u4"),
        "triangle_block": into.add(owner[face], "u4"),
        "edges": into.add(edges, "u4"),
        "edge_block": into.add(owner[edge_face], "u4"),
        "group": into.add(blocks.group, "u4"),
        "unit": into.add(blocks.unit, "u4"),
        "volume": into.add(volumes(blocks)),
        "groups": [
            {"name": name, "colour": colour}
            for name, colour in zip(blocks.groups, group_colours(blocks.groups), strict=True)
        ],
        "sets": {name: into.add(which, "u4") for name, which in specimen.sets.items()},
    }


def joints_part(
    tiles: JointTiles, group: np.ndarray, groups: tuple[str, ...], origin: np.ndarray, into: Buffers
) -> dict[str, Any]:
    """The tiles of the joints, whose joint each is, and the contact groups; group (C,) index into groups."""
    joints, first = tiles.joints, tiles.first
    start, corners = tiles.corners
    return {
        "count": len(first),
        "whole": tiles.whole,
        "tile_start": into.add(start, "u4"),
        "tile_points": into.add(corners - origin),
        "a": into.add(joints.block_a[first], "u4"),
        "b": into.add(joints.block_b[first], "u4"),
        "joint": into.add(joints.patch[first], "u4"),
        "group": into.add(group[first], "u4"),
        "point": into.add(tiles.mean(joints.point) - origin),
        "normal": into.add(joints.normal[first]),
        "area": into.add(tiles.area),
        "groups": [{"name": name, "colour": JOINT_COLOURS[k % len(JOINT_COLOURS)]} for k, name in enumerate(groups)],
    }


def words_of(table: Mapping[str, Any]) -> dict[str, dict[str, list[str]]]:
    """Lines on the material of each block group, and on the contact table of each joint group, of a resolved scene."""
    return {
        kind: {name: _lines(values) for name, values in table.get(kind, {}).items() if isinstance(values, Mapping)}
        for kind in ("material", "contact")
    }


def _lines(values: Mapping[str, Any], head: str = "") -> list[str]:
    lines = []
    for key, value in values.items():
        if isinstance(value, Mapping):
            lines += _lines(value, f"{head}{key}.")
        else:
            lines.append(f"{head}{key} = {value}")
    return lines


def _triangles(blocks: Blocks) -> tuple[np.ndarray, np.ndarray]:
    """(T, 3) points and (T,) faces: each face, which is convex, as a fan about its first corner."""
    sides = np.diff(blocks.face_start)
    face = np.repeat(np.arange(len(sides)), sides - 2)
    nth = ranges(np.zeros(len(sides), dtype=np.int64), sides - 2)[1]
    first = blocks.face_start[face]
    corners = np.column_stack([first, first + nth + 1, first + nth + 2])
    return blocks.face_points[corners], face


def _edges(blocks: Blocks, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(E, 2) points of the edges that bound a unit, and the face of each."""
    sides = Lists(blocks.face_start, blocks.face_points).taken(faces)
    outer = unit_edges(blocks, faces, face_areas_normals_centroids(blocks)[1])
    pairs = np.column_stack([sides.entry, sides.entry[following(sides.start)]])
    return pairs[outer], np.repeat(faces, np.diff(sides.start))[outer]
