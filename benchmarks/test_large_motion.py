"""Blocks that turn and deform as far as they like, against those that hardly move: per block, per tet, and a step."""

import numpy as np
import pytest

from masonry.jit.compiler import jit
from masonry.kinematics.dispatch import move, update_positions
from masonry.kinematics.turning import spin
from masonry.model.body_arrays import Bodies
from masonry.model.large.bodies import deforming_tets, large
from verification.reference_step import models, specimens
from verification.reference_step.interleaved import in_turn, require
from verification.scene_runs import assembled

STEPS, DAMPING, LOADING = 20, 0.8, (1.0, 1.0, 0.0, 0.0)


@jit
def _update_positions(steps, dt, body, u):
    for _ in range(steps):
        update_positions(None, body, dt, u)


@jit
def _move(steps, dt, body, force, u):
    for _ in range(steps):
        move(None, body, dt, DAMPING, LOADING, force, u)


def halves(model, kind: str):
    """The two halves of a step of a model's bodies of one kind, without the contacts' sweep."""
    body, contacts = getattr(model.bodies, kind), model.contacts
    return (
        lambda: _update_positions(STEPS, model.dt, body, contacts.u),
        lambda: _move(STEPS, model.dt, body, contacts.force, contacts.u),
    )


def wall(kind: str, rotates: bool, joined: bool):
    """1000 blocks that tumble, with contact sides or without."""
    model = models.model_of(*specimens.wall(25, 40), kind=kind)
    if rotates:
        model.bodies = large(model.bodies, model.masses["rigid"][:, 3:])
    body = getattr(model.bodies, kind)
    body.v[...] = np.random.default_rng(1).normal(scale=0.1, size=body.v.shape)
    if rotates and kind == "rigid":
        spin(body)
    if not joined:
        models.replace_bodies(model, start=np.zeros_like(body.start))
    return model


@pytest.mark.parametrize("kind", ["rigid", "affine"])
def test_a_block_that_turns(figure, kind):
    small, big = wall(kind, False, True), wall(kind, True, True)
    alone = wall(kind, True, False)
    works = [half for model in (small, big, alone) for half in halves(model, kind)]
    for work in works:
        work()
    times = in_turn(*works, rounds=40)
    ns = [1e9 * t.least / STEPS / small.blocks.count for t in times]
    sides = 2.0 * len(small.joints.area) / small.blocks.count
    figure(f"turn of a {kind} block, no contacts", ns[4], "ns", 150.0, 100.0, times[4].spread)
    figure("  its forces, works and momenta", ns[5], "ns", 150.0, 80.0, times[5].spread)
    figure(f"whole motion of a {kind} block with {sides:.0f} contact sides, large", ns[2] + ns[3], "ns")
    figure("  small displacement", ns[0] + ns[1], "ns")


def test_a_tet_of_st_venant_and_kirchhoff(figure):
    steps = 5
    specimen = specimens.bricks((6, 6, 6), (2, 2, 2))
    trio = [models.model_of(*specimen, kind="tets") for _ in range(3)]
    velocity = np.random.default_rng(1).normal(scale=1e-6, size=trio[0].bodies.tets.v.shape)
    for model, framed in zip(trio[1:], (False, True), strict=True):
        model.bodies = Bodies(None, None, deforming_tets(model.bodies.tets, None, framed))
    for model in trio:
        models.set_velocity(model, velocity)
    takes = [models.stepping(model, steps) for model in trio]
    for take in takes:
        take()
    assert np.allclose(models.moved(trio[1]), models.moved(trio[0]), rtol=1e-4, atol=1e-16)
    assert np.array_equal(models.moved(trio[1]), models.moved(trio[2]))
    times = in_turn(*takes, rounds=200)
    count = len(trio[0].layout.mesh.tets)
    linear, square, framed = (1e9 * t.least / steps / count for t in times)
    figure("step per tet, 10k tets, St Venant-Kirchhoff", square, "ns", 1.6 * linear, 1.4 * linear, times[1].spread)
    figure("  with frames", framed, "ns")
    figure("  linear", linear, "ns")
    require(square / linear, 1.7, "a whole step of tets of St Venant and Kirchhoff")


def test_a_dry_wall_that_stands(figure):
    """1000 bricks whose contacts are detected patches, against the same wall in small displacement."""
    steps, settling = 20, 3000
    pair = [assembled("dry-wall", {"displacements": word}).model for word in ("small", "large")]
    for model in pair:
        models.stepping(model, settling)()
    takes = [models.stepping(model, steps) for model in pair]
    near = pair[1].large.near
    points = sum(int(near.points.number[slot]) for slot in near.pairs.slot[: near.pairs.number[0]])
    times = in_turn(*takes, rounds=60)
    small, large = (1e9 * t.least / steps for t in times)
    figure(
        "step of a dry wall that stands, per brick", large / 1000.0, "ns", 667.0, 1.3 * small / 1000.0, times[1].spread
    )
    figure("  per contact point", large / points, "ns")
    figure("  small displacement", small / 1000.0, "ns")
    require(large / small, 2.0, "a step of a dry wall that stands, in large displacement")


def test_a_glued_wall(figure):
    """A wall of bonds that hold, in frames that turn with its bricks, against the same wall in small displacement."""
    steps = 200
    real = {"solver.masses": "real", "drive.rate": "1 mm/s", "drive.accuracy": None}
    pair = [assembled("mortared-wall", {"displacements": word, **real}).model for word in ("small", "large")]
    takes = [models.stepping(model, steps) for model in pair]
    for take in takes:
        take()
    times = in_turn(*takes, rounds=40)
    points = len(pair[0].joints.area)
    small, large = (1e9 * t.least / steps / points for t in times)
    figure("step of a glued wall, per contact point", large, "ns", 25.0, 1.4 * small, times[1].spread)
    figure("  small displacement", small, "ns")
    require(large / small, 1.7, "a step of a glued wall, in large displacement")


def test_a_dry_wall_that_flies(figure):
    """The same bricks as they fly together, 10 um a step, some 3 m/s."""
    steps, settling = 20, 3000
    small, large = (assembled("dry-wall", {"displacements": word}).model for word in ("small", "large"))
    for model in (small, large):
        models.stepping(model, settling)()
    body = large.bodies.rigid
    body.v[body.dt_over_mass[:, 2] > 0.0, 2] = 1e-5 / large.dt
    models.stepping(large, 5 * steps)()
    times = in_turn(models.stepping(small, steps), models.stepping(large, steps), rounds=20)
    stands, flies = (1e9 * t.least / steps for t in times)
    aim = 3.0 * stands / 1000.0
    figure("step of a dry wall that flies, per brick", flies / 1000.0, "ns", 2.0 * aim, aim, times[1].spread)
    require(flies / stands, 8.0, "a step of a dry wall that flies, in large displacement")
