"""Contact points, areas and nearby joints by hand, where blocks lie unlike each other."""

import numpy as np
import pytest

from geometry.blocks import TetMesh
from geometry.joints.boundary import surface_nodes
from geometry.joints.covered import covered_fractions
from geometry.joints.extents import joint_extents
from geometry.joints.faces.second_moments import lacking_flexibility
from geometry.joints.find import find_joints, stated_joints
from geometry.joints.gaps import facing_faces
from geometry.joints.heal import mend
from geometry.joints.nearby import Rule, nearby_joints
from geometry.joints.point_density import Density
from geometry.joints.quality import quality
from geometry.joints.tributary_areas import tiles
from geometry.meshes.fan import mesh_by_fans
from geometry.polyhedra.construct import concatenate, extrude, from_boxes, from_faces
from geometry.polyhedra.measures import bounds, volumes
from geometry.polyhedra.polygons import areas_normals_centroids, pad

MM = 1e-3


def boxes(*spans, units=None):
    """Boxes between corners in mm."""
    low, high = np.array(spans, dtype=float).transpose(1, 0, 2)
    number = np.arange(len(low)) if units is None else np.array(units)
    return from_boxes(low * MM, high * MM, number, np.zeros(len(low), dtype=int), ["units"])


def upright(loop, low: float, high: float, unit: int = 0):
    """An outline (n, 2) m in x and z between two places along y."""
    return extrude([np.array(loop, dtype=float)], np.array([low]), np.array([high]), np.array([unit]), ("units",))


@pytest.mark.parametrize("play", [0.04, 0.09])
def test_a_filler_with_some_play_is_closed_on_both_sides(play):
    """A strip of 0.4 mm in a gap of it and twice the play: to each of its two neighbours there is a gap to mend, and
    none between these, however wide they are apart beside the tolerance."""
    filled = boxes(
        ((0, 0, 0), (100, 50, 60)),
        ((0, 0, 60 + play), (100, 50, 60.4 + play)),
        ((0, 0, 60.4 + 2 * play), (100, 50, 120)),
    )
    mended = mend(filled, 0.1 * MM, ["below", "strip", "above"])
    assert find_joints(mended.blocks).area.sum() == pytest.approx(2 * 0.1 * 0.05, rel=1e-9)
    assert len(mended.gaps.size) == 2 and mended.gaps.size == pytest.approx([play * MM, play * MM], rel=1e-6)
    low, high = bounds(mended.blocks)
    for below, above in ((0, 1), (1, 2)):
        assert high[below, 2] == pytest.approx(low[above, 2], abs=1e-12)
        assert high[below, 2] == pytest.approx((60 + (0.4 + play) * below + play / 2) * MM, abs=1e-9), "half-way"
    assert volumes(mended.blocks).sum() == pytest.approx(0.1 * 0.05 * 0.12, rel=1e-9)


def test_a_filler_that_is_narrower_than_its_gap_leaves_the_rest_of_it_to_be_refused():
    beside = boxes(((0, 0, 0), (100, 50, 60)), ((0, 0, 60), (20, 50, 60.5)), ((0, 0, 60.5), (100, 50, 120)))
    with pytest.raises(ValueError, match=r"1 gap between facing faces.*gap of 0.5 mm between 'below' and 'above'"):
        mend(beside, 0.1 * MM, ["below", "strip", "above"])


@pytest.mark.parametrize(
    ("width", "gap", "tolerance", "faces"),
    [(0.1013, 0.04, 0.1, 1), (0.0992, 0.04, 0.1, 0), (0.1013, 0.05, 0.02, 1), (0.0992, 0.05, 0.02, 0)],
)
def test_faces_are_set_against_each_other_where_they_are_broader_than_the_tolerance_and_twice_their_gap(
    width, gap, tolerance, faces
):
    """By a strip of 80 mm: twice its area over its outline is 80 w/(80 + w)."""
    blocks = boxes(((0, 0, 0), (100, 80, 50)), ((100 - width, 0, 50 + gap), (200, 80, 90)))
    facing = facing_faces(blocks, 0.1 * MM, tolerance * MM)
    assert facing.size == pytest.approx([gap * MM] * faces, rel=1e-6)


