"""Contact points: node pairs in a bare sweep, and rigid blocks with lever arms in a whole step; 1 thread.

Limits of the gates lie above what was measured (in brackets) by the spread seen on a shared machine.
"""

import numpy as np
import pytest

from masonry.laws.elastic import Elastic
from masonry.laws.exponential import Exponential
from masonry.laws.state import JointProperties
from verification.reference_step import models, specimens
from verification.reference_step.interleaved import against, require
from verification.reference_step.reference import ReferenceStep

ROUNDS, STEPS = 400, 10
DEEP = 1e-6
"""m: how far the faces are pressed into each other."""
FAR, FURTHER = 1e-5, 1e-9
"""m: slip at the start where a contact slides, and slip of each round."""
STRETCH, STRETCHED = 5e-8, 60
"""Strain of the wall in each step, where all of it softens, and calls of STEPS steps until it does."""


def sliding(model, twin, sliding_fraction: float) -> np.ndarray:
    """Press all contacts, let a random share slide far beyond the peak; returns how they slide further, (C, 3) m."""
    joints = model.joints
    slides = np.random.default_rng(1).random(len(joints.area)) < sliding_fraction
    along = np.roll(joints.normal, 1, axis=1) * slides[:, None]
    begin = FAR * along - DEEP * joints.normal
    models.sweeping(model, begin, 1)()
    twin.sweeping(begin, 1)()
    return FURTHER * along


NODES = {
    "untouched": (0.0, (10.0, 6.0), 1.4),
    "40 % damaged": (0.4, (20.0, 12.0), 1.9),
    "all sliding": (1.0, (25.0, 12.0), 1.9),
}
"""Share of the contacts that slide, limits of the figure, limit of the gate [1.1, 1.5, 1.3]."""


@pytest.mark.parametrize("name", NODES)
def test_a_pair_of_nodes_costs_what_the_exponential_law_by_hand_costs(benchmark, figure, name):
    sliding_fraction, limits, limit = NODES[name]
    model = models.model_of(*specimens.pairs(), kind="tets")
    twin, count = ReferenceStep(model), len(model.joints.area)
    by = sliding(model, twin, sliding_fraction)
    ours, by_hand = models.sweeping(model, by, STEPS), twin.sweeping(by, STEPS)
    idle = models.sweeping(model, by, STEPS, sweeps=False), twin.sweeping(by, STEPS, sweeps=False)
    by_hand()
    assert models.evolving(model, ours) == pytest.approx(sliding_fraction, abs=0.02)
    agree(model, twin)
    benchmark.pedantic(ours, rounds=20)
    found = against((ours, idle[0]), (by_hand, idle[1]), ROUNDS)
    report(benchmark, figure, f"contact of two nodes, {name}", found, count, limits)
    require(found.ratio, limit, f"contacts of nodes, {name}")


def agree(model, twin) -> None:
    """Both find the same forces."""
    assert np.allclose(models.forces(model), twin.force[:, :3], rtol=1e-6, atol=1e-9 * np.abs(twin.force).max())


def report(benchmark, figure, row, found, count, limits) -> None:
    """A line for ours, one for the hand-written, and the ratio beside the timings."""
    benchmark.extra_info["ratio"] = found.ratio
    figure(row, 1e9 * found.ours / STEPS / count, "ns", *limits, found.spread)
    figure("  by hand", 1e9 * found.by_hand / STEPS / count, "ns")


CAP = {"compressive_strength": 10e6, "crushing_energy": 5e3, "closing_at_peak": 0.09e-3, "cap_shear_factor": 9.0}
CRUSHES = {
    "cap, hardening": (CAP, 5e-5, 1.8),
    "cap, softening": (CAP, 5e-4, 1.6),
    "cut-off": ({"compressive_strength": 10e6, "crushing_energy": 5e3}, 2e-4, 1.1),
}
"""Properties of joints, how far (m) the faces are pressed together, limit of the gate [1.35, 1.25, 0.85]."""
SQUEEZES = 2000
"""Steps in which they are pressed so far."""


