"""Single bodies with known answers: free fall, oscillation, turning, bars; masses and stiffness are the real ones."""

import numpy as np
import pytest
from scipy.linalg import eigh

from geometry.blocks import Blocks
from masonry.configuration.energy import present
from masonry.model.layout import Material
from masonry.model.loads import Push
from masonry.model.model import Stepping
from masonry.model.supports import Hold
from tests.model.eigen import frequencies
from verification.fixtures import models, shapes

KN, KS = models.GLUE[1].normal_stiffness, models.GLUE[1].shear_stiffness
KINDS = ("rigid", "affine", "tets")
SHEAR = np.array([[1.0, 0.3, 0.2], [0.1, 1.0, -0.2], [0.0, 0.0, 0.9]])


def oscillator(damping: float, fraction: float):
    """A rigid block on a held one that can only rise and fall: mass m on a spring kn A."""
    s = shapes.setup(shapes.stack([0.05, 0.07]), ["rigid", "rigid"])
    holds = [models.everything(0), Hold(np.array([1]), (0, 1), rotations=(0, 1, 2))]
    mass, spring = 1900 * 0.2 * 0.1 * 0.07, KN * 0.2 * 0.1
    omega = np.sqrt(spring / mass)
    model = models.make(s, models.GLUE, Stepping("real", 2 * fraction / omega, damping=damping), holds)
    return model, omega


def path_of(model, steps: int) -> np.ndarray:
    """Height of the moving block after each step."""
    q = model.bodies.rigid.q
    path = np.empty(steps)
    for k in range(steps):
        models.march(model, 1)
        path[k] = q[1, 2]
    return path


def peaks(path: np.ndarray, dt: float) -> tuple[np.ndarray, np.ndarray]:
    """Times and heights of the turning points, by the parabola through three steps."""
    a, b, c = path[:-2], path[1:-1], path[2:]
    k = np.flatnonzero((b - a) * (c - b) < 0)
    bend, slope = (a - 2 * b + c)[k], (c - a)[k] / 2
    return (k + 2 - slope / bend) * dt, b[k] - slope**2 / (2 * bend)


def test_a_block_on_a_contact_swings_with_the_period_of_its_mass_and_spring():
    model, omega = oscillator(0.0, 0.002)
    model.bodies.rigid.v[1, 2] = 1e-3
    when, height = peaks(path_of(model, 8000), model.dt)
    assert np.diff(when) == pytest.approx(np.pi / omega, rel=1e-5)
    assert np.abs(height) == pytest.approx(1e-3 / omega, rel=1e-5)


@pytest.mark.parametrize("fraction", [0.1, 0.5, 0.9])
def test_the_leapfrog_shortens_the_period_exactly_as_its_theory_says(fraction):
    """sin(w' dt/2) = w dt/2: at any step up to the limit 2/w."""
    model, omega = oscillator(0.0, fraction)
    model.bodies.rigid.v[1, 2] = 1e-3
    path = path_of(model, 400)
    phase = 2 * np.arcsin(omega * model.dt / 2)
    exact = np.sin(phase * np.arange(1, 401)) * path[0] / np.sin(phase)
    assert np.abs(path - exact).max() < 1e-10 * np.abs(path).max()


@pytest.mark.parametrize("xi", [0.3, 0.8])
def test_local_damping_shrinks_and_times_each_half_swing_as_the_closed_form_says(xi):
    """The force jumps by (1 + xi)/(1 - xi) at a turning point, so its time is sharp to some steps only."""
    model, omega = oscillator(xi, 2.5e-4)
    model.bodies.rigid.v[1, 2] = 1e-3
    when, height = peaks(path_of(model, 32000), model.dt)
    assert np.abs(height[1:] / height[:-1]) == pytest.approx(np.sqrt((1 - xi) / (1 + xi)), rel=1e-4)
    half = np.pi / (2 * omega) * (1 / np.sqrt(1 - xi) + 1 / np.sqrt(1 + xi))
    assert np.diff(when) == pytest.approx(half, rel=2e-3)
    assert len(when) >= 4


