"""Cost as the work grows: time and memory are linear in the blocks and tets, and set-up is a small part of a run.

The largest walls (50,000 blocks, a million tets) are run by `python -m benchmarks.giants`.
"""

import tracemalloc

import pytest

from benchmarks.growing import STEPS, Wall, growth, items, stepper
from masonry.assembly.assemble import assemble
from masonry.laboratory import laboratory
from verification.reference_step.interleaved import in_turn

LINEAR = 1.2
"""Largest exponent that passes for linear on a shared machine; the square root of the number more would be 1.5."""
CACHE = 2.5
"""How many times more a step may cost each where ten times as many no longer fit in the cache (measured: 1.4 to 2.0;
from 80,000 contact points to 400,000 it stays the same)."""
SETUP_LIMIT = 0.2
"""Largest share of a run that its set-up may take, without the compile."""

WALLS = {
    "rigid": [Wall(5, 2, (4, 2)), Wall(8, 8), Wall(25, 25)],
    "fan": [Wall(10, 5, mesh="fan"), Wall(32, 16, mesh="fan")],
    "gmsh": [Wall(4, 2, (4, 2), "20 mm"), Wall(4, 2, (4, 2), "6 mm")],
}
MIDDLING = {"rigid": [Wall(8, 8), Wall(20, 20)], "fan": [Wall(5, 3, mesh="fan"), Wall(16, 8, mesh="fan")]}
"""For what takes longer to measure."""
NAMES = {"rigid": "contact points", "fan": "tets, fans", "gmsh": "tets, gmsh"}


@pytest.mark.parametrize("kind", WALLS)
def test_set_up_and_step_grow_with_the_work_and_set_up_is_a_small_part(figure, kind):
    walls = WALLS[kind]
    assemblies = [assemble(wall.scene()) for wall in walls]
    numbers = [items(assembly) for assembly in assemblies]
    calls, counts = zip(*(stepper(assembly) for assembly in assemblies), strict=True)
    steps = [times.least / count for times, count in zip(in_turn(*calls, rounds=20), counts, strict=True)]
    setups = [
        in_turn(lambda w=wall: assemble(w.scene()), rounds=20 if number < 1000 else 2)[0].least
        for wall, number in zip(walls, numbers, strict=True)
    ]
    for number, setup, step in zip(numbers, setups, steps, strict=True):
        name = f"{number} {NAMES[kind]}"
        figure(f"{name}: set-up", setup, "s")
        figure(f"{name}: set-up over {STEPS} steps", 100 * setup / STEPS / step, "%", reach=100 * SETUP_LIMIT)
        figure(f"{name}: step", 1e9 * step / number, "ns")
    for number, setup, step in zip(numbers, setups, steps, strict=True):
        setup_fraction = setup / (STEPS * step)
        assert setup_fraction <= SETUP_LIMIT, (
            f"set-up of {number} {NAMES[kind]} takes {setup_fraction:.0%} of a run; the gate is {SETUP_LIMIT:.0%}"
        )
    power = growth(numbers[-2:], setups[-2:])  # the smallest is mostly what any wall costs
    assert power <= LINEAR, f"the time of set-up grows with power {power:.2f} of the {NAMES[kind]}; 1 is linear"
    dearer = steps[-1] / numbers[-1] / (steps[-2] / numbers[-2])
    assert dearer <= CACHE, f"a step costs {dearer:.2f} times as much each with more {NAMES[kind]}; the gate is {CACHE}"


@pytest.mark.parametrize("kind", ["rigid", "fan"])
def test_memory_of_set_up_grows_with_the_work(figure, kind):
    numbers, peaks = [], []
    for wall in MIDDLING[kind]:
        tracemalloc.start()
        numbers.append(items(assemble(wall.scene())))
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
        figure(f"{numbers[-1]} {NAMES[kind]}: memory of set-up at most", peaks[-1] / numbers[-1], "bytes each")
    power = growth(numbers, peaks)
    assert power <= LINEAR, f"the memory of set-up grows with power {power:.2f} of the {NAMES[kind]}; 1 is linear"


@pytest.mark.parametrize("kind", ["rigid"])
def test_output_grows_with_the_work(figure, kind, tmp_path):
    results = [laboratory.run(wall.scene("solver.rows=24")) for wall in MIDDLING[kind]]
    numbers = [len(r.joints.area) if r.mesh is None else len(r.mesh.tets) for r in results]
    taken = in_turn(*(lambda r=result: r.save(tmp_path) for result in results), rounds=2)
    times = [entry.least for entry in taken]
    for number, seconds, result in zip(numbers, times, results, strict=True):
        figure(f"{number} {NAMES[kind]}: output of {len(result.history.frames)} frames", seconds, "s")
    power = growth(numbers, times)
    assert power <= LINEAR, f"the time of output grows with power {power:.2f} of the {NAMES[kind]}; 1 is linear"
