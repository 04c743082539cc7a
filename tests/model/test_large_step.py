"""The time step of blocks that turn: proven against exact eigenvalues, and the same from wherever one looks."""

import numpy as np
import pytest

from masonry.kinematics import deforming, deforming_tets
from masonry.kinematics.dispatch import move, update_positions
from masonry.laws.elastic import Elastic
from masonry.laws.state import JointProperties
from masonry.model import phase_sums, stable_step
from masonry.model.large import row_sums as large_sums
from masonry.model.large.bodies import large
from masonry.model.layout import Material
from masonry.model.model import Stepping
from tests.model.eigen import true_limit
from verification.fixtures import models, shapes

KINDS = ("rigid", "affine", "tets")
SHEAR = np.array([[1.0, 0.0, 0.4], [0.0, 1.0, 0.2], [0.0, 0.0, 1.0]])
LAME, MU = models.STONE.lame()


@pytest.fixture
def with_large_sums(monkeypatch) -> dict:
    """Models are built on the sums of large/row_sums.py; returns what it was called with."""
    seen = {}

    class Sums:
        def __getattr__(self, name):
            return getattr(stable_step, name)

        def contact_row_sums(self, sums, sides, normal, kn, ks):
            seen.update(sides=sides, stiffness=np.maximum(kn, ks))
            large_sums.contact_row_sums(sums, sides, np.maximum(kn, ks))

        def affine_row_sums(self, sums, layout, lame, length):
            large_sums.affine_row_sums(sums, layout, lame, length, seen.get("stretch", 1.0))

        def tet_row_sums(self, sums, layout, lame):
            seen.update(lame=lame)
            large_sums.tet_row_sums(sums, layout, lame, seen.get("stretch", 1.0))

    monkeypatch.setattr(phase_sums, "stable_step", Sums())
    return seen


def stack(kinds, heights, kn, ks, young, masses, damping, turn=None, **points):
    """Skewed blocks one above the other, turned or not."""
    s = shapes.setup(shapes.skewed(shapes.stack(heights, (0.2, 0.12)), SHEAR), kinds, mesh_size=0.2, **points)
    s = s if turn is None else shapes.mapped(s, turn)
    stepping = Stepping(masses, damping=damping)
    return models.make(s, (Elastic(), JointProperties(kn, ks)), stepping, material=Material(1900.0, young, 0.2))


@pytest.mark.parametrize("masses", ["real", "scaled"])
@pytest.mark.parametrize("kinds", [("rigid",) * 3, ("affine",) * 3, ("tets",) * 3, KINDS])
def test_the_bound_is_below_the_true_limit_and_not_far_from_that_of_small_displacements(
    masses, kinds, monkeypatch, request
):
    for heights in ([0.05, 0.07, 0.06], [0.1, 0.004, 0.06]):
        for kn, ks, young in ((2e11, 8e10, 5e9), (1e9, 3e9, 1e10), (1e12, 1e10, 1e10)):
            case = kinds, heights, kn, ks, young, masses, 0.3
            small = stack(*case)
            with monkeypatch.context():
                request.getfixturevalue("with_large_sums")
                big = stack(*case)
            limit = true_limit(big)
            assert big.bound <= limit * (1 + 1e-9)
            assert big.bound >= 0.3 * small.bound


def test_no_turn_changes_the_sums(with_large_sums):
    turn = np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))[0]
    steps = [
        stack(KINDS, [0.05, 0.07, 0.06], 2e11, 8e10, 5e9, masses, 0.0, by).bound
        for masses in ("real", "scaled")
        for by in (np.eye(3), turn * np.linalg.det(turn))
    ]
    assert steps[0] == pytest.approx(steps[1], rel=1e-9)
    assert steps[2] == pytest.approx(steps[3], rel=1e-9)


