"""The forces of patches on a deformed block: what the energy that they store says, wherever the whole is turned to."""

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.kinematics import deforming
from masonry.laboratory import laboratory
from masonry.patches.arrays import SHEAR
from masonry.patches.refreshing import refresh
from masonry.simd import FOUR
from tests.kinematics.bricks import turn
from tests.large.by_hand.patch_calls import press_deforming, stored_energy
from tests.large.made import dry, gather, hand_over, slab
from tests.large.test_deforming import on_a_slope
from tests.scenes import box

STRAINED = np.array([[1.0, 1e-3, 2e-3], [-2e-3, 0.999, 1e-3], [1e-3, 2e-3, 0.998]])
DOWN = 1e-5


def pressed(turned: np.ndarray):
    """A model of a strained block that lies in its slab, all of it turned about the origin; contacts are found."""
    model = assemble(on_a_slope()).model
    rigid, affine, _ = model.bodies
    frame, lowest = turned @ STRAINED, min((STRAINED @ (x, y, -0.05))[2] for x in (-0.1, 0.1) for y in (-0.1, 0.1))
    for body, kind, height in ((rigid, "rigid", -0.05), (affine, "affine", -lowest - DOWN)):
        centre = model.layout.centroid[model.layout.members[kind][0]]
        body.q[0, :3] = turned @ (0.0, 0.0, height) - centre
        body.v[...] = 0.0
    rigid.frame[0], affine.frame[0], affine.q[0, 3:] = turned, frame, (frame - np.eye(3)).ravel()
    gather(model)
    assert refresh(model.large.near) >= 0.0
    assert model.large.near.points.number[0] == 4
    return model


def pushes(model) -> np.ndarray:
    """(B, 4, 3): force, and first moments about the centroid."""
    press_deforming(model.large.near, 0.0)
    return model.large.near.motion.push.reshape(-1, 4, 3).copy()


def stored(model, kind: str, change) -> float:
    """J, after one block has been changed, and is put back."""
    body = getattr(model.bodies, kind)
    kept = body.q.copy(), body.frame.copy()
    change(body)
    gather(model)
    energy = stored_energy(model.large.near)
    body.q[...], body.frame[...] = kept
    gather(model)
    return energy


def derivative(model, kind: str, change, step: float) -> float:
    """Of the stored energy; change(body, step)."""
    ends = [stored(model, kind, lambda body, h=h: change(body, h)) for h in (step, -step)]
    return (ends[0] - ends[1]) / (2.0 * step)


def test_forces_and_first_moments_are_the_derivatives_of_the_energy_that_is_stored():
    model = pressed(turn(0, 0.7) @ turn(2, 0.4))
    rigid, affine = pushes(model)
    assert stored_energy(model.large.near) > 1e-4

    def shifted(axis):
        return lambda body, h: body.q.__setitem__((0, axis), body.q[0, axis] + h)

    def strained(i, j):
        def change(body, h):
            body.frame[0] = body.frame[0] + h * np.outer(np.eye(3)[i], np.eye(3)[j]) @ body.frame[0]

        return change

    def spun(axis):
        return lambda body, h: body.frame.__setitem__(0, turn(axis, h) @ body.frame[0])

    for axis in range(3):
        for kind, push in (("rigid", rigid), ("affine", affine)):
            assert derivative(model, kind, shifted(axis), 1e-7) == pytest.approx(-push[0, axis], rel=1e-6, abs=1e-3)
    scale = np.abs(affine[1:]).max()
    moments = np.array([[derivative(model, "affine", strained(i, j), 1e-6) for j in range(3)] for i in range(3)])
    assert moments == pytest.approx(-affine[1:], rel=0, abs=1e-6 * scale)
    couple = np.array([rigid[1 + k, j] - rigid[1 + j, k] for j, k in ((1, 2), (2, 0), (0, 1))])
    assert [derivative(model, "rigid", spun(axis), 1e-6) for axis in range(3)] == pytest.approx(
        -couple, rel=0, abs=1e-6 * scale
    )


def test_the_forces_leave_no_couple_and_both_bodies_are_given_theirs():
    model = pressed(turn(1, 0.3))
    near, (rigid, affine, _) = model.large.near, model.bodies
    for k in range(4):
        near.points.quads[k // FOUR, 0, SHEAR:, k % FOUR] = 1.0e5, 0.5e5, 0.2e5
    push = pushes(model)
    hand_over(model)
    place = near.motion.centre + near.motion.moved
    couple = [[m[1 + k, j] - m[1 + j, k] for j, k in ((1, 2), (2, 0), (0, 1))] for m in push]
    size = np.linalg.norm(couple[0])
    assert push[0, 0] == pytest.approx(-push[1, 0], rel=0, abs=1e-12 * np.linalg.norm(push[0, 0]))
    assert np.sum(couple + np.cross(place, push[:, 0]), axis=0) == pytest.approx(np.zeros(3), abs=1e-12 * size)
    assert rigid.patches[0] == pytest.approx([*push[0, 0], *couple[0]], rel=1e-14)
    assert affine.patches[0] == pytest.approx(push[1].ravel(), rel=1e-14)


def test_a_right_angle_turns_the_forces_and_stresses_of_a_strained_block_and_changes_nothing_else():
    quarter = turn(0, 0.5 * np.pi)
    one, other = pressed(np.eye(3)), pressed(quarter)
    for straight, turned in zip(pushes(one), pushes(other), strict=True):
        size = np.abs(straight).max()
        assert turned[0] == pytest.approx(quarter @ straight[0], rel=0, abs=1e-9 * size)
        assert turned[1:] == pytest.approx(quarter @ straight[1:] @ quarter.T, rel=0, abs=1e-9 * size)
    forces = []
    for model in (one, other):
        stress, full = np.zeros((1, 6)), np.zeros((3, 3))
        energy, least, longest = deforming.observe(model.bodies.affine, stress)
        for (i, j), value in zip(((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)), stress[0], strict=True):
            full[i, j] = full[j, i] = value
        forces.append((full, [energy, least, stored_energy(model.large.near)]))
    assert forces[1][0] == pytest.approx(
        quarter @ forces[0][0] @ quarter.T, rel=0, abs=1e-9 * np.abs(forces[0][0]).max()
    )
    assert forces[1][1] == pytest.approx(forces[0][1], rel=1e-9)


@pytest.mark.parametrize("kinematics", ["rigid", "affine"])
def test_a_block_that_is_held_but_for_its_drive_presses_what_is_held(kinematics):
    """kn times the way that the drive has gone, though neither of the two is free in anything."""
    block = box("block", (-0.1, -0.1, 0.0), (0.2, 0.2, 0.2), "units", 1)
    held = 'on = "slab"\nfix = "all"', 'on = "block"\nfix = ["x", "y", "rotation"]'
    elastic = {"young_modulus": "10 GPa", "poisson_ratio": 0.2, "density": "2000 kg/m^3"}
    down = '[drive]\non = "block"\ndirection = "-z"\ndisplacement = "0.02 mm"\nsteps = 2000\n'
    changes = {
        "kinematics": kinematics,
        "material.units": elastic,
        "solver.masses": "scaled",
        "solver.duration": None,
        "settle": None,
        "contact.unit_unit.normal_dashpot": None,
    }
    result = laboratory.run(dry([slab(), block], gravity=(0.0, 0.0, 0.0), more=down, supports=held, changes=changes))
    assert abs(result.history.rows["force"][-1]) == pytest.approx(10e9 * 2e-5 * 0.04, rel=1e-6)
