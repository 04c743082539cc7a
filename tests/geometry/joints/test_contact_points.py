import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from geometry.blocks import GeometryError
from geometry.joints.contact_points import contact_points
from geometry.joints.find import find_joints
from geometry.joints.point_density import Density, widest_gap
from geometry.polyhedra.construct import concatenate, from_faces
from geometry.specimens.stacked import couplet

DENSITIES = [
    *({"per_edge": n} for n in (1, 2, 3, 5, (2, 10, 3))),
    *({"per_face": n} for n in (1, 2, 3, 4, 5, 7, 9, 20, 60)),
    *({"spacing": d} for d in (0.04, 0.3, 5.0)),
]
CASES = [("gauss", kind) for kind in DENSITIES]
CASES += [("vertex", kind) for kind in DENSITIES if kind.get("per_edge") != 1 and kind.get("per_face", 4) >= 4]


def convex_polygon(seed, stretch):
    """Corners (n, 2) on a turned ellipse, counter-clockwise, no two close together."""
    random = np.random.default_rng(seed)
    gaps = random.uniform(0.3, 1.0, random.integers(3, 9))
    angle = random.uniform(0, 6) + 2 * np.pi * np.cumsum(gaps) / gaps.sum()
    corner = np.column_stack([np.cos(angle), stretch * np.sin(angle)]) * random.uniform(0.1, 1)
    turn = random.uniform(0, 6)
    return corner @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])


def clipped(flat, window):
    """What of a convex polygon lies in another, corner by corner: no code shared with geometry.polyhedra.polygons."""
    for start, end in zip(window, np.roll(window, -1, axis=0), strict=True):
        edge = end - start
        side = [edge[0] * (p[1] - start[1]) - edge[1] * (p[0] - start[0]) for p in flat]
        kept = []
        for k, p in enumerate(flat):
            q, s, t = flat[(k + 1) % len(flat)], side[k], side[(k + 1) % len(flat)]
            kept += [p] if s >= 0 else []
            kept += [p + s / (s - t) * (q - p)] if s * t < 0 else []
        flat = np.array(kept)
        if len(flat) < 3:
            return flat
    return flat


def area_and_moment(flat):
    x, y = flat.T
    after = np.roll(flat, -1, axis=0)
    cross = x * after[:, 1] - after[:, 0] * y
    return cross.sum() / 2, cross @ (flat + after) / 6


def points_of(flat, rule, kind, turn=None):
    corners = np.column_stack([flat, np.zeros(len(flat))])
    corners = corners if turn is None else corners @ turn.T
    return contact_points(corners[None], np.array([len(flat)]), Density(rule, **kind))[1:]


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10**6), st.floats(0.1, 1.0))
def test_points_of_the_overlap_of_two_blocks_carry_its_area_and_first_moments_in_any_orientation(prism, seed, stretch):
    below, above = convex_polygon(seed, stretch), convex_polygon(seed + 1, 0.7) + 0.1
    overlap = clipped(below, above)
    area, moment = area_and_moment(overlap) if len(overlap) > 2 else (0.0, np.zeros(2))
    if 0 < area < 1e-3:
        return  # nearly a line: the exact area of such an overlap is not known to 1e-12 either
    random = np.random.default_rng(seed)
    turn, shift = Rotation.random(rng=random).as_matrix(), random.uniform(-1, 1, 3)
    solids = [[face @ turn.T + shift for face in prism(*p)] for p in ((below, -1.0, 0.0), (above, 0.0, 1.0))]
    blocks = concatenate([from_faces([solid], [n], [0], ["g"]) for n, solid in enumerate(solids)])
    for rule, kind in CASES[:: 1 + seed % 4]:
        words = {{"per_edge": "points_per_edge", "per_face": "points_per_face"}.get(k, k): v for k, v in kind.items()}
        joints = find_joints(blocks, rule, **words)
        assert np.all(joints.area > 0)
        assert joints.area.sum() == pytest.approx(area, rel=1e-12, abs=1e-15)
        local = (joints.point - shift) @ turn
        assert np.allclose(joints.area @ local, [*moment, 0], rtol=0, atol=1e-12 * np.ptp(below, axis=0).max() ** 3)


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10**6), st.floats(0.1, 1.0))
def test_all_points_lie_in_their_polygon(seed, stretch):
    flat = convex_polygon(seed, stretch)
    edge = np.roll(flat, -1, axis=0) - flat
    for rule, kind in CASES:
        point = points_of(flat, rule, kind)[0][:, :2]
        arm = point[:, None] - flat
        assert np.all(edge[:, 0] * arm[..., 1] - edge[:, 1] * arm[..., 0] > -1e-12)


