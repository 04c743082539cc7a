"""What the points of a patch bear in one step, in force, moment and energy: a cube on a slab, by hand."""

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.configuration.joint_forces import BearingPoints
from masonry.patches.arrays import BORN, DASHPOT, FRICTION, NORMAL_GAINED, SHEAR_LOST
from masonry.patches.refreshing import refresh
from tests.kinematics.bricks import turn
from tests.large.by_hand.patch_calls import press, stored_energy
from tests.large.made import DENSITY, dry, slab
from tests.scenes import box

KN, KS, TAN, SIDE, DEEP, DT = 10e9, 5e9, 0.6, 0.1, 1e-5, 1e-7
AREA, PRESSURE = SIDE**2, KN * DEEP
ASKEW = turn(0, 0.7) @ turn(2, -2.0) @ turn(1, 1.1)
EVERY_WAY = pytest.mark.parametrize("way", [np.eye(3), ASKEW], ids=["straight", "askew"])
"""All of it as it is, and turned so that no axis is another's."""


def standing(where=(0.0, 0.0), way=np.eye(3)):  # noqa: B008
    """A cube of 0.1 m, pressed by 10 um into a slab whose centroid is at (0, 0, -0.05), then both turned as one."""
    low = where[0] - 0.5 * SIDE, where[1] - 0.5 * SIDE, 0.0
    model = assemble(dry([slab(1.0), box("block", low, (SIDE, SIDE, SIDE), "units", 1)])).model
    rigid = model.bodies.rigid
    rigid.q[1, 2] = -DEEP
    model.large.near.motion.travel[1] += DEEP
    assert refresh(model.large.near) >= 0.0
    for b in (0, 1):
        place = model.layout.centroid[b] + rigid.q[b, :3]
        rigid.q[b, :3] += way @ place - place
        rigid.frame[b] = way
    return model


def pushed(model, velocity=(0.0, 0.0, 0.0), spin=(0.0, 0.0, 0.0), of_slab=(0.0,) * 6) -> np.ndarray:
    """(2, 6) forces and moments on both after a step with these velocities of the block, as seen from the slab."""
    near = model.large.near
    both = np.kron(np.eye(2), model.bodies.rigid.frame[0])
    near.motion.v[1, :6], near.motion.v[0, :6] = both @ (*velocity, *spin), both @ of_slab
    press(near, DT)
    return near.motion.push[:2, :6] @ both


@EVERY_WAY
def test_a_pressed_cube_is_pushed_up_and_the_slab_down_with_its_lever(way):
    force = pushed(standing((0.2, 0.1), way))
    up = PRESSURE * AREA
    assert force[1] == pytest.approx([0.0, 0.0, up, 0.0, 0.0, 0.0], abs=1e-9 * up)
    assert force[0] == pytest.approx([0.0, 0.0, -up, -0.1 * up, 0.2 * up, 0.0], abs=1e-9 * up)


@EVERY_WAY
@pytest.mark.parametrize("along", [(1.0, 0.0), (0.0, -1.0), (0.6, 0.8)])
def test_a_slide_meets_its_springs_and_then_friction_which_takes_what_springs_do_not_hold(along, way):
    """Step by step t = k_s s up to mu p; then mu p s a step, less what the springs come to hold at first."""
    model, along = standing(way=way), np.array([*along, 0.0])
    speed = 0.4 * TAN * PRESSURE / (KS * DT)
    account, shear = model.large.near.account, []
    for _ in range(4):
        force = pushed(model, speed * along)
        shear.append(-force[1, :3] @ along / AREA)
        arm = np.array([0.0, 0.0, -(0.5 * SIDE)])
        assert force[1, 3:] == pytest.approx(np.cross(arm, force[1, :3]), rel=1e-3, abs=1e-9 * PRESSURE * AREA)
        assert force[0, :3] == pytest.approx(-force[1, :3])
    most, slip = TAN * PRESSURE, speed * DT
    assert shear == pytest.approx([0.4 * most, 0.8 * most, most, most], rel=1e-9)
    first = 0.5 * (0.8 + 1.0) * most * slip - 0.5 * (1.0 - 0.8**2) * most**2 / KS
    assert account[FRICTION] == pytest.approx((first + most * slip) * AREA, rel=1e-9)
    assert stored_energy(model.large.near) == pytest.approx(0.5 * AREA * (PRESSURE**2 / KN + most**2 / KS), rel=1e-9)


@EVERY_WAY
@pytest.mark.parametrize("body", [0, 1])
def test_a_turn_about_the_normal_is_held_by_the_polar_moment_of_the_points(body, way):
    """Corners: half of the diagonal squared times the area; the slab's turn is that of the block the other way."""
    model, rate = standing(way=way), 1e-3
    spin = (0.0, 0.0, rate)
    force = pushed(model, spin=spin) if body == 1 else pushed(model, of_slab=(0.0, 0.0, 0.0, *spin))
    moment = KS * rate * DT * 0.5 * SIDE**2 * AREA
    sign = 1.0 if body == 1 else -1.0
    assert force[1, 5] == pytest.approx(-sign * moment, rel=1e-6)
    assert force[0, 5] == pytest.approx(sign * moment, rel=1e-6)
    assert force[1, :2] == pytest.approx([0.0, 0.0], abs=1e-9 * moment / SIDE)