def test_corners_of_a_polygon_stand_for_half_of_the_triangles_beside_them():
    """A right triangle with a corner cut off: four sides, no two alike."""
    loop = [[0.0, 0.0], [0.4, 0.0], [0.4, 0.1], [0.0, 0.3]]
    blocks = concatenate([upright(loop, -0.2, 0.0), upright(loop, 0.0, 0.2, 1)])
    joints = find_joints(blocks, "vertex", 2)
    corners = np.array(loop)
    area, _, middle = (v[0] for v in areas_normals_centroids(np.insert(corners, 1, 0.0, axis=1)[None]))
    arms = corners - middle[[0, 2]]
    fan = [0.5 * abs(a[0] * b[1] - a[1] * b[0]) for a, b in zip(arms, np.roll(arms, -1, axis=0), strict=True)]
    for point, own in zip(joints.point[:, [0, 2]], joints.area, strict=True):
        k = int(np.argmin(np.linalg.norm(corners - point, axis=1)))
        assert point == pytest.approx(corners[k]) and own == pytest.approx(0.5 * (fan[k] + fan[k - 1]))
    assert joints.area.sum() == pytest.approx(area)


LOBATTO = {2: [1 / 2, 1 / 2], 3: [1 / 6, 2 / 3, 1 / 6], 5: [1 / 20, 49 / 180, 16 / 45, 49 / 180, 1 / 20]}
"""Weights along an edge: half of those of Abramowitz and Stegun, table 25.6."""
PLACES = {2: [0.0, 1.0], 3: [0.0, 0.5, 1.0], 5: [0.0, 0.5 - 0.5 * (3 / 7) ** 0.5, 0.5, 0.5 + 0.5 * (3 / 7) ** 0.5, 1.0]}


@pytest.mark.parametrize("number", LOBATTO)
def test_points_at_the_edges_are_those_of_gauss_and_lobatto(number):
    blocks = boxes(((0, 0, 0), (300, 200, 50)), ((0, 0, 50), (300, 200, 100)))
    joints = find_joints(blocks, "vertex", [number, 2, 2])
    order = np.lexsort((joints.point[:, 0], joints.point[:, 1].round(9)))
    assert joints.point[order, 0] == pytest.approx(np.tile(PLACES[number], 2) * 0.3, abs=1e-12)
    assert joints.area[order] == pytest.approx(np.tile(LOBATTO[number], 2) * 0.3 * 0.1)
    assert len(np.unique(np.round(joints.point[:, 1], 9))) == 2, "so many along x, and two along y"


@pytest.mark.parametrize("density", [{"points_per_edge": n} for n in (3, 4, 7, 12)] + [{"points_per_face": 60}])
def test_points_at_the_edges_of_any_polygon_have_its_second_moments(density, prism):
    """A quadrilateral without right angles, and a triangle: both through their corners, and exact to degree 2."""
    for flat in (np.array([[0, 0], [0.5, 0.1], [0.4, 0.35], [-0.1, 0.2]]), np.array([[0, 0], [0.4, 0.05], [0.1, 0.3]])):
        below, above = prism(flat, -0.1, 0.0), prism(flat, 0.0, 0.1)
        joints = find_joints(from_faces([below, above], [0, 1], [0, 0], ["g"]), "vertex", **density)
        many = find_joints(from_faces([below, above], [0, 1], [0, 0], ["g"]), "gauss", 2)
        moments = [np.einsum("c,ci,cj->ij", one.area, one.point, one.point) for one in (joints, many)]
        assert moments[0] == pytest.approx(moments[1], rel=1e-9, abs=1e-12)
        gap = np.linalg.norm(joints.point[:, None, :2] - flat, axis=2).min(axis=0)
        assert gap == pytest.approx(np.zeros(len(flat)), abs=1e-12), "points lie at all corners"


def test_a_joint_over_a_gap_lies_half_way_be_it_wide_or_narrow():
    """Two stones beside each other, 1 and 3 mm above a third one."""
    blocks = boxes(((0, 0, 0), (100, 100, 50)), ((0, 0, 51), (60, 100, 90)), ((70, 0, 53), (100, 100, 90)))
    joints = nearby_joints(blocks, Rule(5 * MM, 0.1 * MM, 0.1))
    assert (joints.block_a.tolist(), joints.block_b.tolist()) == ([0, 0], [1, 2])
    corners, _ = pad(joints.points, joints.start, np.arange(len(joints.points)))
    assert areas_normals_centroids(corners)[2][:, 2] == pytest.approx([50.5 * MM, 51.5 * MM])
    assert joints.gap == pytest.approx(np.array([[1.0, 1.0], [3.0, 3.0]]) * MM)