@pytest.mark.parametrize("number", [1, 2, 3, 4, 5])
def test_a_hexagon_gets_just_as_many_points_of_equal_area_as_are_asked_for_up_to_its_corners(number):
    angle = np.arange(6) * np.pi / 3
    share = points_of(np.column_stack([np.cos(angle), np.sin(angle)]), "gauss", {"per_face": number})[1]
    assert len(share) == number
    assert np.allclose(share, share.sum() / number, rtol=1e-12)


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10**6), st.integers(4, 400), st.sampled_from(["gauss", "vertex"]))
def test_a_polygon_gets_about_as_many_points_as_are_asked_for(seed, number, rule):
    """Within a factor of two, or as many as it has corners: a fan of k triangles has k, 3k, 4k, 9k, ... places, or with
    points at its corners k, 2k + 1, 7k + 1, ..., and no numbers in between."""
    count = len(points_of(convex_polygon(seed, 0.6), rule, {"per_face": number})[1])
    assert number / 2.2 <= count <= max(2.2 * number, 8 if rule == "vertex" else 0)


@pytest.mark.parametrize(
    ("length", "number", "grid"), [(1, 9, (3, 3)), (4, 16, (8, 2)), (10, 4, (2, 2)), (2, 2, (2, 1))]
)
def test_a_rectangle_gets_as_many_points_in_the_ratio_of_its_sides(length, number, grid):
    flat = np.array([[0, 0], [length, 0], [length, 1], [0, 1.0]])
    point = points_of(flat, "gauss", {"per_face": number})[0]
    assert tuple(len(np.unique(point[:, k].round(9))) for k in range(2)) == grid


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10**6), st.floats(0.02, 0.5), st.sampled_from(["gauss", "vertex"]), st.booleans())
def test_neighbouring_points_are_no_further_apart_than_the_spacing(seed, spacing, rule, rectangle):
    flat = convex_polygon(seed, 0.5)
    if rectangle:
        low, high = flat.min(axis=0), flat.max(axis=0)
        flat = np.array([low, [high[0], low[1]], high, [low[0], high[1]]])
    point = points_of(flat, rule, {"spacing": spacing})[0]
    if len(point) > 1:
        apart = cKDTree(point).query(point, 2)[0][:, 1]
        assert apart.max() <= spacing * (1 + 1e-9)
    if rectangle and rule == "gauss":
        for k in range(2):
            place = np.unique(point[:, k].round(12))
            assert np.diff(place, prepend=2 * flat[0, k] - place[0]).max() <= spacing * (1 + 1e-9)


def test_a_spacing_is_met_with_the_fewest_points():
    flat = np.array([[0, 0], [0.1, 0], [0.1, 0.03], [0, 0.03]])
    assert len(points_of(flat, "gauss", {"spacing": 0.0578})[1]) == 2  # 0.1 m / sqrt(3) = 57.7 mm along, one across
    assert len(points_of(flat, "vertex", {"spacing": 0.05})[1]) == 3 * 2


@pytest.mark.parametrize(("spacing", "count"), [(0.2501, 9), (0.2499, 36), (0.1251, 36), (0.1249, 81)])
def test_three_points_in_a_triangle_lie_half_an_edge_apart(spacing, count):
    """The longest edge of the fan of this triangle is 0.5 m."""
    flat = np.array([[0.0, 0.0], [0.5, 0.0], [0.2, 0.3]])
    assert len(points_of(flat, "gauss", {"spacing": spacing})[1]) == count


