"""Affine blocks and tets by St Venant-Kirchhoff: closed forms of a homogeneous deformation, turns, small strains."""

import numpy as np
import pytest

from masonry.kinematics import deforming, deforming_tets
from masonry.kinematics.dispatch import move, update_positions
from masonry.kinematics.matrices import rotations
from masonry.model.large.bodies import large
from tests.kinematics import bricks
from verification.fixtures import models, shapes

KINDS = ("affine", "tets")
LAME, MU = models.STONE.lame()
VOIGT = (0, 1, 2, 1, 0, 0), (0, 1, 2, 2, 2, 1)
GRADIENT = np.array([[0.05, 0.02, -0.01], [-0.03, -0.04, 0.02], [0.01, 0.03, 0.06]])
QUARTER = bricks.turn(2, np.pi / 2) @ bricks.turn(0, np.pi / 2)


def block(kind: str, which=large):
    """A block with slanted axes, as a model of large bodies or of small ones."""
    s = shapes.setup(
        shapes.skewed(shapes.stack([0.12]), np.array([[1.0, 0.3, 0.2], [0.1, 1.0, -0.2], [0, 0, 0.9]])), [kind]
    )
    model = models.make(s)
    model.bodies = which(model.bodies, np.zeros((0, 3)))
    return model


def deform(model, kind: str, f: np.ndarray) -> None:
    """Every point goes to f times where it was."""
    models.put(model, {kind: models.positions(model)[kind]}, models.linear_field(model, np.zeros(3), f - np.eye(3)))


def observed(model, kind: str) -> tuple[np.ndarray, float, float, float]:
    """Mean of Cauchy's stress (3, 3) Pa; energy (J), least det F, bound of the stretch."""
    stress = np.zeros((1, 6))
    where = (model.bodies.affine,) if kind == "affine" else (model.bodies.tets, model.contacts.u)
    strain = (deforming if kind == "affine" else deforming_tets).observe(*where, stress)
    full = np.zeros((3, 3))
    full[VOIGT] = full.T[VOIGT] = stress[0] / model.layout.volume[0]
    return full, *strain


def closed_form(f: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """Cauchy's stress, first Piola-Kirchhoff stress, energy per volume."""
    green = 0.5 * (f.T @ f - np.eye(3))
    second = LAME * np.trace(green) * np.eye(3) + 2.0 * MU * green
    energy = 0.5 * LAME * np.trace(green) ** 2 + MU * np.sum(green**2)
    return f @ second @ f.T / np.linalg.det(f), f @ second, energy


def inner_forces(model, kind: str) -> np.ndarray:
    """Forces of the block's own stiffness where it is now, without moving it."""
    body = getattr(model.bodies, kind)
    for loop, arguments in (
        (update_positions, (model.contacts.u,)),
        (move, (None, bricks.ALL_OF_IT, model.contacts.force, model.contacts.u)),
    ):
        loop(None, body, 0.0 if loop is update_positions else model.dt, *arguments)
    body.v[...] = 0.0
    return body.inner.copy()


@pytest.mark.parametrize("kind", KINDS)
def test_a_homogeneous_deformation_has_the_energy_stress_and_forces_of_the_closed_form(kind):
    model, f = block(kind), np.eye(3) + GRADIENT
    deform(model, kind, f)
    cauchy, piola, density = closed_form(f)
    stress, energy, least, largest = observed(model, kind)
    volume = model.layout.volume[0]
    assert stress == pytest.approx(cauchy, rel=1e-12, abs=1e-11 * np.abs(cauchy).max())
    assert energy == pytest.approx(volume * density, rel=1e-13)
    assert least == pytest.approx(np.linalg.det(f), rel=1e-13)
    assert np.linalg.norm(f, 2) <= largest < 1.1 * np.linalg.norm(f, 2)
    forces = inner_forces(model, kind)
    if kind == "affine":
        moment = forces[0, 3:].reshape(3, 3) @ model.layout.axes[0].T
        assert forces[0, :3] == pytest.approx(0.0, abs=0.0)
    else:
        moment = forces.T @ model.layout.mesh.nodes
        assert forces.sum(axis=0) == pytest.approx(0.0, abs=1e-13 * np.abs(forces).max())
    assert moment == pytest.approx(-volume * piola, abs=1e-12 * volume * np.abs(piola).max())


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("by", [QUARTER, bricks.turn(1, 0.8) @ bricks.turn(2, -2.5)])
def test_a_stressed_block_that_is_turned_keeps_its_energy_and_its_stress_turns_along(kind, by):
    model, f = block(kind), np.eye(3) + 0.1 * GRADIENT
    deform(model, kind, f)
    stress, energy, *_ = observed(model, kind)
    deform(model, kind, by @ f)
    turned, same, least, _ = observed(model, kind)
    assert same == pytest.approx(energy, rel=1e-12)
    assert turned == pytest.approx(by @ stress @ by.T, abs=1e-12 * np.abs(stress).max())
    assert least == pytest.approx(np.linalg.det(f), rel=1e-13)


@pytest.mark.parametrize("kind", KINDS)
def test_an_unstressed_block_that_is_turned_stays_without_stress(kind):
    model = block(kind)
    deform(model, kind, QUARTER)
    stress, energy, least, largest = observed(model, kind)
    assert np.abs(stress).max() < 1e-14 * models.STONE.young_modulus
    assert energy < 1e-28 * models.STONE.young_modulus * model.layout.volume[0]
    assert (least, largest) == pytest.approx((1.0, 1.0), rel=1e-13)


@pytest.mark.parametrize("kind", KINDS)
def test_the_frame_of_a_block_is_its_deformation_gradient(kind):
    model, f = block(kind), bricks.turn(0, 1.2) @ (np.eye(3) + GRADIENT)
    deform(model, kind, f)
    inner_forces(model, kind)
    frame = getattr(model.bodies, kind).frame
    assert frame[0] == pytest.approx(f, abs=1e-13)
    u, _, v = np.linalg.svd(f)
    assert rotations(frame)[0] == pytest.approx(u @ v, abs=1e-14)


@pytest.mark.parametrize("kind", KINDS)
def test_small_strains_give_the_forces_of_the_small_bodies_but_for_their_square(kind):
    small, big = block(kind, which=lambda bodies, _: bodies), block(kind)
    noise = np.random.default_rng(2).normal(size=models.positions(small)[kind].shape)
    excess = []
    for size in (1e-5, 5e-6):
        for model in (small, big):
            place_at = models.positions(model)[kind]
            place_at[...] = size * noise * (1.0 if kind == "affine" else 0.05)
        linear = models.forces(small, models.positions(small)[kind].ravel().copy())
        square = inner_forces(big, kind).ravel()
        excess.append(np.abs(square - linear).max() / np.abs(linear).max())
    assert excess[0] < 30 * 1e-5
    assert excess[0] / excess[1] == pytest.approx(2.0, rel=1e-3)


def test_axes_that_are_x_y_z_may_be_left_out():
    forces = []
    for axes in (None, np.eye(3)[None].copy()):
        model = models.make(shapes.setup(shapes.stack([0.12]), ["affine"]))
        model.bodies = large(model.bodies._replace(affine=model.bodies.affine._replace(axes=axes)), np.zeros((0, 3)))
        model.bodies.affine.q[0, 3:] = GRADIENT.ravel()
        forces.append((inner_forces(model, "affine"), *observed(model, "affine")))
    for left_out, there in zip(*forces, strict=True):
        assert left_out == pytest.approx(there, rel=1e-13, abs=1e-13 * np.abs(there).max())
