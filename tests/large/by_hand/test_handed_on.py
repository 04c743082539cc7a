"""What patches hand on: shear through a turn, gaps of faces that deform, what goes with area or with a block that flies
off, and each number of their account as a line of the ledger."""

import numpy as np
import pytest

from masonry.configuration import energy
from masonry.patches.arrays import (
    AREA,
    BORN,
    CRUSHED,
    DASHPOT,
    FRICTION,
    NORMAL_GAINED,
    PLACE,
    SHEAR,
    SHEAR_LOST,
)
from masonry.patches.press import gap_of
from masonry.patches.press import stored as energies
from masonry.patches.refreshing import refresh
from masonry.simd import FOUR
from tests.kinematics.bricks import turn
from tests.large import test_pressed_blocks as blocks
from tests.large.by_hand.patch_calls import press_deforming
from tests.large.made import gathering, make

SHEARED = np.array([0.8e4, 0.6e4, 0.0])
"""Pa, less than friction bears."""


@pytest.fixture
def straight(monkeypatch):
    """A block that is not strained, pressed evenly on its slab."""
    monkeypatch.setattr(blocks, "STRAINED", np.eye(3))
    model = blocks.pressed(np.eye(3))
    shear_by(model, SHEARED)
    return model


def four_points(model, rows: slice) -> np.ndarray:
    """(4, rows) of the four points; they lie beside each other in memory, or one after another without lanes."""
    return model.large.near.points.quads[: 4 // FOUR, slot(model), rows].transpose(0, 2, 1).reshape(4, -1)


def shear(model) -> np.ndarray:
    """(4, 3) Pa, the tractions of the four points."""
    return four_points(model, slice(SHEAR, SHEAR + 3))


def shear_by(model, tractions: np.ndarray) -> None:
    """Give all four points these tractions (3,) in Pa."""
    model.large.near.points.quads[: 4 // FOUR, slot(model), SHEAR : SHEAR + 3] = tractions[:, None]


def slot(model) -> int:
    return int(model.large.near.pairs.slot[0])


def held(model) -> np.ndarray:
    """J by pressure and by shear."""
    near = model.large.near
    return np.array(energies(near.pairs, near.points, near.rules, near.motion, 0))


def shifted(model, *way: float) -> None:
    """The block is somewhere else, and contacts are looked for again."""
    model.bodies.affine.q[0, :3] += way
    model.large.near.motion.travel[:] += np.linalg.norm(way)
    blocks.gather(model)
    assert refresh(model.large.near) >= 0.0


def test_two_blocks_that_turn_together_by_a_right_angle_about_the_normal_take_their_shear_along(straight):
    steps, dt = 2000, 1e-3
    spin = 0.5 * np.pi / (steps * dt)
    rigid, affine, _ = straight.bodies
    near, before, calls = straight.large.near, held(straight), gathering(straight)
    for k in range(steps):
        frame = turn(2, spin * dt * (k + 1))
        rigid.frame[0] = affine.frame[0] = frame
        affine.q[0, 3:] = (frame - np.eye(3)).ravel()
        rigid.v[0, 5], affine.v[0, 3:12] = spin, (spin * turn(2, 0.5 * np.pi) @ np.diag([1, 1, 0]) @ frame).ravel()
        make(calls)
        press_deforming(near, dt)
    quarter = turn(2, 0.5 * np.pi) @ SHEARED
    np.testing.assert_allclose(shear(straight), np.tile(quarter, (4, 1)), atol=1e-5 * 1e4)
    assert near.account[FRICTION] == pytest.approx(0.0, abs=1e-9 * before[1]), "nothing slides"
    near.motion.travel[:] += 1.0
    near.pairs.pose[:] = 0.0  # so that the pair is looked at, though its two blocks moved together
    refresh(near)
    np.testing.assert_allclose(shear(straight), np.tile(quarter, (4, 1)), atol=1e-5 * 1e4)
    np.testing.assert_allclose(held(straight), before, rtol=1e-6)


@pytest.mark.parametrize("deforms", ["rigid", "affine"])
def test_gaps_are_those_of_the_faces_as_they_deform_after_the_last_look(deforms):
    """From the corners of the reference's face, whichever of the two blocks that is, as they are moved by hand."""
    model = blocks.pressed(turn(0, 0.7) @ turn(2, 0.4))
    near, body = model.large.near, getattr(model.bodies, deforms)
    change = turn(1, 0.02) if deforms == "rigid" else np.eye(3) + 0.05 * np.random.default_rng(2).normal(size=(3, 3))
    body.frame[0] = body.frame[0] @ change
    body.q[0, 2] += 1e-3
    blocks.gather(model)
    motion, own = near.motion, int(near.pairs.points_of[0])
    reference, other = int(near.pairs.body[0, 1 - own]), int(near.pairs.body[0, own])
    centre = motion.centre + motion.moved[:, :3]
    is_slab = reference == int(model.layout.members["rigid"][0])
    half = np.array([2.0, 0.5, 0.05]) if is_slab else np.array([-0.1, 0.1, -0.05])
    face = [centre[reference] + motion.frame[reference] @ (half * (x, y, 1)) for x, y in ((1, 1), (-1, 1), (-1, -1))]
    normal = np.cross(face[1] - face[0], face[2] - face[1])
    normal /= np.linalg.norm(normal)
    places = four_points(model, slice(PLACE, PLACE + 3))
    wanted = [normal @ (centre[other] + motion.frame[other] @ place - face[0]) for place in places]
    gaps = [gap_of(near.pairs, near.points, motion, 0, k) for k in range(4)]
    assert gaps == pytest.approx(wanted, rel=1e-9, abs=1e-12)
    assert np.ptp(gaps) > 1e-4


def test_a_block_that_flies_off_spends_its_shear_and_lands_without_memory(straight):
    """Nor with energy: what it overlaps at first presses by nothing, and the account is even."""
    near, (pressed, sheared) = straight.large.near, held(straight)
    before = near.account.copy()
    straight.bodies.affine.q[0, 2] += 0.5
    blocks.gather(straight)
    press_deforming(near, 0.0)
    shifted(straight, 0.0, 0.0, 0.1)
    assert near.pairs.number[0] == 0 or near.pairs.slot[0] < 0
    spent = near.account - before
    assert spent[FRICTION] == pytest.approx(sheared, rel=1e-12) and sheared > 0.0
    assert not np.delete(spent, FRICTION).any()
    shifted(straight, 0.0, 0.0, -0.6)
    assert near.points.number[slot(straight)] == 4 and not shear(straight).any()
    assert held(straight) == pytest.approx([0.0, 0.0], abs=1e-9 * pressed)
    spent = near.account - before
    assert spent[NORMAL_GAINED] + spent[BORN] == pytest.approx(0.0, abs=1e-9 * pressed)
    assert spent[FRICTION] == pytest.approx(sheared, rel=1e-12) and spent[SHEAR_LOST] == spent[DASHPOT] == 0.0


@pytest.mark.parametrize(("shift", "pairs"), [(0.212, 1), (3.0, 0)], ids=["beside", "far"])
def test_a_block_that_leaves_its_slab_while_it_is_pressed_leaves_both_energies_in_the_account(straight, shift, pairs):
    """Whether it is still near the slab, or so far that they are no pair any more."""
    shifted(straight, 1.9, 0.0, 0.0)
    shear_by(straight, SHEARED)
    near, (pressed, sheared), free = straight.large.near, held(straight), straight.large.near.points.free[-1]
    before = near.account.copy()
    shifted(straight, shift, 0.0, 0.0)
    assert near.pairs.number[0] == pairs and not (near.pairs.slot[:pairs] >= 0).any()
    assert near.points.free[-1] == free + 1 and not near.points.number.any()
    lost = near.account - before
    assert lost[SHEAR_LOST] == pytest.approx(sheared, rel=1e-12) and sheared > 0.0
    assert lost[NORMAL_GAINED] + lost[BORN] == pytest.approx(-pressed, rel=1e-12)
    assert lost[FRICTION] == lost[DASHPOT] == 0.0


def test_what_a_block_held_on_the_part_of_its_face_that_slides_off_is_lost_and_no_more(straight):
    """5 % of the face goes past the edge of the slab: as much of both energies, and the traction stays."""
    shifted(straight, 1.9, 0.0, 0.0)
    shear_by(straight, SHEARED)
    near, (pressed, sheared) = straight.large.near, held(straight)
    whole, before = four_points(straight, slice(AREA, AREA + 1)).sum(), near.account.copy()
    shifted(straight, 0.01, 0.0, 0.0)
    assert four_points(straight, slice(AREA, AREA + 1)).sum() == pytest.approx(0.95 * whole, rel=1e-6)
    np.testing.assert_allclose(shear(straight), np.tile(SHEARED, (4, 1)), rtol=1e-6)
    lost = near.account - before
    assert lost[SHEAR_LOST] == pytest.approx(0.05 * sheared, rel=1e-5)
    assert held(straight)[1] == pytest.approx(0.95 * sheared, rel=1e-6)
    assert lost[NORMAL_GAINED] == pytest.approx(held(straight)[0] - pressed, rel=1e-9, abs=1e-9 * pressed)


def test_each_number_of_the_account_has_its_line_in_the_ledger_with_its_sign(straight):
    near = straight.large.near
    view, speeds = energy.observe(straight), energy.velocities(straight)
    before = energy.ledger(straight, view, speeds)
    lines = {FRICTION: ("friction", 1.0), DASHPOT: ("dashpot", 1.0), SHEAR_LOST: ("redetection", 1.0)}
    lines |= {NORMAL_GAINED: ("area", -1.0), BORN: ("area", -1.0)}
    assert [*sorted(lines), CRUSHED] == list(range(len(near.account))), "that has its line where anything crushes"
    for place, (name, sign) in lines.items():
        near.account[place] += 10.0 + place
        after = energy.ledger(straight, view, speeds)
        grown = {key: after[key] - before[key] for key in before if after[key] != before[key]}
        assert grown == {name: pytest.approx(sign * (10.0 + place), rel=1e-12)}
        before = after
