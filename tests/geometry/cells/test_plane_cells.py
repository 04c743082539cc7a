"""Plane cells: power diagrams whose sizes, edges and joints are as asked, and whose gradient is exact."""

import hashlib
import os
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from geometry.blocks import GeometryError
from geometry.cells.plane import areas_and_centroids, hold_sizes, plane_diagram
from geometry.cells.plane_cells import divide_plane
from geometry.cells.plane_domains import plane_domains
from geometry.cells.plane_energy import PlaneTargets, energy, tessellate
from geometry.cells.request import CellRequest
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import face_areas_normals_centroids, volumes
from geometry.polyhedra.overlaps import check_overlaps
from geometry.specimens.filling import fill_with_cells

HEXAGON = np.array([[np.cos(a), np.sin(a)] for a in np.arange(6) * np.pi / 3])


LENGTH, HEIGHT, DEPTH = 0.5, 0.492, 0.0115


def modules() -> tuple[np.ndarray, np.ndarray]:
    """Low and high corners of four courses in running bond, 500 mm long."""
    cuts = ([0.0, 0.25, 0.5], [0.0, 0.125, 0.375, 0.5]) * 2
    low = [(a, 0.0, 0.123 * c) for c, course in enumerate(cuts) for a in course[:-1]]
    high = [(b, DEPTH, 0.123 * (c + 1)) for c, course in enumerate(cuts) for b in course[1:]]
    return np.array(low), np.array(high)


def wall(total: int, seed: int = 0, **how):
    return fill_with_cells(*modules(), CellRequest(total=total, seed=seed, **how), "units")


@pytest.mark.parametrize("total", [218, 335, 540])
def test_a_wallette_has_just_the_cells_asked_for_equal_in_size_with_no_short_edge_and_no_sliver_of_joint(total):
    blocks, report = wall(total)
    assert blocks.count == report.count == total
    low, high = modules()
    whole = np.prod(high - low, axis=1)
    volume = volumes(blocks)
    np.testing.assert_allclose(np.bincount(blocks.unit, volume), whole, rtol=1e-13)
    cells = np.bincount(blocks.unit)
    np.testing.assert_allclose(volume, (whole / cells)[blocks.unit], rtol=1e-9)
    assert report.shortest_over_mean >= 0.44 and report.small_edges == 0.0
    assert report.shortest_joint is not None and report.shortest_joint >= 0.29
    check_overlaps(blocks)


def test_the_report_says_what_the_joints_of_the_blocks_show():
    blocks, report = wall(218)
    joints = find_joints(blocks)
    normal = joints.normal[np.unique(joints.patch, return_index=True)[1]]
    start, point = joints.patch_start, joints.patch_points
    width = np.array([np.ptp(point[a:b], axis=0) for a, b in zip(start[:-1], start[1:], strict=True)])
    length = np.hypot(width[:, 0], width[:, 2])
    between = blocks.unit[joints.block_a] != blocks.unit[joints.block_b]
    of_units = between[np.unique(joints.patch, return_index=True)[1]]
    assert length[of_units].min() / report.h == pytest.approx(report.shortest_joint, rel=1e-6)
    assert length[~of_units].min() / report.h >= report.shortest - 1e-6
    assert np.abs(normal[:, 1]).max() == 0.0


def test_the_joints_of_a_wall_of_cells_cover_its_inner_faces_once():
    blocks, _ = wall(218)
    joints = find_joints(blocks)
    area, normal, _ = face_areas_normals_centroids(blocks)
    inner = area[np.abs(normal[:, 1]) < 0.5].sum() - 2 * DEPTH * (LENGTH + HEIGHT)
    assert 2 * joints.area.sum() == pytest.approx(inner, rel=1e-12)


@pytest.mark.parametrize("total", [100, 300])
def test_a_mortar_bed_of_cells_has_no_short_edge(total):
    low, high = np.array([[0.0, 0.0, 0.05]]), np.array([[0.2, 0.005, 0.065]])
    blocks, report = fill_with_cells(low, high, CellRequest(total=total), "mortar")
    assert blocks.count == total and report.shortest_joint is None
    assert report.shortest_over_mean >= 0.35 and report.small_edges == 0.0 and report.size_error < 1e-9


def test_lognormal_sizes_have_the_spread_asked_for_and_are_met():
    blocks, report = wall(540, spread=0.3)
    volume = volumes(blocks)
    mean = np.bincount(blocks.unit, volume) / np.bincount(blocks.unit)
    ratio = volume / mean[blocks.unit]
    assert np.std(ratio) == pytest.approx(0.3, abs=0.03)
    assert report.size_error < 1e-8 and report.small_edges == 0.0