def test_all_sums_in_one_call_are_those_of_the_parts(with_large_sums):
    with_large_sums["stretch"] = 1.1
    found = stack(KINDS, [0.05, 0.07, 0.06], 2e11, 8e10, 5e9, "scaled", 0.0)
    sides, k, lame = (with_large_sums[name] for name in ("sides", "stiffness", "lame"))
    block = np.concatenate([found.joints.block_a, found.joints.block_b])
    length = stable_step.lengths(found.layout, block, np.concatenate([s.arm for s in sides]))
    sums = large_sums.row_sums(found.layout, sides, k, lame, length, 1.1)
    for kind, rows in sums.items():
        assert rows * (found.dt / 1.8) ** 2 == pytest.approx(found.masses[kind], rel=1e-12)
    wider = large_sums.row_sums(found.layout, sides, k, lame, length, 1.2, slack=0.01)
    assert all((wider[kind] > sums[kind]).all() for kind in KINDS[1:])


def tangent(kind: str, f: np.ndarray) -> tuple[np.ndarray, np.ndarray, float, object]:
    """Stiffness of one block where every point went to f x and a little elsewhere, its masses, the largest stretch."""
    s = shapes.setup(shapes.skewed(shapes.stack([0.12]), SHEAR), [kind])
    found = models.make(s)
    found.bodies = large(found.bodies, np.zeros((0, 3)))
    body, u, force = getattr(found.bodies, kind), found.contacts.u, found.contacts.force
    where = models.positions(found)[kind]
    base = models.linear_field(found, np.zeros(3), f - np.eye(3))
    base += 0.002 * np.random.default_rng(6).normal(size=base.shape) * (kind == "tets")

    def forces(at: np.ndarray) -> np.ndarray:
        where[...] = at.reshape(where.shape)
        body.v[...] = 0.0
        update_positions(None, body, 0.0, u)
        move(None, body, found.dt, None, (1.0, 1.0, 0.0, 0.0), force, u)
        return body.inner.ravel().copy()

    step = 1e-6
    columns = [(forces(base + step * e) - forces(base - step * e)) / (2 * step) for e in np.eye(len(base))]
    forces(base)
    stress, observe = np.zeros((1, 6)), deforming.observe if kind == "affine" else deforming_tets.observe
    largest = observe(body, stress)[2] if kind == "affine" else observe(body, u, stress)[2]
    return -np.stack(columns, axis=1), found.masses[kind], largest, found.layout


@pytest.mark.parametrize("kind", KINDS[1:])
@pytest.mark.parametrize("size", [0.8, 1.0, 1.2])
def test_a_stretched_and_turned_block_stays_below_the_bound_of_its_stretch(kind, size):
    f = np.linalg.qr(np.random.default_rng(7).normal(size=(3, 3)))[0]
    f = size * f * np.linalg.det(f) @ np.diag([1.0, 0.9, 0.95])
    stiffness, masses, largest, layout = tangent(kind, f)
    stretch = max(largest, 1.0)
    sums = np.zeros_like(masses)
    length = stable_step.lengths(layout, np.zeros(0, dtype=int), np.zeros((0, 3)))
    if kind == "affine":
        large_sums.affine_row_sums(sums, layout, np.array([[LAME, MU]]), length, stretch)
        sums[:, 3:] *= np.tile(length, 3) ** 2
    else:
        large_sums.tet_row_sums(sums, layout, np.array([[LAME, MU]]), stretch)
    root = np.sqrt(masses.ravel())
    scaled = stiffness / np.outer(root, root)
    assert scaled == pytest.approx(scaled.T, abs=1e-6 * np.abs(scaled).max())
    highest = np.linalg.eigvalsh(0.5 * (scaled + scaled.T))[-1]
    bound = (sums / masses).max()
    assert highest <= bound
    assert bound < 6.0 * highest or size <= 1.0


def test_the_norm_of_a_pair_is_that_of_its_matrix():
    rng = np.random.default_rng(8)
    for lame, mu in ((1.0, 1.0), (3.0, 0.1), (0.0, 1.0), (-0.3, 1.0)):
        for _ in range(20):
            a, b = (v / np.linalg.norm(v) for v in rng.normal(size=(2, 3)))
            matrix = lame * np.outer(a, b) + mu * np.outer(b, a) + mu * (a @ b) * np.eye(3)
            found = large_sums.pair_norm(np.float64(lame), np.float64(mu), a @ b)
            assert found == pytest.approx(np.linalg.norm(matrix, 2), rel=1e-12)