@pytest.mark.parametrize("kind", KINDS)
def test_a_damped_body_falls_with_its_share_of_gravity_and_without_strain(kind):
    xi, g, steps = 0.8, 9.81, 500
    s = shapes.setup(shapes.stack([0.1, 0.1]), [kind, kind], mesh_size=0.08)
    model = models.make(s, models.GLUE, Stepping("real", 1e-6, damping=xi), gravity=(0.0, 0.0, -g))
    models.march(model, steps)
    speed = g * model.dt * (1 + (1 - xi) * (steps - 1))  # the first step starts from rest, where sign(v) = 0
    for _, body in present(model):
        assert body.v[:, 2] == pytest.approx(-speed, rel=1e-12)
        assert np.abs(np.delete(body.v, 2, axis=1)).max() < 1e-12 * speed


def parallelepiped_inertia(edges: np.ndarray, density: float) -> tuple[float, np.ndarray]:
    """Mass and inertia tensor of the block with these edges (columns): the image of a unit cube."""
    volume = abs(np.linalg.det(edges))
    second = volume * edges @ (np.eye(3) / 12) @ edges.T
    return density * volume, density * (np.trace(second) * np.eye(3) - second)


def skew_block_on_a_held_one() -> tuple[Blocks, np.ndarray]:
    size = np.array([0.2, 0.1, 0.07])
    return shapes.skewed(shapes.stack([0.05, 0.07]), SHEAR), SHEAR @ np.diag(size)


def test_a_skewed_rigid_block_swings_and_turns_with_its_real_inertia():
    """All six frequencies against a mass matrix in global axes that knows no principal ones."""
    blocks, edges = skew_block_on_a_held_one()
    model = models.make(shapes.setup(blocks, ["rigid", "rigid"]), holds=[models.everything(0)])
    mass, inertia = parallelepiped_inertia(edges, 1900.0)
    centre = SHEAR @ [0.1, 0.05, 0.05 + 0.035]
    stiffness = np.zeros((6, 6))
    joints = model.joints
    for point, normal, area in zip(joints.point, joints.normal, joints.area, strict=True):
        arm = point - centre
        motion = np.hstack([np.eye(3), np.cross(np.eye(3), arm)])  # row i: u_i = t_i + (theta x arm)_i
        spring = area * (KS * np.eye(3) + (KN - KS) * np.outer(normal, normal))
        stiffness += motion.T @ spring @ motion
    matrix = np.zeros((6, 6))
    matrix[:3, :3], matrix[3:, 3:] = mass * np.eye(3), inertia
    exact = np.sqrt(eigh(stiffness, matrix, eigvals_only=True))
    assert frequencies(model) == pytest.approx(exact, rel=1e-10)
    off = inertia - np.diag(np.diag(inertia))
    assert np.abs(off).max() > 0.02 * inertia.max(), "its principal axes do not lie along x, y, z"


def test_a_skewed_block_released_in_its_lowest_mode_swings_in_time_at_that_frequency():
    blocks, _ = skew_block_on_a_held_one()
    model = models.make(shapes.setup(blocks, ["rigid", "rigid"]), holds=[models.everything(0)])
    omega = frequencies(model)[0]
    which, mass = models.free(model), models.mass_vector(model)
    stiffness = models.stiffness_matrix(model)[np.ix_(which, which)]
    mode = eigh(stiffness, np.diag(mass[which]))[1][:, 0]
    velocity = np.zeros(len(which))
    velocity[which] = 1e-3 * mode
    models.put(model, {"rigid": model.bodies.rigid.v}, velocity)
    path = []
    for _ in range(400):
        models.march(model, 1)
        path.append(model.bodies.rigid.q.ravel()[which] @ np.diag(mass[which]) @ mode)
    phase = 2 * np.arcsin(omega * model.dt / 2)
    exact = np.sin(phase * np.arange(1, 401)) * path[0] / np.sin(phase)
    assert np.abs(path - exact).max() < 1e-9 * np.abs(path).max()


