"""Which bonds go, and what they hand over: by hand, on models that do not run."""

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.configuration import retirement
from masonry.elements.joints.joint_crushing import crushing_of_joints
from masonry.patches.arrays import PLACE, SHEAR
from masonry.patches.crushed_points import CLOSING
from masonry.simd import FOUR
from tests.kinematics.bricks import turn
from tests.large.by_hand.patch_calls import stored_energy
from tests.large.made import dry, slab
from tests.scenes import box

KN, KS, SIDE = 10e9, 5e9, 0.1
GLUE = 'law = "linear"\ntensile_strength = "0.1 MPa"\ncohesion = "0.2 MPa"\nresidual_cohesion = "0 Pa"\n'
GLUE += 'fracture_energy_mode_1 = "10 N/m"\nfracture_energy_mode_2 = "20 N/m"\n'


def glued(joint: str = GLUE):
    """A cube of 0.1 m that is glued to a slab."""
    block = box("block", (-0.5 * SIDE, -0.5 * SIDE, 0.0), (SIDE, SIDE, SIDE), "units", 1)
    return assemble(dry([slab(1.0), block], joint=joint, turned="points_per_edge = 2")).model


@pytest.mark.parametrize(("left", "broken"), [(0.99e-3, True), (1.01e-3, False)])
@pytest.mark.parametrize("strength", ["intact_n", "intact_s"])
def test_a_bond_is_broken_where_neither_strength_has_a_thousandth_left(left, broken, strength):
    model = glued(GLUE + 'coupling = "independent"\n')
    model.state.intact_n[:] = model.state.intact_s[:] = 0.0
    getattr(model.state, strength)[:] = 1.0, left, 0.5, 0.0
    assert retirement._broken(model, model.large).tolist() == [False, broken, False, True]


@pytest.mark.parametrize(("left", "broken"), [(0.99, True), (1.01, False)])
def test_where_both_strengths_are_lost_together_their_product_counts(left, broken):
    model = glued()
    model.state.intact_n[:], model.state.intact_s[:] = 0.05, (left * 0.02, 1.0, 0.0, 0.02)
    assert retirement._broken(model, model.large).tolist() == [broken, False, True, False]


@pytest.mark.parametrize(("angle", "hinges"), [(0.099, False), (0.101, True)])
@pytest.mark.parametrize("axis", [0, 2])
def test_what_still_presses_goes_where_its_blocks_turned_by_a_tenth_of_a_radian(angle, hinges, axis):
    model = glued()
    model.large.bonds.frames[1] = turn(axis, angle)
    opening = np.array([-1e-6, 1e-6, 0.0, -1e-6])
    model.large.parted[...] = opening[:, None] * model.contacts.normal
    assert retirement._hinges(model, model.large).tolist() == [hinges, False, hinges, hinges]


def pressed(model, normal: float, shear: float) -> np.ndarray:
    """Contacts bear so much (Pa) in the frame of their block; returns the force on the slab."""
    area, n = model.contacts.area, model.contacts.normal
    along = np.cross(n, [0.0, 1.0, 0.0])
    model.contacts.force[...] = area[:, None] * (normal * n + shear * along)
    model.large.bonds.force[...] = model.contacts.force
    return model.contacts.force.sum(axis=0)


def test_bonds_carry_the_energies_of_their_pressure_and_shear():
    """s^2 / (2 k_n) and t^2 / (2 k_s) on 0.01 m2; tension is nothing that goes over."""
    model = glued()
    key, four = np.zeros(4, dtype=int), np.arange(4)
    whole = pressed(model, -2e5, 1e5)
    carried = retirement._carried(model, model.large, crushing_of_joints(model, model.large), key, four)[0]
    assert carried.force == pytest.approx(whole)
    assert carried.pressed == pytest.approx(0.01 * 4e10 / (2.0 * KN))
    assert carried.sheared == pytest.approx(0.01 * 1e10 / (2.0 * KS))
    pressed(model, 2e5, 1e5)
    assert retirement._carried(model, model.large, crushing_of_joints(model, model.large), key, four)[0].pressed == 0.0
    area = model.contacts.area.copy()
    model.contacts.force[0] *= 2.0
    twice = retirement._carried(
        model, model.large, crushing_of_joints(model, model.large), np.array([7, 8, 8, 8]), four
    )
    assert (
        twice[7].sheared
        == pytest.approx(4.0 * area[0] * 1e10 / (2.0 * KS))
        == pytest.approx(4.0 / 3.0 * twice[8].sheared)
    )