@EVERY_WAY
def test_a_slab_that_turns_carries_a_block_beside_its_axis_along_its_circle(way):
    """Points at (0.2, 0.1) move by w x r past the block: it is dragged along by k_s times the step."""
    model, rate = standing((0.2, 0.1), way), 1e-3
    force = pushed(model, of_slab=(0.0, 0.0, 0.0, 0.0, 0.0, rate))
    drag = KS * rate * DT * AREA
    assert force[1, :2] == pytest.approx([-0.1 * drag, 0.2 * drag], rel=1e-6)
    together = pushed(standing((0.2, 0.1), way), velocity=(-0.1 * rate, 0.2 * rate, 0.0), spin=(0.0, 0.0, rate),
                      of_slab=(0.0, 0.0, 0.0, 0.0, 0.0, rate))  # fmt: skip
    assert together[1, [0, 1, 5]] == pytest.approx([0.0, 0.0, 0.0], abs=1e-9 * drag), "they turn as one"


@EVERY_WAY
@pytest.mark.parametrize(("block", "slab"), [(1.0, 1.0), (1.5, 0.5)])
def test_shear_turns_with_its_blocks_by_the_mean_of_their_spins(block, slab, way):
    """Seen from where the slab was, as their frames stay; but for what their own turn against each other drags."""
    model = standing(way=way)
    pushed(model, velocity=(1e-2, 0.0, 0.0))
    start = pushed(model)[1, :2]
    angle, steps = 0.01, 20
    for _ in range(steps):
        spins = (0.0, 0.0, block * angle / DT), (0.0, 0.0, 0.0, 0.0, 0.0, slab * angle / DT)
        force = pushed(model, spin=spins[0], of_slab=spins[1])
    whole = steps * np.arctan(angle)
    if block == slab:
        assert force[1, :2] == pytest.approx(turn(2, whole)[:2, :2] @ start, rel=1e-6)
    else:
        assert force[1, 5] < 0.0, "friction resists it"


@pytest.mark.parametrize("rate", [-0.02, 0.001, 5.0])
def test_a_dashpot_resists_by_half_the_critical_damping_and_never_pulls(rate):
    """2 z root(k_n m / A) times the rate of closing; with what it took before half of each step's work is by each."""
    model = standing()
    damper = 2.0 * 0.5 * np.sqrt(KN * DENSITY * SIDE**3 / AREA)
    assert model.large.near.pairs.dashpot[0] == pytest.approx(damper)
    stress = -min(damper * rate, PRESSURE)  # beyond the springs
    force = [pushed(model, velocity=(0.0, 0.0, rate))[1, 2] for _ in range(2)]
    assert force == pytest.approx([(PRESSURE + stress) * AREA] * 2, abs=1e-9 * PRESSURE * AREA)
    taken = -stress * rate * DT * AREA * (0.5 + 1.0)
    assert model.large.near.account[DASHPOT] == pytest.approx(taken, rel=1e-9)
    assert model.large.near.pairs.damped[0] == pytest.approx(taken, rel=1e-9)


def test_two_blocks_that_both_move_are_damped_by_their_masses_in_series():
    """A cube of 0.1 m on one of 0.2 m, which weighs eight times as much."""
    boxes = [slab(1.0), box("below", (-0.1, -0.1, 0.0), (0.2, 0.2, 0.2), "units", 1)]
    boxes.append(box("above", (-0.05, -0.05, 0.2), (0.1, 0.1, 0.1), "units", 2))
    model = assemble(dry(boxes)).model
    model.bodies.rigid.q[1:, 2] = -DEEP, -2.0 * DEEP
    model.large.near.motion.travel[1:] += 2.0 * DEEP
    assert refresh(model.large.near) >= 0.0
    pairs = model.large.near.pairs
    p = next(p for p in range(pairs.number[0]) if set(pairs.body[p]) == {1, 2})
    mass = DENSITY * 0.1**3
    assert pairs.dashpot[p] == pytest.approx(np.sqrt(KN * (8.0 / 9.0) * mass / 0.01))


def test_what_presses_from_the_start_is_born_and_what_goes_is_lost():
    model = standing()
    near = model.large.near
    held = 0.5 * AREA * PRESSURE**2 / KN
    assert near.account[BORN] == pytest.approx(held) and near.account[NORMAL_GAINED] == 0.0
    pushed(model, velocity=(0.2 * TAN * PRESSURE / (KS * DT), 0.0, 0.0))
    sheared = 0.5 * AREA * (0.2 * TAN * PRESSURE) ** 2 / KS
    model.bodies.rigid.q[1, 0] = 0.6  # beside the slab, as deep as before, and before the next search
    near.motion.travel[1] += 0.6
    near.search.built[1] += 0.6
    assert refresh(near) >= 0.0
    assert near.account[SHEAR_LOST] == pytest.approx(sheared)
    assert near.account[NORMAL_GAINED] == pytest.approx(-held)
    assert stored_energy(near) == 0.0


def test_points_of_a_patch_are_told_with_the_force_on_the_first_block_and_the_normal_out_of_it():
    model = standing((0.2, 0.1))
    pushed(model, velocity=(1e-2, 0.0, 0.0))
    block, _, place, force, normal = BearingPoints(model.large.near).take(model.large.near)
    assert len(place) == 4 and (block == [0, 1]).all()
    assert np.unique(np.round(place[:, 0], 6)) == pytest.approx([0.15, 0.25])
    points_of = model.large.near.pairs.points_of[0]
    assert place[:, 2] == pytest.approx(np.full(4, -DEEP * points_of), abs=1e-12), "on the face of their own block"
    assert normal == pytest.approx(np.tile([0.0, 0.0, 1.0], (4, 1)))
    total = force.sum(axis=0)
    assert total == pytest.approx([KS * 1e-2 * DT * AREA, 0.0, -PRESSURE * AREA], rel=1e-6, abs=1e-9)
