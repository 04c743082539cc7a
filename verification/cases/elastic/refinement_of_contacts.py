"""More contact points in a joint that is torn from one side: peak and work tend to those of the continuous joint.

          ________________
         |          ^ w   |     two rigid blocks, the upper one pulled beside the middle of the joint, free to turn
         |__________|_____|     and to move sideways: opening u(x) = w + phi (x - a), P = B integral of sigma(u) dx,
         |////////|             integral of sigma(u) (x - a) dx = 0
         |////////|
         <-  b  ->              sigma(u): exponential softening, eq. (16); compression kn u; unloading to the origin

The reference integrates the envelope, written again in verification.references.closed_forms, over 500 fibres and finds
phi for each w. Gauss-Legendre points are exact while the joint is elastic; sigma(u) has a kink at its peak, which
leaves an error between the first and the second order in 1/n.
"""

import numpy as np
from scipy.optimize import brentq

from verification.case import Case, Findings, Line, Tolerance
from verification.references.closed_forms import Floats, Joint, tension
from verification.scene_runs import result_of

BREADTH, DEPTH, ECCENTRICITY, PULL = 0.1, 0.05, 0.02, 60e-6
JOINT = Joint(kn=150e9, ks=70e9, fT=0.5e6, c0=0.75e6, G_I=8.0)
COUNTS = (2, 4, 8, 16, 32)
FIBRES = 500
SCENE = "joint-torn-from-one-side"


def continuous(pulled: Floats) -> Floats:
    """(n,) N: force at each displacement (m) of the upper block's middle, which only grows."""
    x = BREADTH * (np.arange(FIBRES) + 0.5) / FIBRES - (0.5 * BREADTH + ECCENTRICITY)
    widest, phi = np.full(FIBRES, JOINT.opening_at_peak), 0.0
    part, forces = BREADTH * DEPTH / FIBRES, []

    def stress(opening: Floats) -> Floats:
        secant = tension("exponential", JOINT, widest) / widest
        back = np.where(opening > 0, secant, JOINT.kn) * opening
        return np.where(opening > widest, tension("exponential", JOINT, opening), back)

    for w in pulled:

        def moment(rotation: float, w: float = w) -> float:
            return float(np.sum(stress(w + rotation * x) * x))

        step = 1e-7
        low, high = phi - step, phi + step
        while moment(low) * moment(high) > 0:
            low, high = low - step, high + step
        phi = brentq(moment, low, high, xtol=1e-16, rtol=1e-14)
        opening = w + phi * x
        forces.append(part * float(np.sum(stress(opening))))
        widest = np.maximum(widest, opening)
    return np.array(forces)


def run() -> Findings:
    """The ladder against the continuous joint."""
    findings = Findings()
    pulled = np.linspace(0.0, PULL, 401)
    force = continuous(pulled)
    peak, work = float(force.max()), float(np.trapezoid(force, pulled))
    runs = {
        n: findings.note(f"{n} points along the joint", result_of(SCENE, {"specimen.points_per_edge.x": n}))
        for n in COUNTS
    }
    peaks = np.array([r.summary["peak_stress_pa"] for r in runs.values()]) * BREADTH * DEPTH
    works = np.array([r.history.rows["contact_work"][-1] for r in runs.values()])
    tolerance = Tolerance(
        3e-3,
        1e-3,
        "the kink of the law at its peak passes over the points one by one: 7, 3, 0.9, 0.3 and 0.1 % from 2 to 32",
        "refined model",
    )
    findings.check("peak force, 32 points", "N", peaks[-1], peak, tolerance)
    tolerance = Tolerance(1e-2, 2e-3, "the catalogue allows 2 % between the last two", "converged run")
    findings.check("peak force, 32 points over 16", "1", peaks[-1] / peaks[-2], 1.0, tolerance)
    tolerance = Tolerance(1e-3, 1e-4, "ups and downs of points that pass the peak cancel in the work", "refined model")
    findings.check("work of the joint, 32 points", "J", works[-1], work, tolerance)
    errors = ", ".join(f"{n}: {e:.2%}" for n, e in zip(COUNTS, peaks / peak - 1, strict=True))
    findings.remarks.append(f"error of the peak by points along the joint: {errors}")
    lines = [
        Line(f"{n} points", runs[n].history.rows["displacement"], runs[n].history.rows["stress"] * BREADTH * DEPTH)
        for n in (2, 8, 32)
    ]
    findings.plot("Force", "w (m)", "P (N)", *lines, Line("continuous joint", pulled, force, "dashed"))
    return findings


CASE = Case(
    name="refinement-of-contacts",
    row="A24",
    title="More contact points in a joint torn from one side",
    area="Fracture",
    run=run,
    quick=True,
    scene=SCENE,
    problems=("eccentric-joint",),
)
