"""Timed runs: a scene run with some knobs set, once for all who ask; and the record that a report keeps of it."""

import json
import math
import statistics
from typing import Any

from verification import scene_runs
from verification.records import finite
from verification.scene_runs import SceneRun, Settings

QUANTITIES = {"peak": "Pa", "final": "Pa", "residual": "Pa", "dissipated": "J"}
REPEATS, REPEATED = 3, 2.0
THREADS = "threads"
DONE: dict[str, SceneRun] = {}
"""Every timed run so far, without its frames: the same one asked twice runs once."""


def run(scene: str, knobs: Settings | None = None, timed: bool = False) -> SceneRun:
    """Run a scene with overrides by dotted key; THREADS is a knob beside them. Never raises what the program refuses.

    Timed: runs of less than REPEATED seconds are made three times, for a steadier time.
    """
    key = json.dumps([scene, knobs or {}], sort_keys=True)
    if key not in DONE:
        DONE[key] = _once(scene, knobs or {})
    one = DONE[key]
    while timed and one.ok and len(one.times) < REPEATS and one.seconds < REPEATED:
        one.times += _once(scene, knobs or {}).times
    return one


def _once(scene: str, knobs: Settings) -> SceneRun:
    keys: dict[str, Any] = {key: value for key, value in knobs.items() if key != THREADS}
    one = scene_runs.run(scene, keys, threads=knobs.get(THREADS, 1))
    one.result = None
    return one


def record(one: SceneRun, quantity: str, value: float, reference: float, kind: str, scale: float = 0.0) -> dict:
    """One line of records.json; the signed error is relative to `scale`, or to the reference where none is given."""
    size = abs(scale or reference)
    error = (value - reference) / size if size else math.nan
    steps = one.summary.get("steps")
    return {
        "case": one.name,
        "quantity": quantity,
        "unit": QUANTITIES.get(quantity.split()[0], "1"),
        "value": finite(value),
        "reference": finite(reference),
        "kind_of_reference": kind,
        "error": finite(error),
        "seconds": finite(one.seconds),
        "seconds_median": statistics.median(one.times) if one.times else None,
        "seconds_max": max(one.times, default=None),
        "steps": steps,
        "knobs": one.knobs,
        "threads": one.threads,
        "status": one.status,
        "reason": one.reason,
        "energy_imbalance": one.summary.get("energy_imbalance"),
        "kinetic_over_internal": one.summary.get("kinetic_over_internal_max"),
        "unbalanced": one.summary.get("unbalanced_after_settling"),
    }