@pytest.mark.parametrize("sunk", [2e-5, 1e-6])
@pytest.mark.parametrize("shear", [5e4, -2e4])
def test_patches_take_over_the_pressure_and_the_shear_of_bonds_that_go(sunk, shear):
    """Bonds press by 0.2 MPa, which is 20 um of their springs, however deep the blocks stand in each other."""
    model = glued()
    model.bodies.rigid.q[1, 2] = -sunk
    model.large.near.motion.travel[1] += sunk
    model.large.parted[...] = -2e-5 * model.contacts.normal
    force = pressed(model, -2e5, shear)
    model.state.intact_n[:] = model.state.intact_s[:] = 0.0
    retirement.retire(model, model.large, crushing_of_joints(model, model.large))
    near, bonds = model.large.near, model.large.bonds
    assert not bonds.alive.any() and not model.contacts.area.any() and not bonds.force.any()
    springs = 0.01 * 4e10 / (2.0 * KN) + 0.01 * shear**2 / (2.0 * KS)
    assert stored_energy(near) == pytest.approx(springs, rel=1e-9)
    p = int(np.flatnonzero(near.pairs.slot[: near.pairs.number[0]] >= 0)[0])
    assert retirement.pressures_of(near, p) == pytest.approx(np.full(4, 2e5), rel=1e-9)
    s = near.pairs.slot[p]
    k = np.arange(4)
    tractions = near.points.quads[k // FOUR, s, SHEAR:, k % FOUR]
    assert retirement.areas_of(near, p).sum() == pytest.approx(0.01)
    on_the_slab = 1.0 if near.pairs.body[p, 1 - near.pairs.points_of[p]] == 0 else -1.0
    total = on_the_slab * (retirement.areas_of(near, p) @ tractions)
    assert total == pytest.approx([force[0], force[1], 0.0], abs=1e-6 * abs(force[2]))


def test_patches_take_over_how_far_bonds_were_crushed_from_the_nearest_of_them():
    """One half of the joint is crushed by 30 um, the other by 10 um; the block is sunk by 40 um. Energy stays."""
    model = glued(GLUE + 'compressive_strength = "5 MPa"\ncrushing = "cut-off"\n')
    near, normal = model.large.near, model.contacts.normal
    closing = np.where(model.joints.point[:, 0] > 0.0, 3e-5, 1e-5)
    model.state.crushed[:, 0] = model.state.crushed[:, 1] = closing
    model.bodies.rigid.q[1, 2] = -4e-5
    near.motion.travel[1] += 4e-5
    model.large.parted[...] = -4e-5 * normal
    pressed(model, 0.0, 0.0)
    model.contacts.force[...] = KN * (model.contacts.area * (closing - 4e-5))[:, None] * normal
    springs = float(model.contacts.area @ (KN * (4e-5 - closing) ** 2) / 2.0)
    model.state.intact_n[:] = model.state.intact_s[:] = 0.0
    retirement.retire(model, model.large, crushing_of_joints(model, model.large))
    p = int(np.flatnonzero(near.pairs.slot[: near.pairs.number[0]] >= 0)[0])
    s, own = near.pairs.slot[p], near.pairs.points_of[p]
    k = np.arange(near.points.number[s])
    x = near.motion.centre[near.pairs.body[p, own], 0] + near.points.quads[k // FOUR, s, PLACE, k % FOUR]
    handed_over = near.points.crushed[s, k // FOUR, CLOSING, k % FOUR]
    assert handed_over == pytest.approx(np.where(x > 0.0, 3e-5, 1e-5), rel=1e-12)
    assert stored_energy(near) == pytest.approx(springs, rel=1e-9)
    assert near.pairs.slack[p] == pytest.approx(0.0, abs=1e-9), "the gaps and the closings say it all"


def test_shear_that_follows_an_uneven_pressure_holds_no_more_energy_than_the_bonds_did():
    """The block leans by 1e-4, so that its patch presses from 0.15 to 0.25 MPa."""
    model = glued()
    model.bodies.rigid.q[1, 2], model.bodies.rigid.frame[1] = -2e-5, turn(1, 1e-4)
    model.large.near.motion.travel[1] += 1e-4
    model.large.parted[...] = -2e-5 * model.contacts.normal
    force = pressed(model, -2e5, 5e4)
    model.state.intact_n[:] = model.state.intact_s[:] = 0.0
    retirement.retire(model, model.large, crushing_of_joints(model, model.large))
    near = model.large.near
    p = int(np.flatnonzero(near.pairs.slot[: near.pairs.number[0]] >= 0)[0])
    pressures, areas = retirement.pressures_of(near, p), retirement.areas_of(near, p)
    assert pressures.max() > 1.3 * pressures.min()
    assert float(areas @ pressures**2) / (2.0 * KN) == pytest.approx(0.01 * 4e10 / (2.0 * KN), rel=1e-9)
    k = np.arange(4)
    tractions = near.points.quads[k // FOUR, near.pairs.slot[p], SHEAR:, k % FOUR]
    assert float(areas @ np.sum(tractions**2, axis=1)) == pytest.approx(0.01 * 5e4**2, rel=1e-9)
    assert np.linalg.norm(tractions, axis=1) / pressures == pytest.approx(np.full(4, 0.25), rel=0.1)
    assert np.abs(areas @ tractions)[0] < abs(force[0]), "so it is a little less force"
