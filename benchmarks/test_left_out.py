"""What a scene does not use costs nothing: steps without a feature beside hand-written ones that never had it.

The wall's own step has rigid blocks, one exponential law with shared loss, damping and the ledger, and nothing else: it
is the one without dead loads (gravity, tractions), dilation, a second law, expected motion, turned axes, plastic
opening, affine blocks and tets. The others leave out one thing more.
"""

from dataclasses import replace

import numpy as np
import pytest

from masonry import scene
from masonry.assembly.assemble import assemble
from masonry.kinematics.motion import Guided
from masonry.laws.brittle import Brittle
from masonry.laws.elastic import Elastic
from masonry.laws.state import JointProperties
from masonry.scene.source import packaged
from verification.reference_step import models, specimens
from verification.reference_step.interleaved import against, in_turn, require
from verification.reference_step.reference import ReferenceStep

STEPS, ROUNDS = 10, 400
LIMIT = 1.03
"""Of a step to that by hand."""
BRITTLE = Brittle(), models.JOINT
ELASTIC = Elastic(), JointProperties(models.JOINT.normal_stiffness, models.JOINT.shear_stiffness)


def law(**options) -> tuple:
    """The usual law with other options of its joint."""
    return models.SOFTENING[0], models.JOINT._replace(**options)


def slow(model) -> np.ndarray:
    """Velocities (B, 6) so slow that the contacts stay untouched."""
    return np.random.default_rng(1).normal(scale=1e-7, size=(model.blocks.count, 6))


def wall(**options):
    """A wall of rigid blocks in a slight motion, which is the same whatever acts: openings then keep their signs."""
    blocks, joints = specimens.wall(16, 16)
    if options.pop("two", False):
        blocks = replace(blocks, unit=blocks.unit // 2)
    axes = options.pop("axes", False)
    model = models.model_of(blocks, joints, **options)
    if axes:
        models.turn_axes(model)
    if options.get("guided"):
        model.damping = Guided(0.05, 0.2)
    models.make_unstoppable(model)
    models.set_velocity(model, slow(model))
    return model


@pytest.mark.parametrize(
    ("absent", "options", "by_hand"),
    [
        ("dead loads, dilation, a second law, tets, ...", {}, {}),
        ("damping", {"damping": 0.0}, {"damped": False}),
        ("energy ledger", {"ledger": False}, {"booked": False}),
        ("softening: brittle", {"law": BRITTLE}, {"law": "brittle"}),
        ("strength and softening: elastic", {"law": ELASTIC}, {"law": "elastic"}),
    ],
    ids=["usual", "damping", "ledger", "softening", "strength"],
)
def test_a_step_without_it_is_as_fast_as_by_hand(benchmark, figure, absent, options, by_hand):
    model = wall(**options)
    twin = ReferenceStep(model, **by_hand)
    twin.make_unstoppable()
    twin.set_velocity(slow(model))
    ours, theirs = models.stepping(model, STEPS), twin.stepping(STEPS)
    ours()
    theirs()
    scale = np.abs(twin.force).max()
    assert np.allclose(models.forces(model), twin.force[:, :3], rtol=1e-6, atol=1e-9 * scale)
    benchmark.pedantic(ours, rounds=20)
    value = against((ours, models.stepping(model, 0)), (theirs, twin.stepping(0)), ROUNDS).ratio
    assert options.get("law") == ELASTIC or models.evolving(model, ours) == 0.0
    benchmark.extra_info["ratio"] = value
    figure(f"without {absent}: over a step by hand that never had it", value, "", 1.03)
    require(value, LIMIT, f"a step without {absent}")


WITH = {
    "dead loads": {"loaded": True},
    "dilation": {"law": law(tan_dilation=0.03, dilation_cutoff=1e-3)},
    "second law": {"two": True},
    "expected motion": {"guided": True},
    "turned axes": {"axes": True},
}
WITHOUT = {
    "damping": {"damping": 0.0},
    "energy ledger": {"ledger": False},
    "softening": {"law": BRITTLE},
}
FEW = ["specimen.cells.total=30"]
"""Random cells are made in no time where they are few; what a step contains is the same."""


@pytest.fixture(scope="module")
def saved() -> dict[str, float]:
    """Share of the wall's step that each feature takes, or would take."""
    made = [wall(**options) for options in ({}, *WITH.values(), *WITHOUT.values())]
    bricks = specimens.bricks((16, 1, 16), (1, 1, 1))
    for kind in ("rigid", "tets"):
        model = models.model_of(*bricks[:2], bricks[2] if kind == "tets" else None, kind=kind)
        models.set_velocity(model, np.full((len(models.moved(model)), 3), 1e-6))
        made.append(model)
    works = [models.stepping(model, STEPS) for model in made]
    for work in works:
        work()
    # The usual one twice: the first comes after the tets, which leave it nothing in the cache.
    _, usual, *others, rigid, tets = (t.least for t in in_turn(works[0], *works, rounds=200))
    times = dict(zip((*WITH, *WITHOUT), others, strict=True))
    fractions = {name: 1.0 - usual / times[name] for name in WITH} | {
        name: 1.0 - times[name] / usual for name in WITHOUT
    }
    return fractions | {"tets": 1.0 - rigid / tets}


def test_what_the_shipped_scenes_leave_out_costs_them_nothing(figure, left_out, saved):
    for name, fraction in saved.items():
        figure(f"leaving out {name} saves of a step", 100.0 * fraction, "%")
    for name in packaged():
        cells = getattr(scene.load(name).specimen, "cells", None)
        used = models.used(assemble(scene.load(name, FEW if cells is not None else [])).model)
        left_out[name] = {part: None if part in used else fraction for part, fraction in saved.items()}
    for name, fraction in saved.items():
        require(1.0 - fraction, 1.1, f"a step without {name}, over one with it")
