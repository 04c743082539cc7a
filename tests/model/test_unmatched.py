"""Blocks of tets whose surfaces do not match: contact points between nodes pass stress, momentum and energy."""

from dataclasses import replace

import numpy as np
import pytest

from geometry.joints.find import find_joints
from geometry.meshes.fan_tets import gathered
from geometry.meshes.nonmatching import surface_joints
from geometry.meshes.tetrahedralise import mesh_blocks
from masonry.configuration import energy
from masonry.configuration.chunk import Chunk
from masonry.configuration.configuration import configuration_of
from masonry.configuration.energy import present
from masonry.model.layout import KINDS, Material
from masonry.model.model import Stepping, sort_by_group
from tests.model.eigen import true_limit
from verification.checks import invariance
from verification.fixtures import models, shapes

KN, KS = 2e11, 8e10
SOFT = Material(density=1900.0, young_modulus=5e9, poisson_ratio=0.0)


def apart(blocks, kinds, sizes):
    """A set-up of blocks that are meshed one by one, each with a size of its own."""
    count = blocks.count
    blocks = replace(blocks, unit=np.arange(count), group=np.zeros(count, dtype=np.int64), groups=("units",))
    far = find_joints(shapes.boxes([((9, 9, 9), (10, 10, 10))]))
    parts = {
        b: (mesh_blocks(blocks, np.arange(count) == b, sizes[b], far)[0], b) for b in range(count) if kinds[b] == "tets"
    }
    mesh = gathered(count, parts)
    joints = surface_joints(blocks, find_joints(blocks), mesh)
    assert joints.corner_a is not None
    kind = np.array([KINDS.index(k) for k in kinds])
    return shapes.Setup(blocks, kind, sort_by_group(blocks, joints)[2], mesh)


PAIRS = [("tets", "tets"), ("rigid", "tets"), ("tets", "affine")]


@pytest.fixture(params=PAIRS, ids="-".join)
def pair(request):
    upper = ((0.02, -0.01, 0.05), (0.15, 0.09, 0.12))
    blocks = shapes.boxes([((0, 0, 0), (0.2, 0.1, 0.05)), upper])
    return apart(blocks, request.param, (0.05, 0.037))


def linear(model, gradient, jump):
    """Dofs under a uniform strain, the last block shifted by jump."""
    field = {kind: np.zeros_like(body.v) for kind, body in present(model)}
    whole = models.linear_field(model, np.zeros(3), gradient)
    shifted = models.linear_field(model, np.asarray(jump, dtype=float), gradient)
    first = 0
    for kind, values in field.items():
        one, two = (part[first : first + values.size].reshape(values.shape) for part in (whole, shifted))
        if kind == "tets":
            upper = np.arange(len(values)) >= model.layout.mesh.node_start[-2]
        else:
            upper = model.layout.members[kind] == model.blocks.count - 1
        values[:] = np.where(upper[:, None], two, one)
        first += values.size
    return models.gather(field)


def test_a_uniform_stress_passes_without_a_force_on_any_node_of_the_interface():
    blocks = shapes.boxes([((0, 0, 0), (0.2, 0.1, 0.05)), ((0, 0, 0.05), (0.2, 0.1, 0.12))])
    s = apart(blocks, ("tets", "tets"), (0.05, 0.037))
    model = models.make(s)
    sigma, modulus, nu = 1e6, models.STONE.young_modulus, models.STONE.poisson_ratio
    strain = sigma / modulus
    force = models.forces(model, linear(model, np.diag([-nu * strain, -nu * strain, strain]), [0, 0, sigma / KN]))
    nodes = s.mesh.nodes
    ends = (np.abs(nodes[:, 2]) < 1e-12) | (np.abs(nodes[:, 2] - 0.12) < 1e-12)
    scale = np.abs(force.reshape(-1, 3)[ends]).max()
    assert scale > 100
    assert np.abs(force.reshape(-1, 3)[~ends]).max() < 1e-9 * scale