def hooke(gradient: np.ndarray, material: Material) -> np.ndarray:
    """Stress tensor of an isotropic solid, from E and nu."""
    E, nu = material.young_modulus or 0.0, material.poisson_ratio or 0.0
    strain = 0.5 * (gradient + gradient.T)
    return E / (1 + nu) * (strain + nu / (1 - 2 * nu) * np.trace(strain) * np.eye(3))


@pytest.mark.parametrize("turned", [False, True], ids=["upright", "skewed"])
@pytest.mark.parametrize("kind", ["affine", "tets"])
@pytest.mark.parametrize("i, k", [(0, 0), (2, 2), (0, 2), (1, 0)])
def test_one_block_resists_stretch_and_shear_as_hooke_says(kind, turned, i, k):
    """Forces f on the dofs q of a uniform field do the work -sigma : gradient V for any other uniform field."""
    blocks = shapes.stack([0.07])
    if turned:
        blocks = shapes.skewed(blocks, SHEAR)
    s = shapes.setup(blocks, [kind], mesh_size=0.05)
    model = models.make(s, stepping=Stepping("real", 1e-7, damping=0.0))
    gradient = np.zeros((3, 3))
    gradient[i, k] = 1e-4
    force = models.forces(model, models.linear_field(model, np.zeros(3), gradient))
    stress, volume = hooke(gradient, models.STONE), model.layout.volume[0]
    for other in np.random.default_rng(4).normal(size=(3, 3, 3)):
        work = force @ models.linear_field(model, np.zeros(3), other)
        assert work == pytest.approx(-volume * np.sum(stress * other), rel=1e-9)


@pytest.mark.parametrize("kind", ["affine", "tets"])
def test_one_block_between_plates_stretches_by_its_own_and_its_contacts_compliance(kind):
    """Without Poisson's effect: L/E + 2/kn for a unit stress."""
    material = Material(1900.0, 5e9, 0.0)
    s = shapes.setup(shapes.stack([0.03, 0.2, 0.03]), ["rigid", kind, "rigid"], mesh_size=0.1)
    top = s.blocks.block_face_start[2] + 5
    push = Push(np.array([top]), np.array([0.0, 0.0, 0.5e6]))
    model = models.make(s, models.GLUE, Stepping(damping=0.8), [models.everything(0)], [push], material=material)
    models.march(model, 12000)
    assert model.bodies.rigid.q[1, 2] == pytest.approx(0.5e6 * (0.2 / 5e9 + 2 / KN), rel=1e-9)


def test_a_bar_of_tets_sings_at_its_first_frequency_and_converges_with_the_mesh():
    """Held at one end, guided along its length: f1 = c/(4 L), c of plane waves; second order in the mesh size."""
    length, size = 1.0, 0.25
    lame, mu = models.STONE.lame()
    exact = np.pi / (2 * length) * np.sqrt((lame + 2 * mu) / models.STONE.density)
    errors = []
    for mesh_size in (0.25, 0.125, 0.0833):
        s = shapes.setup(shapes.stack([0.1, length], (size, size)), ["rigid", "tets"], mesh_size)
        stiff = (models.GLUE[0], models.GLUE[1]._replace(normal_stiffness=1e15, shear_stiffness=1e15))
        model = models.make(s, stiff, models.REAL, [models.everything(0), Hold(np.array([1]), (0, 1))])
        errors.append(frequencies(model)[0] / exact - 1)
    assert np.abs(errors[-1]) < 0.01
    assert np.abs(errors[0]) > 4 * np.abs(errors[-1])
    print("bar of tets, error of the first frequency:", errors)