def test_given_sizes_are_met_in_every_unit():
    low, high = np.array([[0.0, 0, 0], [1, 0, 0]]), np.array([[1.0, 1, 1], [2, 1, 1]])
    sizes = (1.0, 2.0, 3.0, 4.0, 5.0)
    blocks, report = fill_with_cells(low, high, CellRequest(total=10, sizes=sizes), "units")
    np.testing.assert_allclose(volumes(blocks).reshape(2, 5), [np.array(sizes) / 15] * 2, rtol=1e-9)
    assert report.small_edges == 0.0


def test_own_sites_without_regularisation_give_their_voronoi_cells():
    site = [(0.25, 0.5, 0.25), (0.75, 0.5, 0.25), (0.25, 0.5, 0.75), (0.75, 0.5, 0.75)]
    asked = CellRequest(total=4, sites=tuple(site), laguerre=False, regularise=False)
    blocks, _ = fill_with_cells(np.zeros((1, 3)), np.ones((1, 3)), asked, "units")
    np.testing.assert_allclose(volumes(blocks), 0.25, rtol=1e-15)
    assert len(blocks.face_start) - 1 == 4 * 6, "four corners that meet in one point are no edge"
    rng = np.random.default_rng(3)
    site = rng.uniform(0, 1, (12, 3))
    asked = CellRequest(total=12, sites=tuple(map(tuple, site)), laguerre=False, regularise=False)
    blocks, _ = fill_with_cells(np.zeros((1, 3)), np.ones((1, 3)), asked, "units")
    point = rng.uniform(0, 1, (2000, 2))
    nearest = np.argmin(np.linalg.norm(point[:, None] - site[None][:, :, [0, 2]], axis=2), axis=1)
    for b in range(12):
        loop = blocks.face(blocks.faces_of(b)[0])[:, [0, 2]]
        side = np.roll(loop, -1, axis=0) - loop
        arm = point[:, None] - loop
        inside = np.all(side[:, 0] * arm[..., 1] - side[:, 1] * arm[..., 0] >= -1e-12, axis=1)
        np.testing.assert_array_equal(inside, nearest == b)


def random_state(rng, n):
    diagram = plane_diagram(
        plane_domains([HEXAGON, HEXAGON + [1.5, np.sqrt(0.75)]], np.array([n, n]), 0.3), np.zeros((2 * n, 2))
    )
    site = np.concatenate([rng.uniform(-0.6, 0.6, (n, 2)), rng.uniform(-0.6, 0.6, (n, 2)) + [1.5, np.sqrt(0.75)]]) / 0.3
    return diagram, site, rng.uniform(-0.05, 0.05, 2 * n)


@given(seed=st.integers(0, 10**6), n=st.integers(2, 25))
@settings(max_examples=40, deadline=None)
def test_the_gradient_of_the_energy_is_its_slope(seed, n):
    rng = np.random.default_rng(seed)
    diagram, site, weight = random_state(rng, n)
    wishes = PlaneTargets(np.full(2 * n, 20 / n), 0.7, 0.6, 3.0, 1.0, 2.0)
    room = diagram.corner, diagram.label, diagram.count

    def value(s, w):
        g, k = np.empty_like(s), np.empty_like(w)
        return energy(s, w, diagram.domains, wishes, *room, g, k), g, k

    total, to_site, to_weight = value(site, weight)
    if not np.isfinite(total):
        return
    ds, dw = rng.normal(size=site.shape), rng.normal(size=weight.shape)
    slope = np.sum(to_site * ds) + to_weight @ dw
    steps = [1e-5, 1e-6, 1e-7]
    numeric = [
        (value(site + e * ds, weight + e * dw)[0] - value(site - e * ds, weight - e * dw)[0]) / (2 * e) for e in steps
    ]
    scale = np.abs(to_site).sum() + np.abs(to_weight).sum() + 1.0
    assert min(abs(slope - x) for x in numeric) < 1e-5 * scale


@given(seed=st.integers(0, 10**6), n=st.integers(1, 40))
@settings(max_examples=40, deadline=None)
def test_the_cells_of_a_power_diagram_fill_any_convex_polygon(seed, n):
    diagram, site, weight = random_state(np.random.default_rng(seed), n)
    assert tessellate(site, weight, diagram.domains, diagram.corner, diagram.label, diagram.count)
    diagram.site, full = site, diagram.count >= 3
    area = areas_and_centroids(diagram)[0][full]
    assert area.sum() == pytest.approx(2 * 1.5 * np.sqrt(3) / 0.09, rel=1e-12)


