"""Motion: the time step up to its bound and beyond, the rate of the drive, and ten million steps."""

import math
import time
from functools import cache, partial
from typing import Any

import numpy as np

from masonry.assembly.assemble import assemble
from masonry.configuration.chunk import Chunk
from masonry.loading.scheduled import Program
from masonry.timeloop import compiled_step
from verification.scene_runs import SceneRun, joint_of, load
from verification.stability.cells import Exact, Grid, MapCell
from verification.stability.references import torn
from verification.stability.scenes import CHAIN, Knobs, chain_of

BLOCKS = 6
LONG = chain_of((0.1,) * BLOCKS)
REAL: Knobs = {**LONG, "solver.masses": "real", "solver.rows": 200}
SIDEWAYS = ["x", "y", "rotation"]
GUIDED = [{"on": "end", "fix": "all"}, {"on": "top", "fix": SIDEWAYS}] + [
    {"on": f"b{k}", "fix": SIDEWAYS} for k in range(1, BLOCKS - 1)
]
SWINGING: Knobs = {**chain_of((0.1,) * 3), "solver.masses": "real", "solver.damping": 0}
DAMPING: dict[str, Knobs] = {"damping 0.8": {}, "damping 0": {"solver.damping": 0}}


def fractions(full: bool) -> Grid:
    """The time step over its proven bound, which for free blocks lies below the true limit."""
    step_fractions = (0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 1.0, 1.1, 1.2) if full else (0.9,)
    cells = {}
    for row, damping in DAMPING.items() if full else list(DAMPING.items())[:1]:
        for step_fraction in step_fractions:
            must = ("OK", "WARNED") if step_fraction <= 1.0 else ()
            knobs = {
                **REAL,
                **damping,
                "solver.step_fraction": step_fraction,
                "drive.steps": round(18000 / step_fraction),
            }
            cells[row, f"{step_fraction:g}"] = MapCell(CHAIN, knobs, torn, must)
    return Grid("Time step over the proven bound", "motion", "step fraction", cells)


def true_limits(full: bool) -> Grid:
    """The time step over the limit itself, known in closed form where blocks can move along the chain alone."""
    step_fractions = (0.5, 0.9, 0.99, 1.01, 1.02, 1.05, 1.1, 1.2, 2.0, 5.0) if full else (0.99, 1.05)
    cells = {}
    for row, damping in DAMPING.items() if full else list(DAMPING.items())[:1]:
        guided = {**REAL, **damping, "support": GUIDED}
        bound = assemble(load(CHAIN, guided)).model.bound
        limit = limit_of_chain(guided, 0.8 if row == "damping 0.8" else 0.0)
        for step_fraction in step_fractions:
            must = ("OK", "WARNED") if step_fraction < 1.0 else ("STOPPED",)
            knobs = {"solver.step_fraction": step_fraction * limit / bound, "drive.steps": round(18000 / step_fraction)}
            cells[row, f"{step_fraction:g}"] = MapCell(CHAIN, {**guided, **knobs}, torn, must)
    note = "Limit: 2/w over sqrt(1 + xi), w = 2 sqrt(k/m) cos(pi/(2 n + 2)) for n free blocks between two held ones."
    return Grid("Time step over the true limit", "motion", "time step over the limit", cells, note=note)


def limit_of_chain(knobs: Knobs, damping: float) -> float:
    """s, of equal blocks of 0.1 m that can move along z alone."""
    loaded = load(CHAIN, knobs)
    stiffness, mass = loaded.contact["unit_unit"].normal_stiffness * 0.01, loaded.material["units"].density * 1e-3
    fastest = 2.0 * math.sqrt(stiffness / mass) * math.cos(math.pi / (2 * (BLOCKS - 2) + 2))
    return 2.0 / fastest / math.sqrt(1.0 + damping)


def rates(full: bool) -> Grid:
    """The rate of the drive: too fast a one must be called so."""
    times = (1, 3, 10, 30, 100, 300, 1000) if full else (10, 1000)
    cells = {}
    for row, damping in DAMPING.items() if full else list(DAMPING.items())[:1]:
        for factor in times:
            knobs = {**REAL, **damping, "drive.rate": f"{factor:g} mm/s"}
            cells[row, f"x{factor}"] = MapCell(CHAIN, knobs, torn)
    return Grid("Rate", "motion", "rate over 1 mm/s", cells)


def endurance(full: bool) -> Grid:
    """One free block on its springs, undamped, for up to ten million steps."""
    counts = (10**4, 10**5, 10**6, 10**7) if full else (10**4,)
    cells = {
        (row, f"{count:.0e}"): MapCell(CHAIN, SWINGING, compare, ("OK",), partial(swing, count))
        for count in counts
        for row, compare in (("energy", _energy), ("place", _place))
    }
    note = (
        "Energy: the largest change of v(n-1/2) M v(n+1/2)/2 + k q^2/2 at any of 1000 looks. Place: against the exact "
        "solution of the leapfrog scheme, whose steps turn the phase by arccos(1 - (w dt)^2/2)."
    )
    return Grid("Ten million steps", "quantity", "steps", cells, "exact solution of the scheme", note)


@cache
def swing(count: int) -> SceneRun:
    """The free block starts with a velocity; `count` steps without loads, looked at about a thousand times."""
    model = assemble(load(CHAIN, SWINGING)).model
    body = model.bodies.rigid
    free = int(np.flatnonzero(body.dt_over_mass[:, 2])[0])
    mass = model.masses["rigid"][free, 2]
    stiffness = 2.0 * joint_of(CHAIN, SWINGING).kn * 0.01
    body.v[free, 2] = speed = 1e-4
    looks = min(1000, count // 10)
    each = count // looks
    plan = Program(np.zeros(each + 1), np.zeros(each + 1), 0, 0)
    chunk, one = Chunk(plan.dead_load, plan.speed, False), Chunk(np.zeros(2), np.zeros(2), False)
    compiled_step.compile_for(model, 1)
    energies, begun = np.zeros(looks), time.perf_counter()
    for k in range(looks):
        compiled_step.advance_model(model, chunk, 1, 0, each - 1, np.zeros(each))
        before = body.v[free, 2]
        compiled_step.advance_model(model, one, 1, 0, 1, np.zeros(1))
        energies[k] = 0.5 * mass * before * body.v[free, 2] + 0.5 * stiffness * body.q[free, 2] ** 2
    seconds = time.perf_counter() - begun
    phase = math.acos(1.0 - 0.5 * stiffness / mass * model.dt**2)
    reach = speed * model.dt / math.sin(phase)
    exact = reach * math.sin(phase * count)
    rows = {"energy": energies, "place": np.array([body.q[free, 2], exact, reach])}
    summary: dict[str, Any] = {"steps": count, "energy_imbalance": float(np.ptp(energies) / energies.mean())}
    needed = {"reaction_mismatch_max": 0.0, "kinetic_over_internal_max": 0.0}
    return SceneRun(CHAIN, SWINGING, rows=rows, summary=summary | needed, times=[seconds])


def _energy(one: SceneRun) -> dict[str, Exact]:
    energies = one.rows["energy"]
    worst = energies[np.argmax(np.abs(energies - energies[0]))]
    return {"energy": Exact(float(worst), float(energies[0]))}


def _place(one: SceneRun) -> dict[str, Exact]:
    place, exact, reach = one.rows["place"]
    return {"place": Exact(float(place), float(exact), float(reach))}


GRIDS = (fractions, true_limits, rates, endurance)
