"""The skeleton of blocks that share faces in part, held against its plain definition, edge by edge and face by face."""

import numpy as np
import pytest

from geometry.joints.find import find_joints, patch_faces
from geometry.meshes.skeleton import imprint, split_edges
from geometry.polyhedra.construct import from_boxes
from geometry.polyhedra.indexing import Lists
from geometry.polyhedra.loops import free_regions
from geometry.polyhedra.measures import face_areas_normals_centroids
from geometry.specimens.wallette import wallette

WIDTH = 1e-9


def beside_each_other():
    """A slab under blocks that cover it in part: a corner, a strip from edge to edge, its middle, and two in a row."""
    low = [[0, 0, 0], [0, 0, 1], [4, 0, 1], [1, 2, 1], [1, 4, 1], [3, 4, 1]]
    high = [[6, 6, 1], [1, 1, 2], [5, 6, 2], [2, 3, 2], [3, 6, 2], [4, 6, 2]]
    return from_boxes(np.array(low, dtype=float), np.array(high, dtype=float), np.arange(6), np.zeros(6), ["g"])


SPECIMENS = {
    "slab": beside_each_other,
    "wallette": lambda: wallette(3, 2, 0.24, 0.113, 0.0115, 0.01, (2, 2), 0.05).blocks,
}


@pytest.fixture(params=sorted(SPECIMENS))
def blocks(request):
    return SPECIMENS[request.param]()


def cyclic(loop):
    """The same loop from its lowest number on."""
    k = loop.index(min(loop))
    return tuple(loop[k:] + loop[:k])


def refined(points, vertices):
    """A polygon (n, 3) as a loop of vertices, those on its edges among them, each looked for among all."""
    loop = []
    for start, end in zip(points, np.roll(points, -1, axis=0), strict=True):
        along = (end - start) / np.linalg.norm(end - start)
        place = (vertices - start) @ along
        off = np.linalg.norm(vertices - start - place[:, None] * along, axis=1)
        on = np.flatnonzero((off < WIDTH) & (place > -WIDTH) & (place < np.linalg.norm(end - start) - WIDTH))
        loop += on[np.argsort(place[on])].tolist()
    return loop


def surfaces_of(skeleton, number):
    loops, start = skeleton.loops.lists(), skeleton.surface_start
    return [cyclic(loop) for loop in loops[start[number] : start[number + 1]]]


@pytest.mark.parametrize("share", [1.0, 0.5])
def test_each_face_of_a_wanted_block_is_its_joints_and_what_they_leave_free(blocks, share):
    joints = find_joints(blocks)
    wanted = np.arange(blocks.count) < share * blocks.count
    skeleton = imprint(blocks, wanted, joints)
    first = np.searchsorted(joints.patch, np.arange(len(joints.patch_start) - 1))
    sides = np.column_stack([joints.block_a[first], joints.block_b[first]])
    under, normal = patch_faces(blocks, joints), face_areas_normals_centroids(blocks)[1]
    polygons = np.split(joints.patch_points, joints.patch_start[1:-1])
    loops = [refined(polygon, skeleton.vertices) for polygon in polygons]
    for b in range(blocks.count):
        own = skeleton.block_surfaces.one(b)
        patches = np.flatnonzero((sides == b).any(axis=1) & wanted[b])
        assert own[: len(patches)] == skeleton.patch_surface[patches].tolist()
        assert [surfaces_of(skeleton, s) for s in own[: len(patches)]] == [[cyclic(loops[p])] for p in patches]
        free = []
        for f in blocks.faces_of(b) if wanted[b] else ():
            covering = [loops[p] if sides[p, 0] == b else loops[p][::-1] for p in np.flatnonzero((under == f).any(1))]
            free += free_regions(skeleton.vertices, refined(blocks.face(f), skeleton.vertices), covering, normal[f])
        assert [surfaces_of(skeleton, s) for s in own[len(patches) :]] == [[*map(cyclic, region)] for region in free]
    assert np.array_equal(skeleton.patch_surface >= 0, wanted[sides].any(axis=1))


def test_vertices_come_into_the_edges_on_which_they_lie_in_the_sense_of_each_loop():
    vertices = np.array([[0, 0, 0], [3, 0, 0], [0, 3, 0], [2, 0, 0], [1, 0, 0], [1, 1, 0], [1.5, 1.5, 0]], dtype=float)
    loops = Lists.of([[0, 1, 2], [1, 0, 5], [5, 3]])
    assert split_edges(vertices, loops, WIDTH).lists() == [[0, 4, 3, 1, 6, 2], [1, 3, 4, 0, 5], [5, 3]]