def test_weights_found_by_newton_give_the_sizes_asked_for():
    rng = np.random.default_rng(1)
    diagram, site, _ = random_state(rng, 30)
    diagram.site = site
    target = rng.uniform(0.5, 1.5, 60)
    target *= np.repeat(1.5 * np.sqrt(3) / 0.09 / np.add.reduceat(target, [0, 30]), 30)
    assert hold_sizes(diagram, target)
    np.testing.assert_allclose(areas_and_centroids(diagram)[0], target, rtol=1e-9)


def test_polygons_that_are_no_boxes_are_divided_with_their_joints():
    polygons = [HEXAGON, HEXAGON + [1.5, np.sqrt(0.75)]]
    counts = np.array([20, 20])
    target = np.full(40, 1.5 * np.sqrt(3) / 20)
    rng = np.random.default_rng(0)
    sites = [np.concatenate([rng.uniform(-0.6, 0.6, (20, 2)), rng.uniform(-0.6, 0.6, (20, 2)) + [1.5, np.sqrt(0.75)]])]
    loops, report = divide_plane(polygons, counts, target, sites)
    assert report.shortest_joint > 0.2 and report.small_edges == 0.0
    cross = [np.cross(np.insert(p, 2, 0, 1), np.insert(np.roll(p, -1, axis=0), 2, 0, 1))[:, 2].sum() / 2 for p in loops]
    np.testing.assert_allclose(cross, target, rtol=1e-9)
    loops[0][:] = 0.0  # what is remembered stays as it was, and is not made again
    again, same = divide_plane(polygons, counts, target, sites)
    assert same is report and abs(again[0]).max() > 0.0
    turned, other = divide_plane(polygons[::-1], counts, target, [sites[0][::-1]])
    assert other is not report and not np.array_equal(turned[0], again[0])


def test_the_same_seed_gives_the_same_bits_in_another_process():
    code = (
        "import hashlib, sys; from tests.geometry.cells.test_plane_cells import fingerprint; "
        "sys.stdout.write(fingerprint(7) + fingerprint(8))"
    )
    env = {**os.environ, "PYTHONHASHSEED": "2", "OPENBLAS_NUM_THREADS": "2"}
    other = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=env, check=True)
    assert other.stdout == fingerprint(7) + fingerprint(8)
    assert fingerprint(7) != fingerprint(8)


def fingerprint(seed: int) -> str:
    blocks, _ = wall(60, seed)
    parts = (blocks.points, blocks.face_points, blocks.face_start, blocks.unit)
    return hashlib.sha256(b"".join(np.ascontiguousarray(part).tobytes() for part in parts)).hexdigest()


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"total": 3}, "there are 10 units; nearest: 10"),
        ({"total": 20, "sizes": (1.0, 2.0, 3.0)}, "there are 3 sizes, but a unit has"),
        ({"total": 20, "sizes": (1.0, -2.0)}, "greater than 0"),
        ({"total": 1, "sites": ((9.0, 9.0, 9.0),)}, "lies in no unit"),
        ({"total": 2, "sites": ((0.1, 0.005, 0.1),)}, "there are 1 sites"),
        ({"total": 1, "sites": ((0.1, 0.005, 0.1),)}, "holds no site"),
        ({"size": 1e-6}, "at most"),
        ({"total": 20, "sites": ((0.1, 0.005, 0.1),) * 20}, "holds no site"),
    ],
)
def test_what_cannot_be_divided_is_said(asked, words):
    with pytest.raises(GeometryError, match=words):
        fill_with_cells(*modules(), CellRequest(**asked), "units")


def test_exactly_one_way_to_say_how_many():
    with pytest.raises(GeometryError, match="exactly one"):
        CellRequest(total=3, size=0.1)
    with pytest.raises(GeometryError, match="exactly one"):
        CellRequest()


def test_two_sites_in_one_place_are_refused():
    asked = CellRequest(total=2, sites=((0.3, 0.5, 0.4),) * 2, laguerre=False, regularise=False)
    with pytest.raises(GeometryError, match=r"the site at x = 0.3, z = 0.4 m has no cell"):
        fill_with_cells(np.zeros((1, 3)), np.ones((1, 3)), asked, "units")