@pytest.mark.parametrize("name", CRUSHES)
def test_a_contact_that_crushes_costs_little_more_than_one_that_slides(figure, name):
    properties, pressed, limit = CRUSHES[name]
    slides = models.model_of(*specimens.pairs(), kind="tets")
    by = sliding(slides, ReferenceStep(slides), 1.0)
    crushes = models.model_of(
        *specimens.pairs(), kind="tets", law=(Exponential(5.0, 15.0), models.JOINT._replace(**properties))
    )
    normal = crushes.joints.normal
    models.sweeping(crushes, -pressed / SQUEEZES * normal, SQUEEZES)()
    sides = []
    for model, further in ((crushes, -FURTHER * normal), (slides, by)):
        work = models.sweeping(model, further, STEPS)
        assert models.evolving(model, work) == 1.0
        sides.append((work, models.sweeping(model, further, STEPS, sweeps=False)))
    found = against(*sides, ROUNDS)
    count = len(crushes.joints.area)
    figure(f"contact of two nodes, crushing, {name}", 1e9 * found.ours / STEPS / count, "ns", None, None, found.spread)
    figure("  one that slides", 1e9 * found.by_hand / STEPS / count, "ns")
    require(found.ratio, limit, f"contacts that crush, {name}, over one that slides")


@pytest.mark.parametrize("name", ["untouched", "all softening"])
def test_a_contact_of_rigid_blocks_costs_what_a_whole_step_by_hand_costs(benchmark, figure, name):
    limits, limit = ((16.0, 10.0), 1.6) if name == "untouched" else ((30.0, 18.0), 1.8)  # [1.3, 1.4]
    model = models.model_of(*specimens.wall(16, 16))
    twin, count = ReferenceStep(model), len(model.joints.area)
    velocity = np.random.default_rng(1).normal(scale=1e-6, size=(model.blocks.count, 6))
    if name == "all softening":  # the wall gets longer: head joints open, bed joints slide
        velocity[:] = 0.0
        velocity[:, 0] = STRETCH * model.layout.centroid[:, 0] / model.dt
        models.make_unstoppable(model)
        twin.make_unstoppable()
    models.set_velocity(model, velocity)
    twin.set_velocity(velocity)
    ours, by_hand = models.stepping(model, STEPS), twin.stepping(STEPS)
    for _ in range(STRETCHED if name == "all softening" else 1):
        ours()
        by_hand()
    agree(model, twin)
    benchmark.pedantic(ours, rounds=20)
    found = against((ours, models.stepping(model, 0)), (by_hand, twin.stepping(0)), ROUNDS)
    assert models.evolving(model, ours) == (name == "all softening")
    report(benchmark, figure, f"contact of rigid blocks, {name}", found, count, limits)
    require(found.ratio, limit, f"contacts of rigid blocks, {name}")


def test_an_elastic_contact_costs_what_a_hand_written_one_costs(benchmark, figure):
    law = Elastic(), JointProperties(models.JOINT.normal_stiffness, models.JOINT.shear_stiffness)
    model = models.model_of(*specimens.pairs(), kind="tets", law=law)
    twin, count = ReferenceStep(model, "elastic"), len(model.joints.area)
    by = np.random.default_rng(1).uniform(-1e-9, 1e-9, (count, 3))
    ours, by_hand = models.sweeping(model, by, STEPS), twin.sweeping(by, STEPS)
    idle = models.sweeping(model, by, STEPS, sweeps=False), twin.sweeping(by, STEPS, sweeps=False)
    ours()
    by_hand()
    agree(model, twin)
    benchmark.pedantic(ours, rounds=20)
    found = against((ours, idle[0]), (by_hand, idle[1]), ROUNDS)
    report(benchmark, figure, "contact of two nodes, elastic", found, count, (None, None))
    require(found.ratio, 1.6, "elastic contacts of nodes")
