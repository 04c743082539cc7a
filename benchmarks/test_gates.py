"""Performance gates: every one a ratio, in one process, to a hand-written kernel or to the step without the feature.

`make bench` also records the absolute times; only the ratios can fail. Limits lie above what was measured (in
brackets) by the spread seen on a shared machine.
"""

import numpy as np
import pytest
from numba.core.runtime import _nrt_python, rtsys

from benchmarks.interleaved import ratio
from benchmarks.reference import elastic_contacts, exponential_contacts
from masonry import scene, timeloop
from masonry.arrays import in_rows
from masonry.assembly import assemble
from masonry.kernels.contact import sweep
from masonry.laws.elastic import Elastic
from masonry.laws.exponential import Exponential
from masonry.laws.interface import Interface
from masonry.laws.state import ContactState, fresh
from masonry.pace import Chunk

COUNT = 5000
INTERFACE = Interface(167e9, 69.6e9, 0.1e6, 0.15e6, 1.0, 0.0, 0.7265, combined=1.0)
ENERGIES = (5.0, 15.0)


def contacts(spread: float) -> tuple:
    """Node pairs with random relative displacements of up to `spread` metres."""
    rng = np.random.default_rng(1)
    sides = np.arange(2 * COUNT, dtype=np.uint32).reshape(COUNT, 2)
    normal = np.zeros((COUNT, 3), order="F")
    normal[np.arange(COUNT), rng.integers(0, 3, COUNT)] = 1.0
    u = rng.uniform(-spread, spread, (2 * COUNT, 3))
    return sides, normal, np.full(COUNT, 1e-4), in_rows(u), in_rows(np.zeros((COUNT, 3)))


def softening_pair(spread: float) -> tuple:
    """(ours, by hand) over the same contacts, each with its own history."""
    geometry = contacts(spread)
    limit = np.full(COUNT, INTERFACE.tensile_strength / INTERFACE.normal_stiffness)
    state = fresh(limit.copy(), np.full(COUNT, 167e9), uplift=False, gap=False, run=False)
    opened, whole, slip = limit.copy(), np.ones((COUNT, 2)), np.zeros((COUNT, 3))
    shape = Exponential(*ENERGIES)
    numbers = (167e9, 69.6e9, 0.1e6, 0.15e6, 1.0, 0.7265, *ENERGIES)

    def ours():
        sweep(None, shape, INTERFACE, state, 0, COUNT, *geometry)

    def by_hand():
        exponential_contacts(*numbers, *geometry, opened, whole, slip)

    return ours, by_hand


def require(value: float, limit: float, what: str) -> None:
    """Fail with a sentence."""
    assert value <= limit, f"{what}: {value:.2f} times the reference, the gate is {limit:.2f}"


def test_elastic_contacts_cost_what_a_hand_written_loop_costs(benchmark):
    geometry = contacts(1e-7)
    interface = Interface(167e9, 69.6e9)

    def ours():
        sweep(None, Elastic(), interface, ContactState(), 0, COUNT, *geometry)

    ours()
    benchmark(ours)
    value = ratio(ours, lambda: elastic_contacts(167e9, 69.6e9, *geometry))
    benchmark.extra_info["ratio"] = value
    require(value, 1.8, "elastic contacts")


@pytest.mark.parametrize(("spread", "limit"), [(1e-8, 1.5), (1e-5, 1.5)], ids=["untouched", "damaged"])
def test_softening_contacts_cost_what_the_same_law_by_hand_costs(benchmark, spread, limit):
    ours, by_hand = softening_pair(spread)
    ours()
    by_hand()
    benchmark(ours)
    value = ratio(ours, by_hand)
    benchmark.extra_info["ratio"] = value
    require(value, limit, "exponential contacts")


def stepper(name: str, overrides: list[str], ledger: bool = True, steps: int = 200):
    """A call that takes `steps` steps of a scene, with or without the energy ledger."""
    assembly = assemble(scene.load(name, overrides))
    model, gauge = assembly.model, np.zeros(steps)
    if not ledger:
        model.bodies = tuple(None if b is None else b._replace(work=None) for b in model.bodies)
    timeloop.compile_for(model, 1)
    chunk = Chunk(assembly.plan.dead_load[: steps + 1], assembly.plan.speed[: steps + 1], row=False)

    def take():
        timeloop.advance_model(model, chunk, 1, 0, steps, gauge)

    return take, model


def test_the_energy_ledger_costs_less_than_a_third_of_a_step(benchmark):
    with_ledger, _ = stepper("wallette-mode-1", [])
    without, _ = stepper("wallette-mode-1", [], ledger=False)
    benchmark(with_ledger)
    value = ratio(with_ledger, without)
    benchmark.extra_info["ratio"] = value
    require(value, 1.33, "a step with the energy ledger")


def allocations(steps: int) -> int:
    """How often the compiled code asks for memory in one call of `steps` steps."""
    take, _ = stepper("wallette-mode-1", [], steps=steps)
    take()
    _nrt_python.memsys_enable_stats()
    before = rtsys.get_allocation_stats().alloc
    take()
    return rtsys.get_allocation_stats().alloc - before


def test_a_step_allocates_nothing():
    few, many = allocations(10), allocations(1000)
    assert few == many, f"10 steps make {few} allocations, 1000 steps make {many}: a step must make none"


def test_a_tet_costs_a_small_multiple_of_a_contact(benchmark):
    take, model = stepper("couplet", ["kinematics=tets", "specimen.mesh_size=8 mm"], steps=50)
    tets = len(model.bodies[2].corner)
    geometry = contacts(1e-7)
    benchmark(take)
    value = ratio(take, lambda: elastic_contacts(167e9, 69.6e9, *geometry)) / 50 / tets * COUNT
    benchmark.extra_info["ratio"] = value
    require(value, 8.0, "a whole step per tet, over one hand-written elastic contact")
