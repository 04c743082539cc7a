"""A slender block under half a sine of ground acceleration: the pulse that just overturns it.

    a ^  .-.      q = w_p/p, p^2 = 3 g/(4 R), tan(alpha) = b/h
      | /   \\     it lifts off at a = g tan(alpha), leans away from the pulse, and falls before it comes down again
      +-------> t
    Small angles and a pulse x = a_p/(g alpha):  x exp(-(pi - asin(1/x))/q) + sqrt(x^2 - 1) = q

Here the equation is the exact one, integrated on its own (`verification/references/rocking.py`); at alpha = 0.25 rad it
gives 1.3213, 1.8015 and 2.2974 g tan(alpha) at q = 1, 2 and 3. Just below the threshold the block stands nearly on its
corner: what tells the two apart is the last half a per cent of the pulse.

Reference: Housner (1963), Bulletin of the Seismological Society of America 53, 403; Shi, Anooshehpoor, Zeng and Brune
(1996), ibid. 86, 1364.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.references.rocking import RockingBlock, rock
from verification.scene_runs import result_of

SCENE = "block-under-a-pulse"
BLOCK = RockingBlock(0.5 * 0.79495, 0.5 * 3.11327, 0.9)
KNOWN = {1.0: 1.3213, 2.0: 1.8015, 3.0: 2.2974}
STANDARD = 9.80665
SPAN, HALVINGS = 0.02, 4
AFTER = 3.5
"""s after the pulse, in which a block that is as near to its threshold as these has made up its mind."""


def pulse_length(q: float) -> float:
    """s, half a period."""
    return float(np.pi / (q * BLOCK.p))


def threshold(q: float) -> float:
    """Of the exact equation, in g tan(alpha)."""
    length = pulse_length(q)
    time = np.linspace(0.0, length, 400)
    low, high = 1.0, 4.0
    while high - low > 1e-4:
        middle = 0.5 * (low + high)
        pulse = middle * BLOCK.g * np.tan(BLOCK.alpha) * np.sin(np.pi * time / length)
        fallen = rock(BLOCK, time, pulse, length + 2.0 * AFTER).peak > 1.2 * BLOCK.alpha
        low, high = (low, middle) if fallen else (middle, high)
    return 0.5 * (low + high)


def run() -> Findings:
    """Both ends of the bracket, halved."""
    findings = Findings()
    lines = []
    for q, known in KNOWN.items():
        wanted, length = threshold(q), pulse_length(q)
        reason = "the last digit that is printed, and the end of the bisection"
        value = abs(wanted - known)
        findings.at_most(f"q = {q:g}: threshold of the equation off the number that is known", "1", value, 2e-4, reason)
        low, high = (1.0 - SPAN) * wanted, (1.0 + SPAN) * wanted
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            keys = {
                "ground.x": f"1 g * sin(pi t / {length!r} s)",
                "ground.duration": f"{length!r} s",
                "ground.scale": float(middle * np.tan(BLOCK.alpha) * BLOCK.g / STANDARD),
                "solver.duration": f"{length + AFTER!r} s",
            }
            rows = findings.note(f"q = {q:g}, {middle:.4f}", result_of(SCENE, keys)).history.rows
            fallen = float(np.abs(rows["sway"]).max()) > 2.0 * BLOCK.half_width
            lines.append(Line(f"q = {q:g}, {middle:.3f}", rows["time"], rows["sway"]))
            low, high = (low, middle) if fallen else (middle, high)
        tolerance = Tolerance(1e-2, 2e-3, "the bracket, and the stiffness of the floor", "converged run")
        findings.check(f"q = {q:g}: pulse that overturns, in g tan(alpha)", "1", 0.5 * (low + high), wanted, tolerance)
    findings.plot("Sway of the top", "time (s)", "sway (m)", *lines)
    return findings


CASE = Case(
    "pulse-that-overturns",
    "A48",
    "Half a sine of ground acceleration overturns a slender block",
    area="Dynamics",
    run=run,
    scene=SCENE,
    no_problems="a threshold, halved",
)