@pytest.mark.parametrize("jump", [[0.0, 0.0, 1e-6], [2e-6, -1e-6, 0.0]], ids=["opening", "slip"])
def test_a_uniform_stress_passes_to_rigid_blocks_whose_edge_cuts_triangles(jump):
    below = [((-0.05, -0.05, 0), (0.083, 0.2, 0.05)), ((0.083, -0.05, 0), (0.3, 0.2, 0.05))]
    blocks = shapes.boxes([*below, ((0, 0, 0.05), (0.2, 0.1, 0.12))])
    s = apart(blocks, ("rigid", "rigid", "tets"), (0.05, 0.05, 0.04))
    model = models.make(s, material=SOFT)
    traction = np.array([KS, KS, KN]) * jump
    gradient = np.zeros((3, 3))
    gradient[:, 2] = traction / np.array([SOFT.young_modulus / 2] * 2 + [SOFT.young_modulus])
    shift = np.asarray(jump) - gradient @ [0, 0, 0.05]
    field = linear(model, gradient, shift)
    field[:12] = 0.0
    force = models.forces(model, field)[12:].reshape(-1, 3)
    nodes = s.mesh.nodes
    side = (np.abs(nodes[:, :2] - [0.1, 0.05]) > np.array([0.1, 0.05]) - 1e-12).any(axis=1)
    level = np.abs(nodes[:, 2] - 0.05) < 1e-12
    on = level & ~side if jump[0] else level
    assert on.sum() > 4
    assert np.abs(force[on]).max() < 1e-9 * np.linalg.norm(traction) * 0.02


def test_contact_forces_add_up_to_nothing_and_turn_nothing(pair):
    model = models.make(pair, stepping=Stepping("real", damping=0.0))
    rng = np.random.default_rng(2)
    models.put(model, models.positions(model), 1e-6 * rng.normal(size=len(models.free(model))))
    models.march(model, 1, 0.0)
    total = invariance.contact_forces(model)
    most = np.abs(model.contacts.force).sum()
    assert np.abs(total).max() < 1e-12 * most


def test_momentum_is_kept_over_many_steps(pair):
    model = models.make(pair, stepping=Stepping("real", damping=0.0))
    for kind, body in present(model):
        body.v[:] = np.random.default_rng(6).normal(size=body.v.shape) * 1e-3
        if kind == "rigid":
            body.v[:, 3:] *= 10.0
    first = invariance.momentum(model)
    models.march(model, 500, 0.0)
    assert np.abs(invariance.momentum(model) - first).max() < 1e-11 * np.abs(first).max()


def test_a_rigid_motion_makes_no_force(pair):
    model = models.make(pair)
    spin = np.array([[0, -3e-4, 2e-4], [3e-4, 0, -1e-4], [-2e-4, 1e-4, 0]])
    moved = models.forces(model, models.linear_field(model, np.array([1e-3, -2e-3, 3e-3]), spin))
    stretched = models.forces(model, models.linear_field(model, np.zeros(3), np.diag([3e-4, 2e-4, 1e-4])))
    assert np.abs(moved).max() < 1e-10 * np.abs(stretched).max()


def test_the_stiffness_is_symmetric_and_holds_every_relative_motion(pair):
    model = models.make(pair)
    matrix = models.stiffness_matrix(model)
    assert np.abs(matrix - matrix.T).max() < 1e-10 * np.abs(matrix).max()
    size = np.sqrt(np.diag(matrix))
    values = np.linalg.eigvalsh(matrix / np.outer(size, size))
    assert np.sum(np.abs(values) < 1e-10 * values[-1]) == 6


@pytest.mark.parametrize("masses", ["real", "scaled"])
@pytest.mark.parametrize("ratio", [1e-3, 1.0, 1e3])
def test_the_bound_is_never_above_the_true_limit(pair, masses, ratio):
    law = models.GLUE[0], models.GLUE[1]._replace(normal_stiffness=ratio * KN, shear_stiffness=ratio * KS)
    model = models.make(pair, law, Stepping(masses, damping=0.8))
    share = model.bound / true_limit(model)
    assert share <= 1.0 + 1e-9
    assert share >= {"real": 0.04, "scaled": 0.4}[masses]


@pytest.mark.parametrize("damping", [0.0, 0.8])
def test_the_energy_balance_closes(pair, damping):
    model = models.make(
        pair, stepping=Stepping("real", damping=damping), holds=[models.everything(0)], gravity=(1.0, 0.0, -9.81)
    )
    models.march(model, 300)
    before = energy.velocities(model)
    models.march(model, 1)
    terms = energy.ledger(model, energy.observe(model), before)
    assert abs(terms["external_work"]) > 0
    assert abs(terms["imbalance"]) < 1e-12 * abs(terms["external_work"])
    assert terms["elastic_contacts"] == pytest.approx(terms["contact_work"], rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("pair", PAIRS, indirect=True, ids="-".join)
def test_two_threads_take_the_same_steps(pair):
    found = []
    for threads in (1, 2):
        model = models.make(pair, gravity=(1.0, 0.0, -9.81))
        chunk = Chunk(np.full(51, 1.0), np.zeros(51), False)
        configuration_of(model).advance(chunk, threads, 0, 50, np.zeros(50))
        found.append(model.contacts.u.copy())
    assert np.array_equal(*found)
