from dataclasses import replace

import numpy as np
import pytest

from geometry.joints.find import find_joints
from geometry.joints.tributary_areas import tiles
from geometry.polyhedra.construct import from_boxes
from geometry.polyhedra.polygons import areas_normals_centroids, cut
from geometry.specimens.wallette import wallette


def slabs():
    """Two on a third, so that joints have their corners off those of the blocks."""
    low = np.array([[0, 0, 0], [-1, -1, 1], [2.5, 0.5, 1]])
    high = np.array([[4, 3, 1], [2, 2, 2], [5, 2.5, 2]])
    return from_boxes(low.astype(float), high, np.arange(3), np.zeros(3), ["g"])


def strewn(joints):
    """The same joints with their points anywhere on their polygons."""
    share = np.random.default_rng(0).dirichlet(np.full(4, 0.5), len(joints.point))
    polygon = joints.patch_points[joints.patch_start[joints.patch][:, None] + np.arange(4)]
    return replace(joints, point=np.einsum("ck,cki->ci", share, polygon))


@pytest.mark.parametrize("points_per_edge", [1, 2, 5])
@pytest.mark.parametrize("placed", [lambda joints: joints, strewn], ids=["regular", "strewn"])
@pytest.mark.parametrize("made", [slabs, lambda: wallette(3, 2, 0.24, 0.113, 0.0115, 0.01, (2, 2), 0.05).blocks])
def test_a_tile_is_its_polygon_cut_halfway_to_every_other_point(made, placed, points_per_edge):
    joints = placed(find_joints(made(), points_per_edge=points_per_edge))
    start, corners = tiles(joints)
    for c, (patch, point) in enumerate(zip(joints.patch, joints.point, strict=True)):
        polygon = joints.patch_points[None, joints.patch_start[patch] : joints.patch_start[patch + 1]]
        count = np.array([polygon.shape[1]])
        for other in joints.point[(joints.patch == patch) & (np.arange(len(joints.patch)) != c)]:
            polygon, count = cut(polygon, count, (0.5 * (point + other) - polygon) @ (other - point))
        plain = areas_normals_centroids(polygon[:, : count[0]])
        tile = areas_normals_centroids(corners[None, start[c] : start[c + 1]])
        for one, two in zip(tile, plain, strict=True):
            np.testing.assert_allclose(one, two, rtol=1e-9, atol=1e-12)