def test_the_plane_of_a_joint_of_two_faces_is_their_mean_by_area():
    """A stone whose underside is level for 60 mm, and rises by 1 in 20 for 40: half of that, for 0.4 of the area."""
    loop = np.array([(0, 0), (60, 0), (100, 2), (100, 60), (0, 60)]) * MM
    ground = upright(np.array([(-50, -50), (150, -50), (150, 0), (-50, 0)]) * MM, 0.0, 0.1)
    joints = nearby_joints(concatenate([ground, upright(loop, 0.0, 0.1, 1)]), Rule(5 * MM, 0.1 * MM, 0.1))
    assert len(joints.block_a) == 1
    corners, _ = pad(joints.points, joints.start, np.arange(len(joints.points)))
    normal = areas_normals_centroids(corners)[1][0]
    assert -normal[0] / normal[2] == pytest.approx(0.4 * 0.5 * 0.05, rel=0.01)


@pytest.mark.parametrize(("hollow", "pieces"), [(1.0, 1), (3.0, 2)])
def test_pieces_that_meet_are_one_joint_where_they_fill_98_per_cent_of_their_hull(hollow, pieces):
    """A stone of one body stands on two feet; between them is a hollow, 1 or 3 of 100 mm wide."""
    half = 0.5 * hollow
    loop = [(0, 0), (50 - half, 0), (50 - half, 5), (50 + half, 5), (50 + half, 0), (100, 0), (100, 60), (0, 60)]
    left, right = loop[:4], loop[4:]
    assert len(left) == len(right) == 4
    feet = [boxes(((0, 0, 50), (50 - half, 100, 90))), boxes(((50 + half, 0, 50), (100, 100, 90)))]
    faces = [[piece.face(f) for f in piece.faces_of(0)] for piece in feet]
    stone = from_faces([faces[0] + faces[1]], [1], [0], ["units"])
    ground = boxes(((0, 0, 0), (100, 100, 50)))
    joints = nearby_joints(concatenate([ground, stone]), Rule(2 * MM, 2 * MM, 0.1))
    assert len(joints.block_a) == pieces


def test_within_a_unit_a_joint_reaches_as_far_as_the_smaller_of_its_blocks():
    """A small block stands on a large one of the same unit, and both on another unit."""
    blocks = boxes(
        ((0, 0, 0), (400, 200, 50)), ((0, 0, 50), (400, 200, 100)), ((300, 50, 100), (340, 80, 120)), units=[0, 1, 1]
    )
    joints = find_joints(blocks)
    axes, size = joint_extents(blocks, joints)
    inner = blocks.unit[joints.block_a] == blocks.unit[joints.block_b]
    along = np.abs(np.einsum("ckj,j->ck", axes, [1.0, 0.0, 0.0])) > 0.5
    assert size[inner][along[inner]] == pytest.approx(np.full(inner.sum(), 0.04))
    assert size[inner][~along[inner]] == pytest.approx(np.full(inner.sum(), 0.03))
    assert size[~inner][along[~inner]] == pytest.approx(np.full((~inner).sum(), 0.4))


def test_a_joint_of_two_units_is_one_whichever_of_their_blocks_comes_first():
    """Two blocks of unit 5 below two of unit 2, numbered so that one pair begins below and the other one above."""
    blocks = boxes(
        ((0, 0, 0), (100, 80, 50)),
        ((0, 0, 50), (100, 80, 100)),
        ((100, 0, 50), (250, 80, 100)),
        ((100, 0, 0), (250, 80, 50)),
        units=[5, 2, 2, 5],
    )
    joints = find_joints(blocks)
    axes, size = joint_extents(blocks, joints)
    bed = blocks.unit[joints.block_a] != blocks.unit[joints.block_b]
    assert set(zip(joints.block_a[bed].tolist(), joints.block_b[bed].tolist(), strict=True)) == {(0, 1), (2, 3)}
    assert size[bed] == pytest.approx(np.tile([0.25, 0.08], (int(bed.sum()), 1)))
    assert np.abs(axes[bed][:, 0, 0]) == pytest.approx(np.ones(int(bed.sum())))


