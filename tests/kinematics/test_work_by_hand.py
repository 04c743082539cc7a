"""Forces and motion belong together: forces do the work of their points, stiffness is the slope of the energy."""

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.configuration.energy import present
from masonry.kinematics import affine, tets
from masonry.kinematics.dispatch import move, update_positions
from tests.kinematics.bricks import turn
from tests.scenes import ELASTIC, MATERIAL, box, listed, load, specimen, tables

STILL = 1.0, 1.0, 0.0, 0.0
"""Clock of a step with all of the dead load."""
TURNED = 'mesh = "fan"\nturned = {about = "z", angle = "35 deg"}'


def three():
    """A rigid, an affine and a meshed box in a row, turned about z; rigid ones turn about axes along none of these."""
    boxes = [
        box("one", (0.0, 0.0, 0.0), (0.2, 0.1, 0.15), "units", 0),
        box("two", (0.2, 0.02, 0.01), (0.1, 0.07, 0.11), "bricks", 1),
        box("three", (0.3, 0.0, 0.0), (0.15, 0.1, 0.12), "meshed", 2),
        box("held", (-0.1, 0.0, 0.0), (0.1, 0.1, 0.1), "units", 3),
    ]
    kinds = '{default = "rigid", bricks = "affine", meshed = "tets"}'
    names = ("unit_unit", "bricks_units", "bricks_meshed")
    model = assemble(
        load(
            f"kinematics = {kinds}\n"
            + specimen(boxes, 0.01, more=TURNED)
            + tables("material", dict.fromkeys(("units", "bricks", "meshed"), MATERIAL))
            + tables("contact", dict.fromkeys(names, ELASTIC))
            + listed("support", ['on = "held"\nfix = "all"'])
            + '[drive]\non = "three"\ndirection = "z"\ndisplacement = "1 um"\nsteps = 10\n'
        )
    ).model
    askew = turn(0, 0.7) @ turn(1, 1.1) @ turn(2, -2.0)
    model.bodies.rigid.axes[...] = model.layout.axes[model.layout.members["rigid"]] = askew
    return model


def test_forces_at_contacts_do_on_each_kind_of_block_the_work_of_their_points():
    """Random velocities, random forces: sum of force times move of side a against side b is that of the dofs."""
    model, rng, dt = three(), np.random.default_rng(3), 1e-3
    u, force = model.contacts.u, model.contacts.force
    force[:, :3] = rng.normal(size=(len(model.group), 3))
    speeds = {}
    for kind, body in present(model):
        body.v[...] = rng.normal(size=body.v.shape)
        speeds[kind] = body.v.copy()
        update_positions(None, body, dt, u)
    a, b = model.contacts.sides.T.astype(int)
    for kind, body in present(model):
        move(None, body, dt, None, STILL, force, u)
        which = model.layout.members[kind]
        one, two = (np.isin(block, which) for block in (model.joints.block_a, model.joints.block_b))
        work = np.sum(force[one] * u[a[one]]) - np.sum(force[two] * u[b[two]])
        assert np.sum(body.contact * speeds[kind]) * dt == pytest.approx(work, rel=1e-9), kind
        assert abs(work) > 1e-6


def test_points_of_a_block_move_with_it():
    """Of a rigid and an affine block: by the shift, the turn and the strain of their own axes."""
    model, rng = three(), np.random.default_rng(4)
    layout = model.layout
    a = model.contacts.sides[:, 0].astype(int)
    for kind, body in list(present(model))[:2]:
        body.v[...] = 1e-3 * rng.normal(size=body.v.shape)
        update_positions(None, body, 1.0, model.contacts.u)
        for row, block in enumerate(layout.members[kind]):
            axes, mine = layout.axes[block], model.joints.block_a == block
            arm = model.joints.point[mine] - layout.centroid[block]
            if kind == "rigid":
                moved = body.q[row, :3] + np.cross(axes @ body.q[row, 3:], arm)
            else:
                moved = body.q[row, :3] + arm @ (body.q[row, 3:].reshape(3, 3) @ axes.T).T
            assert model.contacts.u[a[mine]] == pytest.approx(moved, abs=1e-15)


def slope(energy, place: np.ndarray, step: float) -> np.ndarray:
    """The derivative of an energy with regard to an array of dofs, by differences."""
    values = np.zeros(place.shape)
    for at in np.ndindex(place.shape):
        was = place[at]
        place[at] = was + step
        more = energy()
        place[at] = was - step
        values[at] = (more - energy()) / (2.0 * step)
        place[at] = was
    return values


def test_the_stiffness_of_an_affine_block_is_the_slope_of_its_energy_and_its_stress_that_of_hooke():
    model, rng = three(), np.random.default_rng(5)
    body = model.bodies.affine
    body.q[...] = 1e-4 * rng.normal(size=body.q.shape)
    stress = np.zeros((1, 6))
    wanted = -slope(lambda: affine.observe(body, np.zeros((1, 6))), body.q, 1e-6)
    affine.observe(body, stress)
    model.contacts.force[...] = 0.0
    move(None, body, 1e-7, None, STILL, model.contacts.force, model.contacts.u)
    assert body.v / body.dt_over_mass == pytest.approx(wanted, rel=1e-6, abs=1e-6 * np.abs(wanted).max())
    block = model.layout.members["affine"][0]
    h = body.q[0, 3:].reshape(3, 3) @ model.layout.axes[block].T
    strain = 0.5 * (h + h.T)
    lame, mu = 5e9 * 0.2 / (1.2 * 0.6), 5e9 / 2.4
    full = lame * np.trace(strain) * np.eye(3) + 2.0 * mu * strain
    volume = model.layout.volume[block]
    assert stress[0] / volume == pytest.approx(full[[0, 1, 2, 1, 0, 0], [0, 1, 2, 2, 2, 1]], rel=1e-9)


def test_the_stiffness_of_tets_is_the_slope_of_their_energy():
    model, rng = three(), np.random.default_rng(6)
    body, u = model.bodies.tets, model.contacts.u
    count = len(body.v)
    u[:count, :3] = 1e-5 * rng.normal(size=(count, 3))
    stress = np.zeros((1, 6))
    wanted = -slope(lambda: tets.observe(body, u, stress), u[:count, :3], 1e-7)
    model.contacts.force[...] = 0.0
    move(None, body, 1e-9, None, STILL, model.contacts.force, u)
    free = body.dt_over_mass > 0.0
    force = np.divide(body.v, body.dt_over_mass, out=np.zeros_like(body.v), where=free)
    assert force[free] == pytest.approx(wanted[free], rel=1e-5, abs=1e-6 * np.abs(wanted).max())
    assert wanted.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-6 * np.abs(wanted).max()), "no force on the whole"


def test_the_mean_turn_of_a_mesh_is_that_of_its_nodes_whatever_its_strain():
    model, rng = three(), np.random.default_rng(7)
    body, u, nodes = model.bodies.tets, model.contacts.u, model.layout.mesh.nodes
    spin, strain = np.array([1e-3, -2e-3, 4e-3]), 1e-2 * rng.normal(size=(3, 3))
    u[: len(nodes), :3] = np.cross(spin, nodes) + nodes @ (strain + strain.T) + [0.1, 0.2, 0.3]
    values = np.zeros((1, 3))
    tets.mean_rotation(body, u, values)
    assert values[0] == pytest.approx(spin, abs=1e-12)
