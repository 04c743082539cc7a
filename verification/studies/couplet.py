"""The couplet against its closed form: laws x confinements x kinematics, the whole curve."""

import itertools
import math
from collections.abc import Callable

import numpy as np

from verification import timed_run
from verification.convergence.joint_in_shear import exact_stress, exact_values
from verification.html import figures, page
from verification.scene_runs import SceneRun

ORDER = 10
LAWS = ("linear", "polynomial", "exponential")
CONFINEMENTS = ("0.1 MPa", "0.5 MPa", "1.0 MPa")
KINEMATICS = ("rigid", "affine", "tets")
FINE = {"drive.steps": 40000}
TOLERANCE = {"peak": 1e-3, "residual": 1e-3, "curve": 5e-3, "dissipated": 1e-3}
WORDS = {"peak": "peak", "residual": "final stress", "curve": "whole curve", "dissipated": "dissipated energy"}


def errors(run: SceneRun) -> tuple[dict[str, tuple[float, float, float]], tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """(quantity -> (value, reference, scale), (slip m, tau Pa, closed form Pa) at the rows).

    The curve's value is its largest distance from the closed form, in shares of the peak.
    """
    exact = exact_values(run)
    moving = run.rows["displacement"] > 0.0
    slip, tau = run.rows["displacement"][moving], run.rows["stress"][moving]
    closed = exact_stress(run.scene, run.knobs, slip)
    error = float(np.abs(tau - closed).max() / exact["peak"])
    quantities = {
        "peak": (run.value("peak"), exact["peak"], 0.0),
        "residual": (run.value("final"), exact["final"], 0.0),
        "curve": (error, 0.0, 1.0),
        "dissipated": (run.value("dissipated"), exact["dissipated"], 0.0),
    }
    return quantities, (slip, tau, closed)


def chapter(
    tell: Callable[[str], None],
    laws: tuple[str, ...] = LAWS,
    confinements: tuple[str, ...] = CONFINEMENTS,
    kinematics: tuple[str, ...] = KINEMATICS,
    quick: bool = False,
) -> page.Chapter:
    """All combinations (quick: of rigid units): a picture of the curves, a table of the errors, and the verdict."""
    made = page.Chapter("Couplet against closed forms")
    worst = dict.fromkeys(TOLERANCE, 0.0)
    panels: dict[str, list[tuple[str, np.ndarray, np.ndarray, np.ndarray]]] = {}
    rows: list[list[str | page.TableCell]] = []
    for law, motion, confinement in itertools.product(laws, kinematics[:1] if quick else kinematics, confinements):
        tell(f"couplet: {law}, {motion}, {confinement}")
        run = timed_run.run("couplet", {"law": law, "kinematics": motion, "confinement": confinement, **FINE})
        rows.append([law, motion, confinement])
        if not run.ok:
            worst = dict.fromkeys(TOLERANCE, math.inf)
            rows[-1].append(page.judged(run.status, False, page.short(run.reason)))
            continue
        quantities, (slip, tau, closed) = errors(run)
        for name, (value, reference, scale) in quantities.items():
            entry = timed_run.record(run, name, value, reference, "closed form", scale)
            made.records.append(entry)
            error = abs(entry["error"])
            worst[name] = max(worst[name], error)
            rows[-1].append(page.judged(page.percent(entry["error"]), error <= TOLERANCE[name]))
        rows[-1].append(f"{run.seconds:.2g} s")
        if motion == kinematics[0]:
            panels.setdefault(law, []).append((confinement, 1e3 * slip, 1e-6 * tau, 1e-6 * closed))
    header = ["law", "units", "confinement", *(f"{w} (limit {page.percent(TOLERANCE[k])})" for k, w in WORDS.items())]
    caption = f"Shear stress against slip, {kinematics[0]} units: the run as a line, the closed form as dots."
    made.add(
        INTRODUCTION,
        page.picture(figures.curves(panels), caption) if panels else "",
        page.table([*header, "stepping"], rows, "Signed error against the closed form; curve: largest."),
    )
    holds = all(worst[name] <= limit for name, limit in TOLERANCE.items())
    said = ", ".join(f"{words} {page.percent(worst[name])}" for name, words in WORDS.items())
    sentence = f"Couplet, {len(rows)} combinations of law, confinement and kinematics; largest errors: {said}."
    made.judge("Closed forms", holds, sentence)
    return made


INTRODUCTION = (
    "Two units with one joint: confined first, then the upper unit slides. Under constant confinement the joint's "
    "shear stress is known in closed form at every slip: up with the stiffness ks to c0 + sigma tan(phi0), then down "
    "the law's softening curve to the residual friction. The scene moves the upper unit and holds the lower one as a "
    "whole, so that units that can deform have no shear of their own to subtract; their slip is the drive's "
    "displacement."
)