def test_ten_points_through_the_thickness_and_two_along_the_other_edges():
    joints = find_joints(couplet(0.2, 0.05, 0.06, (2, 1, 1)).blocks, "gauss", (2, 10, 2))
    for patch in range(len(joints.patch_start) - 1):
        point = joints.point[joints.patch == patch]
        assert sorted(len(np.unique(point[:, axis].round(9))) for axis in range(3)) == [1, 2, 10]
        assert len(np.unique(point[:, 1].round(9))) == 10


def test_a_skew_edge_takes_the_number_of_the_axis_it_is_most_aligned_with():
    flat = np.array([[0, 0], [1, 0.2], [1.3, 1.2], [0.3, 1]])
    assert len(points_of(flat, "gauss", {"per_edge": (4, 3, 7)})[1]) == 12
    upright = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])
    assert len(points_of(flat, "gauss", {"per_edge": (4, 3, 7)}, upright.T)[1]) == 28


@pytest.mark.parametrize("kind", [{"per_edge": 2}, {"per_edge": 4}, {"per_face": 40}, {"spacing": 0.3}])
def test_three_points_in_each_triangle_integrate_quadratic_fields_exactly(kind):
    flat = convex_polygon(7, 0.6)
    point, share = points_of(flat, "gauss", kind)
    if len(share) % (3 * len(flat)) == 0:
        x, y = flat.T
        x2, y2 = np.roll(x, -1), np.roll(y, -1)
        second = np.sum((x * y2 - x2 * y) * (x * x + x * x2 + x2 * x2)) / 12
        assert share @ point[:, 0] ** 2 == pytest.approx(second, rel=1e-12)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"points_per_edge": (2, 0, 2)}, "points_per_edge is 0.*at least 1; nearest: 1"),
        ({"points_per_edge": (2, 2)}, "allowed: one number, or three"),
        ({"points_per_edge": 2.5}, "2.5.*whole number.*nearest: 2"),
        ({"points_per_face": 0}, "points_per_face is 0.*at least 1"),
        ({"rule": "vertex", "points_per_face": 3}, "at least 4; nearest: 4"),
        ({"points_per_face": 4, "spacing": 0.1}, "exclude each other"),
        ({"spacing": 0.0}, "must be above 0"),
        ({"spacing": np.nan}, "must be above 0"),
        ({"spacing": 1e-6}, "too fine for an edge of 0.2 m; nearest: 0.001 m"),
    ],
)
def test_what_gives_no_points_or_far_too_many_is_refused(wrong, words):
    with pytest.raises(GeometryError, match=words):
        find_joints(couplet(0.2, 0.05, 0.05).blocks, **wrong)


def test_a_face_that_is_there_twice_is_one_joint_and_the_other_is_counted(prism):
    flat = convex_polygon(3, 0.8)
    below, above = prism(flat, -1.0, 0.0), prism(flat, 0.0, 1.0)
    once = find_joints(from_faces([below, above], [0, 1], [0, 0], ["g"]))
    twice = find_joints(from_faces([[*below, below[1]], above], [0, 1], [0, 0], ["g"]))
    assert (once.repeated, twice.repeated) == (0, 1)
    assert np.allclose(twice.area, once.area, rtol=1e-14)
    assert np.allclose(twice.point, once.point, atol=1e-14)


def test_neighbouring_pieces_of_one_face_are_joints_of_their_own(prism):
    piece = [np.array([[x, 0, 0], [x + 1, 0, 0], [x + 1, 1, 0], [x, 1, 0.0]]) for x in (0, 1)]
    square = np.array([[0, 0], [2, 0], [2, 1], [0, 1.0]])
    below, above = prism(square, -1.0, 0.0), prism(square, 0.0, 1.0)
    joints = find_joints(from_faces([[*piece, below[0], *below[2:]], above], [0, 1], [0, 0], ["g"]), "vertex")
    assert joints.repeated == 0 and joints.area.sum() == pytest.approx(2, rel=1e-14)


def test_a_fine_spacing_tries_few_numbers_of_points():
    """Places of Gauss points take time that grows with the cube of their number."""
    widest_gap.cache_clear()
    Density("gauss", 2, None, 0.001)._by_spacing(np.array([[0.2, 0.05], [0.2, 0.05]]))
    assert widest_gap.cache_info().misses < 20
