"""Power diagrams in space: whole, watertight and flat, whatever the sites and the domain."""

import time

import numpy as np
import pytest

from geometry.blocks import Blocks, GeometryError
from geometry.cells.domain import Domain, box_domain
from geometry.cells.power import Power, tessellate
from geometry.cells.power_blocks import cell_volumes, edge_lengths, edges, to_blocks
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import face_areas_normals_centroids, volumes
from geometry.polyhedra.overlaps import check_overlaps
from tests.geometry.cells.solids import bends, hull_domain

LOW, HIGH = np.array([1.0, -0.2, 3.0]), np.array([1.230, -0.086, 3.065])
BRICK = box_domain(LOW, HIGH)
PYRAMID = hull_domain(np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]]))


def brick(n: int, seed: int = 0, spread: float = 0.0) -> tuple[np.ndarray, np.ndarray, float]:
    """Random sites and weights in the brick, and h."""
    rng = np.random.default_rng(seed)
    h = (BRICK.volume / n) ** (1 / 3)
    return rng.uniform(LOW, HIGH, (n, 3)), spread * h**2 * rng.uniform(size=n), h


def euler_of_cells(blocks: Blocks) -> np.ndarray:
    """Corners - edges + faces of each block."""
    owner = np.repeat(blocks.face_block(), np.diff(blocks.face_start))
    corner = np.unique(owner * len(blocks.points) + blocks.face_points) // len(blocks.points)
    half_edges = np.bincount(owner, minlength=blocks.count)
    assert np.all(half_edges % 2 == 0)
    return np.bincount(corner, minlength=blocks.count) - half_edges // 2 + np.diff(blocks.block_face_start)


def euler_of_whole(power: Power) -> int:
    return len(power.vertices) - len(edges(power)) + len(power.cell) - power.count


def assert_sound(power: Power, domain: Domain) -> None:
    h = (domain.volume / power.count) ** (1 / 3)
    blocks = to_blocks(power, np.zeros(power.count))
    assert np.all(euler_of_cells(blocks) == 2)
    assert euler_of_whole(power) == 1
    volume = volumes(blocks)
    assert volume.min() > 0
    assert volume.sum() == pytest.approx(domain.volume, rel=1e-12)
    np.testing.assert_allclose(volume, cell_volumes(power), rtol=1e-9, atol=1e-12 * h**3)
    assert bends(power).max() < 1e-9 * h


@pytest.mark.parametrize("n", [1, 2, 3, 5, 218, 2000])
def test_cells_of_random_sites_fill_the_brick_with_flat_faces_and_obey_eulers_formula(n):
    site, weight, _ = brick(n, spread=0.05 if n > 5 else 0.0)
    assert_sound(tessellate(site, weight, BRICK), BRICK)


def test_every_point_belongs_to_the_cell_whose_power_distance_is_least():
    site, weight, h = brick(218, spread=0.1)
    power = tessellate(site, weight, BRICK)
    blocks = to_blocks(power, np.zeros(218))
    _, normal, centroid = face_areas_normals_centroids(blocks)
    point = np.random.default_rng(5).uniform(LOW, HIGH, (500, 3))
    nearest = np.argmin(((point[:, None] - site) ** 2).sum(axis=2) - weight, axis=1)
    for x, cell in zip(point, nearest, strict=True):
        faces = blocks.faces_of(cell)
        level = np.einsum("fi,fi->f", x - centroid[faces.start : faces.stop], normal[faces.start : faces.stop])
        assert level.max() < 1e-9 * h


def test_neighbours_share_their_faces_and_nothing_overlaps():
    site, weight, _ = brick(60, spread=0.05)
    power = tessellate(site, weight, BRICK)
    blocks = to_blocks(power, np.zeros(60))
    check_overlaps(blocks)
    joints = find_joints(blocks)
    shared = {tuple(pair) for pair in np.stack([power.cell, power.other], axis=1)[power.other >= 0].tolist()}
    assert {(int(a), int(b)) for a, b in zip(joints.block_a, joints.block_b, strict=True)} == shared


