"""Error against run time: which setting buys how much accuracy for which time, in each shipped scene."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from verification.studies import trial
from verification.studies.couplet import exact_values
from verification.studies.trial import Trial

QUANTITIES = {"peak": "peak stress", "dissipated": "dissipated energy"}
TARGET, FLOOR = 0.01, 1e-8
DRIVE, ACCURACY = "constant rate (steps or rate)", "accuracy (as shipped: 1 %)"


@dataclass(frozen=True)
class Reference:
    """A value, what kind it is, and how far it may be off (same unit)."""

    value: float
    kind: str
    uncertainty: float = 0.0


Rungs = dict[str, dict[str, Any]]
"""Label of a rung -> the knobs it sets; the finest last."""


def paces(factors: tuple[float, ...], key: str, usual: float, unit: str = "") -> Rungs:
    """Rungs of a constant rate: `factors` times as fast as `usual`."""
    faster = {f: usual * f if unit else round(usual / f) for f in factors}
    return {f"x{f:g}": {key: f"{v:g}{unit}" if unit else v} for f, v in faster.items()}


def fractions(extra: dict[str, Any]) -> Rungs:
    """Rungs of the step, as shares of the proven bound."""
    return {f"{f:g}": {"solver.step_fraction": f, **extra} for f in (1.0, 0.9, 0.6, 0.3)}


def motions(mesh: str, extra: dict[str, Any]) -> Rungs:
    """Rungs of how the units move."""
    tets: dict[str, Any] = {"kinematics": {"units": "tets"}, "specimen.mesh_size": mesh}
    given: Rungs = {"rigid": {"kinematics": "rigid"}, "affine": {"kinematics": {"units": "affine"}}, "tets": tets}
    return {label: {**knobs, **extra} for label, knobs in given.items()}


def cells(sizes: tuple[tuple[int, ...], ...], extra: dict[str, Any]) -> Rungs:
    """Rungs of the grid of a unit."""
    return {"x".join(map(str, d)): {"specimen.divisions": list(d), **extra} for d in sizes}


def accuracies() -> Rungs:
    """Rungs of a drive that is paced by its error."""
    return {f"{percent:g} %": {"drive.accuracy": f"{percent:g} %"} for percent in (5, 2, 1, 0.5)}


SHORT, ALL = (8.0, 4.0), (8.0, 4.0, 2.0, 1.0, 0.5)


def ladders(case: str, factors: tuple[float, ...] = ALL) -> dict[str, Rungs]:
    """Knob -> rungs of a shipped scene. Other knobs are climbed at a constant rate, in the wallettes at a quick one."""
    if case == "couplet":
        steps = {"drive.steps": 40000}
        return {
            DRIVE: paces(factors, "drive.steps", 40000.0),
            ACCURACY: accuracies(),
            "step fraction": fractions(steps),
            "kinematics": motions("25 mm", steps),
            "cells": cells(((1, 1, 1), (2, 1, 1), (4, 2, 2)), steps),
        }
    rate = 1.0 if case == "wallette-mode-1" else 0.5
    quick, quicker = {"drive.rate": f"{4 * rate:g} mm/s"}, {"drive.rate": f"{16 * rate:g} mm/s"}
    moved = motions("60 mm", quick)
    moved["tets (at x16)"] = {**moved.pop("tets"), **quicker}
    return {
        DRIVE: paces(factors, "drive.rate", rate, " mm/s"),
        ACCURACY: accuracies(),
        "step fraction": fractions(quick),
        "model: kinematics": moved,
        "model: cells": cells(((2, 1), (4, 2), (8, 4), (12, 6)), quick),
    }


def richardson(values: list[float], kind: str = "finest rung") -> Reference:
    """The finest of at least three rungs (each twice as fine), with 1.25 times its extrapolated error.

    The observed order is held between 0.5 and 2, so that two values that agree by luck do not promise too much.
    """
    coarse, middle, fine = values[-3:]
    step = abs(middle - fine)
    order = math.log2(abs(coarse - middle) / step) if step and coarse != middle else 2.0
    return Reference(fine, kind, 1.25 * step / (2.0 ** min(max(order, 0.5), 2.0) - 1.0))


def time_to(rungs: list[tuple[float, float, str]], target: float) -> tuple[float, str] | None:
    """Least seconds, and the label, of a rung that is within the target as are all finer ones: no lucky crossing."""
    good = []
    for rung in reversed(rungs):
        if not abs(rung[1]) <= target:
            break
        good.append(rung)
    return min((seconds, label) for seconds, _, label in good) if good else None


def study_scene(case: str, rungs: dict[str, Rungs], tell: Callable[[str], None]) -> tuple[dict, dict, list[dict]]:
    """Runs all rungs of a scene: (quantity -> reference), (knob -> label -> trial), records."""
    trials: dict[str, dict[str, Trial]] = {}
    for knob, ladder in rungs.items():
        tell(f"{case}: {knob}, {len(ladder)} rungs")
        trials[knob] = {label: trial.run(case, knobs, timed=True) for label, knobs in ladder.items()}
    drive = list(trials[DRIVE].values())
    if case == "couplet":
        references = {q: Reference(exact_values(drive[-1])[q], "closed form") for q in QUANTITIES}
    else:
        references = {q: richardson([t.value(q) for t in drive]) for q in QUANTITIES}
    records = []
    for knob, climbed in trials.items():
        for label, one in climbed.items():
            for q, reference in references.items():
                entry = trial.record(one, q, one.value(q) if one.ok else math.nan, reference.value, reference.kind)
                entry |= {"knob": knob, "rung": label, "reference_uncertainty": reference.uncertainty}
                records.append(entry)
    return references, trials, records


REFERENCE_RUNG = "x0.5"


def lines_of(records: list[dict], quantity: str) -> dict[str, list[tuple[float, float, str]]]:
    """Knob -> (seconds, error, rung) of the runs that came through, but for the one that is the reference itself."""
    found: dict[str, list[tuple[float, float, str]]] = {}
    for r in records:
        is_reference = r["kind_of_reference"] == "finest rung" and r["rung"] == REFERENCE_RUNG
        if r["quantity"] == quantity and r["error"] is not None and not is_reference:
            found.setdefault(r["knob"], []).append((r["seconds"], r["error"], r["rung"]))
    return found
