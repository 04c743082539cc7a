"""The faces of some blocks cut up along their joints, so that what two blocks share is one surface for both.

This replaces the boolean `fragment` of a CAD kernel: the overlap polygons are known exactly from the joints, so points
stay where they are and the time grows nearly as the number of blocks.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from geometry.blocks import Blocks, Joints
from geometry.joints.find import patch_faces
from geometry.polyhedra.indexing import ranges
from geometry.polyhedra.loops import free_regions, reverse
from geometry.polyhedra.measures import extent, face_areas_normals_centroids
from geometry.polyhedra.weld import weld

Loop = list[int]


@dataclass(frozen=True)
class Imprint:
    """A shared skeleton of points, edges between them, flat surfaces and the blocks they enclose.

    vertices        (V, 3) m
    surfaces        loops of vertices for each surface, the outline first, then holes; straight edges in between
    block_surfaces  surfaces that enclose each block; empty for blocks left out
    patch_surface   surface of each joint polygon, or -1 where neither block is in the skeleton
    """

    vertices: np.ndarray
    surfaces: list[list[Loop]]
    block_surfaces: list[list[int]]
    patch_surface: np.ndarray


def imprint(blocks: Blocks, wanted: np.ndarray, joints: Joints) -> Imprint:
    """The skeleton of the wanted blocks (B,) with every joint polygon on them as a surface of its own."""
    width = 1e-9 * extent(blocks)
    first = np.searchsorted(joints.patch, np.arange(len(joints.patch_start) - 1))
    sides = np.stack([joints.block_a[first], joints.block_b[first]], axis=1)
    patches = np.flatnonzero(wanted[sides].any(axis=1))
    faces = np.flatnonzero(wanted[blocks.face_block()])

    corners = [blocks.face(f) for f in faces.tolist()]
    corners += [joints.patch_points[joints.patch_start[p] : joints.patch_start[p + 1]] for p in patches]
    vertices, loops = weld_loops(corners, width)
    loops = split_edges(vertices, loops, width)
    outline = dict(zip(faces.tolist(), loops, strict=False))
    patch_loop = dict(zip(patches.tolist(), loops[len(faces) :], strict=True))

    surfaces = [[patch_loop[p]] for p in patches.tolist()]
    patch_surface = np.full(len(sides), -1, dtype=np.int64)
    patch_surface[patches] = np.arange(len(patches))
    block_surfaces: list[list[int]] = [[] for _ in range(blocks.count)]
    covering: dict[int, list[Loop]] = {}
    under = patch_faces(blocks, joints)
    for p in patches.tolist():
        for block, face, outward in zip(sides[p].tolist(), under[p].tolist(), (True, False), strict=True):
            if wanted[block]:
                block_surfaces[block].append(int(patch_surface[p]))
                covering.setdefault(face, []).append(patch_loop[p] if outward else reverse(patch_loop[p]))
    owner = blocks.face_block()
    normal = face_areas_normals_centroids(blocks)[1]
    for face, loop in outline.items():
        for region in free_regions(vertices, loop, covering.get(face, []), normal[face]):
            block_surfaces[owner[face]].append(len(surfaces))
            surfaces.append(region)
    return Imprint(vertices, surfaces, block_surfaces, patch_surface)


def weld_loops(corners: list[np.ndarray], width: float) -> tuple[np.ndarray, list[Loop]]:
    """Vertices (V, 3), points within width taken as one, and the polygons as loops of vertex numbers."""
    points = np.concatenate(corners)
    first, number = weld(points, width)
    ends = np.cumsum([len(c) for c in corners])[:-1]
    return points[first], [loop.tolist() for loop in np.split(number, ends)]


def split_edges(vertices: np.ndarray, loops: list[Loop], width: float) -> list[Loop]:
    """The same loops with every vertex that lies on an edge put into it."""
    begin, length = np.concatenate(loops), np.array([len(loop) for loop in loops])
    following = np.arange(1, len(begin) + 1)
    following[np.cumsum(length) - 1] -= length
    edges = np.stack([begin, begin[following]], axis=1)
    unique, of_edge = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True)
    start, end = vertices[unique[:, 0]], vertices[unique[:, 1]]
    length = np.linalg.norm(end - start, axis=1)
    near = cKDTree(vertices).query_ball_point((start + end) / 2, length / 2 + width)
    edge, place = ranges(np.zeros(len(unique), dtype=np.int64), np.array([len(n) for n in near]))
    vertex = np.array([v for n in near for v in n], dtype=np.int64)
    along = (end - start)[edge] / length[edge, None]
    arm = vertices[vertex] - start[edge]
    place = np.einsum("ni,ni->n", arm, along)
    inside = (np.linalg.norm(arm - place[:, None] * along, axis=1) <= width) & (place > width)
    inside &= place < length[edge] - width
    order = np.lexsort((place[inside], edge[inside]))
    between: dict[int, Loop] = {}
    for e, v in zip(edge[inside][order].tolist(), vertex[inside][order].tolist(), strict=True):
        between.setdefault(e, []).append(v)

    result, k = [], 0
    for loop in loops:
        refined: Loop = []
        for v in loop:
            e = int(of_edge[k])
            extra = between.get(e, [])
            refined += [v, *(extra if unique[e, 0] == v else reverse(extra))]
            k += 1
        result.append(refined)
    return result