@pytest.mark.parametrize(("gap", "covered"), [(1.7, 1.0), (1.9, 0.0)])
def test_a_joint_half_way_over_a_gap_covers_faces_that_are_near_beside_their_size(gap, covered):
    """A hundredth of the root of 0.1 x 0.08 m2 is 0.894 mm, to each side of the joint; a third of the lower face."""
    blocks = boxes(((0, 0, 0), (300, 80, 50)), ((0, 0, 50 + gap), (100, 80, 90)))
    joints = stated_joints(nearby_joints(blocks, Rule(5 * MM, 0.1 * MM, 0.1)), Density("gauss", 2))
    share = covered_fractions(blocks, joints)
    faces = {block: [f for f in blocks.faces_of(block) if share[f] > 0.0] for block in (0, 1)}
    assert [share[f] for f in faces[1]] == pytest.approx([covered] * bool(covered))
    assert [share[f] for f in faces[0]] == pytest.approx([1 / 3]), "its root is 1.55 mm: near enough in both cases"


def test_moments_of_a_face_are_its_pull_by_arm_and_the_twist_of_its_shears():
    """Two faces of unlike points and normals, under forces that nothing makes alike; sums by hand about their
    middles."""
    blocks = boxes(((0, 0, 0), (300, 200, 50)), ((40, 30, 50), (300, 200, 100)), ((300, 0, 0), (420, 150, 50)))
    joints = find_joints(blocks, "gauss", [2, 3, 2])
    rng = np.random.default_rng(4)
    pull, shear = rng.normal(size=len(joints.area)), rng.normal(size=(len(joints.area), 3))
    shear -= np.einsum("ci,ci->c", shear, joints.normal)[:, None] * joints.normal
    made = lacking_flexibility(joints).moments(joints.normal, pull, shear)
    assert len(made) == 2
    for patch, moment in enumerate(made):
        own = joints.patch == patch
        arm = joints.point[own] - np.average(joints.point[own], axis=0, weights=joints.area[own])
        normal = joints.normal[own][0]
        twist = sum(normal @ np.cross(a, s) for a, s in zip(arm, shear[own], strict=True))
        assert moment == pytest.approx(pull[own] @ arm + twist * normal)


def test_nodes_of_a_face_share_out_its_area_a_third_of_each_triangle():
    blocks = boxes(((0, 0, 0), (300, 200, 50)))
    mesh, _ = mesh_by_fans(blocks, np.ones(1, dtype=bool), find_joints(blocks))
    top = [f for f in blocks.faces_of(0) if np.allclose(blocks.face(f)[:, 2], 0.05)]
    nodes, area = surface_nodes(mesh, blocks, np.array(top))
    assert area.sum() == pytest.approx(0.3 * 0.2)
    assert area @ mesh.nodes[nodes] / area.sum() == pytest.approx([0.15, 0.1, 0.05])


def test_tiles_end_half_way_between_neighbouring_points():
    blocks = boxes(((0, 0, 0), (300, 200, 50)), ((0, 0, 50), (300, 200, 100)))
    joints = find_joints(blocks, "vertex", [2, 2, 2])
    start, points = tiles(joints)
    corners, _ = pad(points, start, np.arange(len(points)))
    area = areas_normals_centroids(corners)[0]
    assert area == pytest.approx(joints.area), "of points at the corners alone they are the areas"


def test_a_flat_tet_is_told_by_three_inradii_over_the_circumradius():
    """Of a right corner with legs of 1: r = 1 / (3 + root 3), R = root 3 / 2."""
    nodes = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    mesh = TetMesh(nodes, np.array([0, 4]), np.array([[0, 1, 2, 3]]), np.array([0, 1]))
    measures = quality(boxes(((0, 0, 0), (1, 1, 1))), find_joints(boxes(((0, 0, 0), (1, 1, 1)))), mesh).flattest_tet
    assert measures.value == pytest.approx(3.0 / (3.0 + 3.0**0.5) / (3.0**0.5 / 2.0))