def test_vertices_on_the_walls_of_a_box_lie_on_them_to_the_bit():
    site, weight, _ = brick(218)
    power = tessellate(site, weight, BRICK)
    for wall in range(6):
        corners = [
            power.face_points[power.face_start[f] : power.face_start[f + 1]]
            for f in np.flatnonzero(power.other == ~wall)
        ]
        level = power.vertices[np.concatenate(corners), wall % 3]
        assert np.all(level == (LOW if wall < 3 else HIGH)[wall % 3])


@pytest.mark.parametrize("cells", [(1, 1, 2), (3, 2, 2), (7, 5, 4)])
def test_a_regular_lattice_gives_boxes_with_six_faces_of_four_corners(cells):
    axes = [(np.arange(k) + 0.5) / k for k in cells]
    site = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    domain = box_domain(np.zeros(3), np.ones(3))
    power = tessellate(site, np.zeros(len(site)), domain)
    assert_sound(power, domain)
    assert np.all(np.diff(power.cell_start) == 6) and np.all(np.diff(power.face_start) == 4)
    np.testing.assert_allclose(cell_volumes(power), 1 / len(site), rtol=1e-13)


def test_a_body_centred_lattice_gives_kelvins_cells():
    corner = np.stack(np.meshgrid(*[np.arange(5) + 0.25] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    domain = box_domain(np.zeros(3), np.full(3, 5.0))
    power = tessellate(np.concatenate([corner, corner + 0.5]), np.zeros(250), domain)
    assert_sound(power, domain)
    faces = np.diff(power.cell_start)
    inner = faces == 14
    np.testing.assert_allclose(cell_volumes(power)[inner], 0.5, rtol=1e-12)
    assert inner.sum() >= 27 and edge_lengths(power).min() > 0.05


def test_domains_other_than_boxes_are_filled_too():
    rng = np.random.default_rng(1)
    ball = hull_domain(rng.normal(size=(40, 3)))
    for domain in (PYRAMID, ball):
        low, high = domain.corners.min(axis=0), domain.corners.max(axis=0)
        site = rng.uniform(low, high, (800, 3))
        site = site[domain.contains(site)]
        power = tessellate(site, np.zeros(len(site)), domain)
        assert_sound(power, domain)
        assert np.unique(power.other[power.other < 0]).size == len(domain.normal)


def test_sites_may_lie_outside_the_domain_and_a_site_may_be_left_without_a_cell():
    site, weight, h = brick(50)
    site[0, 0] -= 0.2 * h + site[0, 0] - LOW[0]
    power = tessellate(site, weight, BRICK)
    assert cell_volumes(power).sum() == pytest.approx(BRICK.volume, rel=1e-12)
    weight[7] = -10 * h**2
    power = tessellate(site, weight, BRICK)
    assert power.cell_start[8] == power.cell_start[7]
    assert cell_volumes(power).sum() == pytest.approx(BRICK.volume, rel=1e-12)
    with pytest.raises(GeometryError, match="site 7 has no cell"):
        to_blocks(power, np.zeros(50))


@pytest.mark.parametrize(
    ("domain", "message"),
    [
        (lambda: box_domain(np.zeros(3), np.array([1.0, 0.0, 1.0])), "no volume"),
        (lambda: Domain(np.eye(3), np.ones(3)).corners, "not bounded"),
        (lambda: Domain(np.concatenate([np.eye(3), -np.eye(3)]), np.r_[1, 1, 1, -2, 0, 0]).corners, "no volume"),
        (lambda: hull_domain(np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])), "no volume"),
        (lambda: tessellate(np.full((2, 3), np.nan), np.zeros(2), BRICK), "finite"),
    ],
)
def test_a_domain_or_site_that_makes_no_sense_is_refused_in_a_sentence(domain, message):
    with pytest.raises(GeometryError, match=message):
        domain()


@pytest.mark.slow
def test_fifty_thousand_cells_take_less_than_15_seconds():
    site, weight, _ = brick(50_000)
    begin = time.process_time()
    power = tessellate(site, weight, BRICK)
    to_blocks(power, np.zeros(power.count))
    assert time.process_time() - begin < 15
    assert_sound(power, BRICK)
