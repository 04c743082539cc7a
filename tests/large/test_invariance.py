"""One motion, told in other words: from far away, turned, with other numbers, on more threads, with more room."""

from functools import cache
from math import cos, radians, sin

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.configuration import large, model_state
from masonry.detection.broad import cells_for
from masonry.laboratory import laboratory
from masonry.laboratory.cost import candidates
from masonry.laboratory.text import check_text
from masonry.patches.arrays import no_points
from masonry.patches.pairs import no_pairs
from tests.large.made import dry, leaning
from tests.scenes import box

LEAN = leaning(25.0)
BOXES = (
    ("slab", (-2.0, -0.5, -0.125), (4.0, 1.0, 0.125)),
    ("tall", (-0.0625, -0.125, 0.0), (0.125, 0.25, 0.375)),
    ("low", (0.125, -0.125, 0.0), (0.125, 0.25, 0.125)),
    ("top", (0.125, -0.0625, 0.125), (0.125, 0.125, 0.0625)),
)
"""The tall one topples upon the low one, which bears another; sizes that a computer holds exactly."""
GAUGES = "".join(f'[[gauge]]\nname = "{name}"\nat = "{name}"\ndirection = "z"\n' for name, *_ in BOXES[1:])
MOTION = ("kinetic", "external_work")


def scene(shift=(0.0, 0.0, 0.0), order=1, gravity=LEAN, turned="", duration=0.4):
    boxes = [
        box(name, np.add(low, shift), size, "units", number) for number, (name, low, size) in enumerate(BOXES[::order])
    ]
    more = f'time_step = "1e-5 s"\n{GAUGES}'
    return dry(boxes, 0.8, gravity, turned=turned, more=more, duration=duration)


@cache
def as_it_is():
    return laboratory.run(scene()).history.rows


def apart(rows, until: float, keys=("kinetic", "external_work", "elastic_contacts")) -> float:
    """By how much energies differ at most up to a time (s), over the largest ones."""
    early = as_it_is()["time"] < until
    return max(np.abs(rows[k] - as_it_is()[k])[early].max() / np.abs(as_it_is()[k]).max() for k in keys)


def test_the_tall_block_hits_the_low_one():
    rows = as_it_is()
    late = rows["time"] > 0.3
    assert rows["dashpot"][late].max() > 10.0 * rows["dashpot"][~late].max()


def test_blocks_with_points_inside_their_patches_may_be_numbered_backwards_and_differ_from_those_at_corners():
    one, other = (laboratory.run(scene(order=k, turned='patch_points = "spread"')).history.rows for k in (1, -1))
    assert all(one[key].tobytes() == other[key].tobytes() for key in one)
    assert np.abs(one["imbalance"]).max() < 1e-12 and np.abs(one["kinetic"] - as_it_is()["kinetic"]).max() > 0.0


def test_blocks_may_be_numbered_backwards_to_the_same_bits():
    rows = laboratory.run(scene(order=-1)).history.rows
    assert all(rows[key].tobytes() == as_it_is()[key].tobytes() for key in as_it_is())


def test_the_scene_may_be_a_kilometre_away():
    rows = laboratory.run(scene(shift=(1024.0, -1024.0, 512.0))).history.rows
    assert apart(rows, 0.3) < 1e-12
    assert apart(rows, 1.0, MOTION) < 1e-8


@pytest.mark.parametrize("about", ["y", "z"])
def test_the_scene_may_be_turned(about):
    a, (x, _, z) = radians(30.0), LEAN
    gravity = (cos(a) * x + sin(a) * z, 0.0, cos(a) * z - sin(a) * x) if about == "y" else (cos(a) * x, sin(a) * x, z)
    turned = f'turned = {{about = "{about}", angle = "30 deg"}}'
    rows = laboratory.run(scene(gravity=gravity, turned=turned)).history.rows
    assert apart(rows, 0.3) < 1e-9


def test_two_threads_give_the_bits_of_one():
    rows = laboratory.run(scene(duration=0.1), threads=2).history.rows
    one = laboratory.run(scene(duration=0.1), threads=1).history.rows
    assert all(rows[key].tobytes() == one[key].tobytes() for key in one)


def test_a_model_whose_points_outgrow_their_room_gets_more_and_goes_on(monkeypatch):
    built, more = assemble(scene()), []
    near = built.model.large.near
    room = no_points(1, near.points.feature.shape[1])
    built.model.large.near = near._replace(points=room)
    usual = large.make_room
    monkeypatch.setattr(large, "make_room", lambda *built: more.append(usual(*built)))
    outcome = laboratory.timeloop.run(built.model, built.plan, built.recording)
    assert 1 <= len(more) <= 3, "from 1 to 2 to 4 slots"
    assert len(built.model.large.near.points.number) in (2, 4)
    assert apart(outcome.history.rows, 0.3) < 1e-12
    kept, other = model_state.state(built.model), assemble(scene()).model
    other.large.near = other.large.near._replace(points=room, pairs=no_pairs(1))
    model_state.restore(other, kept)
    assert all(array.tobytes() == kept[name].tobytes() for name, array in model_state.state(other).items())
    roomy = assemble(scene()).model  # as a run that goes back from where it had got more room
    assert len(roomy.large.near.points.number) > len(kept["points.number"])
    model_state.restore(roomy, kept)
    assert all(array.tobytes() == kept[name].tobytes() for name, array in model_state.state(roomy).items())


def test_pairs_that_outgrow_their_room_get_more_too():
    built = assemble(scene())
    near = built.model.large.near
    few = {"pairs": no_pairs(1), "before": no_pairs(1), "cells": cells_for(near.pieces, 1)}
    search = near.search._replace(candidates=np.zeros((1, 2), dtype=np.int64))
    built.model.large.near = near._replace(search=search, **few)
    outcome = laboratory.timeloop.run(built.model, built.plan, built.recording)
    assert len(built.model.large.near.pairs.slot) > 2
    assert apart(outcome.history.rows, 0.3) < 1e-12


def test_what_may_meet_is_told_before_the_run():
    """The slab with both blocks on it, and what the low one bears; the tall and the low one are too far apart."""
    assert candidates(assemble(scene()).model.large) == 3
    assert "may meet 3 pairs of 4 convex pieces" in " ".join(check_text(laboratory.check(scene())).split())
