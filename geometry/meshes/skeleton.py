"""The faces of some blocks cut up along their joints, so that what two blocks share is one surface for both.

This replaces the boolean `fragment` of a CAD kernel: the overlap polygons are known exactly from the joints, so points
stay where they are and the time grows nearly as the number of blocks.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from geometry.blocks import Blocks, Joints
from geometry.joints.find import patch_faces
from geometry.polyhedra.indexing import Lists, following, ranges
from geometry.polyhedra.loops import free_regions, reverse
from geometry.polyhedra.measures import extent, face_areas_normals_centroids
from geometry.polyhedra.weld import weld


@dataclass(frozen=True)
class Imprint:
    """A shared skeleton of points, edges between them, flat surfaces and the blocks they enclose.

    vertices        (V, 3) m
    loops           of vertices, those of each surface one after another; straight edges in between
    surface_start   (S + 1,) the first loop of each surface: the outline, then holes
    block_surfaces  surfaces that enclose each block; empty for blocks left out
    patch_surface   (J,) surface of each joint polygon, or -1 where neither block is in the skeleton
    """

    vertices: np.ndarray
    loops: Lists
    surface_start: np.ndarray
    block_surfaces: Lists
    patch_surface: np.ndarray


class _Cover(NamedTuple):
    """Which polygons cover which faces, in the order of the polygons, both as numbers of their loops.

    outward  (n,) whether the polygon runs counter-clockwise seen from outside the block of the face
    """

    face: np.ndarray
    polygon: np.ndarray
    outward: np.ndarray


def imprint(blocks: Blocks, mask: np.ndarray, joints: Joints) -> Imprint:
    """The skeleton of the blocks of a mask (B,) with every joint polygon on them as a surface of its own."""
    width, owner = 1e-9 * extent(blocks), blocks.face_block()
    first = np.searchsorted(joints.patch, np.arange(len(joints.patch_start) - 1))
    sides = np.stack([joints.block_a[first], joints.block_b[first]], axis=1)
    patches, faces = np.flatnonzero(mask[sides].any(axis=1)), np.flatnonzero(mask[owner])
    of_faces = Lists(blocks.face_start, blocks.face_points).taken(faces)
    of_patches = Lists(joints.patch_start, np.arange(len(joints.patch_points))).taken(patches)
    corners = np.concatenate([blocks.points[of_faces.entry], joints.patch_points[of_patches.entry]])
    vertices, loops = weld_loops(corners, of_faces.followed_by(of_patches).start, width)
    loops = split_edges(vertices, loops, width)

    patch, side = np.nonzero(mask[sides[patches]])
    under = patch_faces(blocks, joints)[patches][patch, side]
    lies = under >= 0
    cover = _Cover(np.searchsorted(faces, under[lies]), len(faces) + patch[lies], side[lies] == 0)
    face, regions, loops = _free_parts(vertices, loops, cover, face_areas_normals_centroids(blocks)[1][faces])
    surfaces = Lists(np.arange(len(patches) + 1), len(faces) + np.arange(len(patches))).followed_by(regions)
    patch_surface = np.full(len(sides), -1, dtype=np.int64)
    patch_surface[patches] = np.arange(len(patches))
    block = np.concatenate([sides[patches][patch, side], owner[faces[face]]])
    surface = np.concatenate([patch, len(patches) + np.arange(len(face))])
    return Imprint(
        vertices,
        loops=loops.taken(surfaces.entry),
        surface_start=surfaces.start,
        block_surfaces=Lists.by_owner(block, surface, blocks.count),
        patch_surface=patch_surface,
    )


def _free_parts(
    vertices: np.ndarray, loops: Lists, cover: _Cover, normal: np.ndarray
) -> tuple[np.ndarray, Lists, Lists]:
    """Of each region of a face that no polygon covers: the face, rising, and the loops round it; and all loops, new
    ones behind. The loops of the faces come first; normal (F, 3) of them."""
    numbers = np.arange(len(normal))
    covered = np.isin(numbers, cover.face)
    whole = numbers[~covered]
    parts = Lists.by_owner(cover.face, np.arange(len(cover.face)), len(normal))
    cut, regions = [], []
    for f in np.flatnonzero(covered & ~_are_filled(vertices, loops, cover, numbers)).tolist():
        covering = [
            loops.one(p) if outward else reverse(loops.one(p))
            for p, outward in zip(cover.polygon[parts.one(f)], cover.outward[parts.one(f)], strict=True)
        ]
        for region in free_regions(vertices, loops.one(f), covering, normal[f]):
            cut.append(f)
            regions.append(region)
    start = np.cumsum([0, *(len(region) for region in regions)])
    number = Lists(np.arange(len(whole) + 1), whole).followed_by(Lists(start, loops.count + np.arange(start[-1])))
    face = np.append(whole, np.array(cut, dtype=np.int64))
    order = np.argsort(face, kind="stable")
    return (
        face[order],
        number.taken(order),
        loops.followed_by(Lists.of([loop for region in regions for loop in region])),
    )


def _are_filled(vertices: np.ndarray, loops: Lists, cover: _Cover, faces: np.ndarray) -> np.ndarray:
    """(F,) whether polygons cover a face wholly for certain: each edge of it and of them is there twice, once each way,
    where the polygons run clockwise. Of other faces `free_regions` tells, one by one."""
    owner = np.concatenate([faces, cover.face])
    outlines = loops.taken(np.concatenate([faces, cover.polygon]))
    owner, turned = (
        np.repeat(values, outlines.lengths) for values in (owner, np.append(np.zeros(len(faces), bool), cover.outward))
    )
    begin, end = outlines.entry, outlines.entry[following(outlines.start)]
    edge = np.minimum(begin, end) * len(vertices) + np.maximum(begin, end)
    forward = (begin < end) != turned
    order = np.lexsort((forward, edge, owner))
    owner, edge, forward = owner[order], edge[order], forward[order]
    first = np.flatnonzero(np.append(True, (owner[1:] != owner[:-1]) | (edge[1:] != edge[:-1])))
    twice = np.diff(np.append(first, len(edge))) == 2
    twice[twice] = forward[first[twice]] != forward[first[twice] + 1]
    filled = np.ones(len(faces), dtype=bool)
    filled[owner[first[~twice]]] = False
    return filled


def weld_loops(corners: np.ndarray, start: np.ndarray, width: float) -> tuple[np.ndarray, Lists]:
    """Vertices (V, 3), points within width taken as one, and the polygons corners[start[i]:start[i + 1]] as loops of
    vertex numbers."""
    first, number = weld(corners, width)
    return corners[first], Lists(start, number)


def split_edges(vertices: np.ndarray, loops: Lists, width: float) -> Lists:
    """The same loops with every vertex that lies on an edge put into it."""
    begin, end = loops.entry, loops.entry[following(loops.start)]
    unique, of_edge = np.unique(np.minimum(begin, end) * len(vertices) + np.maximum(begin, end), return_inverse=True)
    low, high = np.divmod(unique, len(vertices))
    between = _on_edges(vertices, low, high, width)
    count = between.lengths[of_edge]
    start = np.concatenate([[0], np.cumsum(1 + count)])
    entry = np.empty(start[-1], dtype=np.int64)
    entry[start[:-1]] = begin
    place, number = ranges(np.zeros(len(begin), dtype=np.int64), count)
    along = np.where(low[of_edge] == begin, 0, count - 1)[place]  # from the other end backwards
    step = np.where(low[of_edge] == begin, 1, -1)[place]
    entry[start[place] + 1 + number] = between.entry[between.start[of_edge[place]] + along + step * number]
    return Lists(start[loops.start], entry)


def _on_edges(vertices: np.ndarray, low: np.ndarray, high: np.ndarray, width: float) -> Lists:
    """For each edge from one vertex (E,) to another (E,) those between them, in that order."""
    start, end = vertices[low], vertices[high]
    length = np.linalg.norm(end - start, axis=1)
    tree, middle, reach = cKDTree(vertices), (start + end) / 2, length / 2 + width
    crowded = np.flatnonzero(tree.query_ball_point(middle, reach, return_length=True) > 2)  # than its two ends
    near = Lists.of(tree.query_ball_point(middle[crowded], reach[crowded]))
    edge, vertex = np.repeat(crowded, near.lengths), near.entry
    along = (end - start)[edge] / length[edge, None]
    arm = vertices[vertex] - start[edge]
    place = np.einsum("ni,ni->n", arm, along)
    inside = (np.linalg.norm(arm - place[:, None] * along, axis=1) <= width) & (place > width)
    inside &= place < length[edge] - width
    order = np.lexsort((place[inside], edge[inside]))
    return Lists.by_owner(edge[inside][order], vertex[inside][order], len(low))
