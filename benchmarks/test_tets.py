"""Blocks of tets: the whole step per tet, in 216 bricks whose nodes meet in pairs, contacts untouched."""

import numpy as np
import pytest

from verification.reference_step import models, specimens
from verification.reference_step.interleaved import in_turn, require
from verification.reference_step.reference import ReferenceStep

SIZES = {
    "10k": ((2, 2, 2), 5, 200, (35.0, 17.5), (19.0, 9.5), 1.35),
    "100k": ((4, 4, 5), 3, 60, (37.0, 21.0), (21.0, 12.0), 1.3),
    "500k": ((7, 7, 8), 2, 16, (38.0, 25.0), (None, 14.0), 1.3),
}
"""Cells of a brick, steps of a call, rounds; limits of the figures on 1 and 2 threads, of the gate [1.15, 1, 0.9]."""


@pytest.mark.parametrize("size", SIZES)
def test_a_tet_costs_what_a_whole_step_by_hand_costs(benchmark, figure, size):
    cells, steps, rounds, one, two, limit = SIZES[size]
    model = models.model_of(*specimens.bricks((6, 6, 6), cells), kind="tets")
    twin, count = ReferenceStep(model), len(model.layout.mesh.tets)
    velocity = np.random.default_rng(1).normal(scale=1e-6, size=(len(model.layout.mesh.nodes), 3))
    models.set_velocity(model, velocity)
    twin.set_velocity(velocity)
    ours, by_hand, threaded = models.stepping(model, steps), twin.stepping(steps), models.stepping(model, steps, 2)
    by_hand()
    assert models.evolving(model, ours) == 0.0
    assert np.allclose(models.moved(model), twin.u[:, :3], rtol=1e-6, atol=1e-9 * np.abs(twin.u).max())
    threaded()
    benchmark.pedantic(ours, rounds=5)
    times = in_turn(ours, by_hand, threaded, rounds=rounds)
    seconds = times[0].least, times[1].least, times[2].wall  # two threads are there to be done sooner
    ns, ns_by_hand, ns_on_two = (1e9 * time / steps / count for time in seconds)
    benchmark.extra_info["ratio"] = ns / ns_by_hand
    figure(f"step per tet, {size} tets, 1 thread", ns, "ns", *one, times[0].spread)
    figure("  by hand", ns_by_hand, "ns")
    figure(f"step per tet, {size} tets, 2 threads", ns_on_two, "ns", *two, times[2].spread)
    require(ns / ns_by_hand, limit, f"a whole step of {size} tets")
