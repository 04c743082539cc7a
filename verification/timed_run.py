"""A trial: one scene run with some knobs set, which never raises; and the record that a report keeps of it."""

import json
import math
import statistics
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from geometry.blocks import GeometryError, Specimen
from masonry import __version__, scene
from masonry.errors import SceneError, Stopped
from masonry.jit.sources import source_hash
from masonry.laboratory import laboratory
from verification.fixtures.scene_text import loaded

Knobs = Mapping[str, Any]
SPENT = ("fracture_mode_1", "fracture_mode_2", "friction")
QUANTITIES = {"peak": "Pa", "final": "Pa", "residual": "Pa", "dissipated": "J"}
MISMATCH, KINETIC = 0.02, 0.01
"""Beyond these shares of the peak and of the internal energy a run is not quasi-static, and says so itself."""


@dataclass
class Trial:
    """What came of a scene: status OK, STOPPED, REFUSED or NOT FINITE; the reason; summary and rows (SI) of the run.

    times    seconds of stepping of each repeat; the compile is apart
    title    what to call it where `case` is TOML text
    threads  that it ran on
    """

    case: str
    knobs: dict[str, Any]
    status: str = "OK"
    reason: str = ""
    summary: dict[str, Any] = field(default_factory=dict)
    rows: dict[str, np.ndarray] = field(default_factory=dict)
    times: list[float] = field(default_factory=list)
    title: str = ""
    threads: int = 1

    @property
    def name(self) -> str:
        """Of the scene, short."""
        return self.title or Path(self.case).stem

    @property
    def seconds(self) -> float:
        """The least of the repeats: what else the machine did only ever adds."""
        return min(self.times, default=math.nan)

    @property
    def ok(self) -> bool:
        return self.status == "OK"

    @property
    def quasi_static(self) -> bool:
        """Both ends carry the same force, and hardly any energy is in motion: the run's own measures.

        Each is also open to the user in summary.json.
        """
        return bool(
            self.summary["reaction_mismatch_max"] < MISMATCH and self.summary["kinetic_over_internal_max"] < KINETIC
        )

    def value(self, quantity: str) -> float:
        """Peak and final stress (Pa), or the energy dissipated by fracture and friction (J)."""
        if quantity == "dissipated":
            return float(sum(self.summary["energy_j"][key] for key in SPENT))
        return float(self.summary["peak_stress_pa" if quantity == "peak" else "final_stress_pa"])


DONE: dict[str, Trial] = {}
"""Every trial so far: the same one asked twice runs once."""


def run(
    case: str,
    knobs: Knobs | None = None,
    timed: bool = False,
    title: str = "",
    specimen: Callable[[], Specimen] | None = None,
) -> Trial:
    """Run a scene (a packaged one's name, or TOML text) with overrides by dotted key; THREADS is a knob beside them.

    Timed: runs of less than REPEATED seconds are made three times, for a steadier time. `specimen` makes the blocks of
    a text that says kind = "file", path = "made.blocks.h5".
    """
    knobs = dict(knobs or {})
    key = json.dumps([case, knobs], sort_keys=True)
    if key not in DONE:
        DONE[key] = _once(case, knobs, specimen)
        DONE[key].title = title
    trial = DONE[key]
    while timed and trial.ok and len(trial.times) < REPEATS and trial.seconds < REPEATED:
        trial.times += _once(case, knobs, specimen).times
    return trial


REPEATS, REPEATED = 3, 2.0
THREADS = "threads"


def load(case: str, knobs: Knobs) -> scene.Scene:
    """The scene of a packaged name, or of TOML text. Raises SceneError."""
    with _opened(case, knobs, None) as found:
        return found


@contextmanager
def _opened(case: str, knobs: Knobs, specimen: Callable[[], Specimen] | None) -> Iterator[scene.Scene]:
    """The scene, as long as the file of its specimen is there."""
    if "\n" not in case:
        yield scene.load(case, knobs)
        return
    with loaded(case, knobs, specimen() if specimen else None) as found:
        yield found


def _once(case: str, knobs: dict[str, Any], specimen: Callable[[], Specimen] | None) -> Trial:
    keys = {key: value for key, value in knobs.items() if key != THREADS}
    trial = Trial(case, keys, threads=knobs.get(THREADS, 1))
    try:
        with _opened(case, keys, specimen) as found:
            result = laboratory.run(found, trial.threads)
    except (SceneError, GeometryError) as refused:
        trial.status, trial.reason = "REFUSED", str(refused)
        return trial
    except Stopped as stopped:
        trial.status, trial.reason, result = "STOPPED", str(stopped), stopped.result
    trial.summary, trial.rows = result.summary, result.history.rows
    trial.times.append(float(trial.summary["seconds_run"]))
    if not (all(np.isfinite(v).all() for v in trial.rows.values()) and _finite(trial.summary)):
        trial.status, trial.reason = "NOT FINITE", trial.reason or "the results hold NaN or infinity"
    return trial


def _finite(value: Any) -> bool:
    if isinstance(value, dict):
        return all(map(_finite, value.values()))
    return not isinstance(value, float) or math.isfinite(value)


def record(trial: Trial, quantity: str, value: float, reference: float, kind: str, scale: float = 0.0) -> dict:
    """One line of records.json; the signed error is relative to `scale`, or to the reference where none is given."""
    size = abs(scale or reference)
    error = (value - reference) / size if size else math.nan
    steps = trial.summary.get("steps")
    return {
        "case": trial.name,
        "quantity": quantity,
        "unit": QUANTITIES.get(quantity.split()[0], "1"),
        "value": _or_none(value),
        "reference": _or_none(reference),
        "kind_of_reference": kind,
        "error": _or_none(error),
        "seconds": _or_none(trial.seconds),
        "seconds_median": statistics.median(trial.times) if trial.times else None,
        "seconds_max": max(trial.times, default=None),
        "steps": steps,
        "knobs": trial.knobs,
        "threads": trial.threads,
        "status": trial.status,
        "reason": trial.reason,
        "energy_imbalance": trial.summary.get("energy_imbalance"),
        "kinetic_over_internal": trial.summary.get("kinetic_over_internal_max"),
        "unbalanced": trial.summary.get("unbalanced_after_settling"),
        "source_hash": source_hash(),
        "version": __version__,
    }


def _or_none(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
