"""One contact pressed to and fro and slid to and fro under pressure: its stiffness stays, and nothing heals.

    compression |     .-.   /'.          way back and forth by kn, whatever was crushed
                |   .'  /  /   '.        the curve goes on where it was left: as if it had never gone back
                |  /   /  /      '.      a closed cycle takes no less than nothing
                |_/___/__/________ closing

The joint is opened within each cycle, so that tension acts in between: it begins where the faces meet, which is nearer
by what has closed for good.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.checks.crushed_contact import AT_PEAK, CAP, CUT_OFF, FM, KN, closed_by, ours
from verification.fixtures.one_contact import Walk, along, walk
from verification.references.interface.crushing import Compression, bears

TURNS = np.array([0.5, 1.0, 3.0, 6.0, 10.0]) * AT_PEAK
"""m of closing, at which a cycle turns back."""
STEP = 2e-6
SLIP = 40e-6


def pressed(compression: Compression) -> tuple[Walk, list[int]]:
    """Closed ever further, and opened in between until nothing presses; with the places of the turns."""
    closing, turns = [0.0], []
    for turn in TURNS:
        turns.append(len(closing))
        closing += [float(turn), float(turn) - 0.2 * FM / KN, float(turn) - 0.8 * FM / KN, float(turn)]
    return walk(ours(compression), closed_by(np.array(closing))), turns


def whole(compression: Compression, closing: np.ndarray) -> np.ndarray:
    """Pa, of a contact that closes all the way: its strength at the k that belongs to the closing."""
    low, high = np.zeros_like(closing), closing.copy()
    for _ in range(200):
        middle = 0.5 * (low + high)
        more = middle + bears(compression, middle) / KN < closing
        low, high = np.where(more, middle, low), np.where(more, high, middle)
    return np.minimum(bears(compression, low), KN * closing)


def run() -> Findings:
    """Back and forth in compression; cycles of slip under a pressure that grows and falls."""
    findings, lines = Findings(), []
    for words, compression in (("cap", CAP), ("cut-off", CUT_OFF)):
        walked, turns = pressed(compression)
        at = np.array(turns)
        back = (walked.sigma[at] - walked.sigma[at + 1]) / (walked.path[at, 2] - walked.path[at + 1, 2])
        live = walked.sigma[at + 1] < 0.0
        tolerance = Tolerance(1e-9, 1e-10, "a straight line")
        quantity = f"{words}: stiffness on the way back, largest deviation"
        findings.check(quantity, "Pa/m", np.abs(back[live] - KN).max(), 0.0, tolerance, scale=KN)
        again = np.abs(walked.sigma[at] - walked.sigma[at + 3]).max()
        tolerance = Tolerance(1e-9, 1e-10, "nothing is lost on an elastic way")
        quantity = f"{words}: stress at the turns before and after the way back"
        findings.check(quantity, "Pa", again, 0.0, tolerance, scale=FM)
        off = np.abs(-walked.sigma[at] - whole(compression, TURNS)).max()
        tolerance = Tolerance(1e-9, 1e-10, "one step between two turns ends on the curve")
        findings.check(f"{words}: stress at the turns against that without cycles", "Pa", off, 0.0, tolerance, scale=FM)
        lines.append(Line(words, -1e3 * walked.path[:, 2], -1e-6 * walked.sigma))
    findings.plot("To and fro", "closing (mm)", "compression (MPa)", *lines)
    slides(findings)
    return findings


def slides(findings: Findings) -> None:
    """Cycles of slip while the joint is pressed, crushed further, and let go."""
    places = [(0.0, 0.0, 0.0)]
    for turn in 0.5 * TURNS:
        places += [(SLIP, 0.0, -turn), (-SLIP, 0.0, -turn), (0.0, SLIP, -0.7 * turn), (0.0, 0.0, 10e-6)]
    walked = walk(ours(CAP), along(places, STEP))
    modes, hardening = walked.dissipated_by_mode, walked.crushed
    assert hardening is not None
    reason = "nothing is given back"
    quantity = "dissipation of a mode in a step, taken back"
    findings.at_most(quantity, "J/m2", -np.diff(modes, axis=0).min(), 1e-10 * float(modes[-1].sum()), reason)
    reason = "what is crushed stays crushed"
    findings.at_most("hardening variable and closing, taken back", "m", -np.diff(hardening, axis=0).min(), 0.0, reason)
    beyond = np.hypot(np.minimum(walked.sigma, 0.0), 3.0 * walked.tau) - bears(CAP, hardening[:, 1])
    findings.at_most("stress beyond the cap", "Pa", beyond.max(), 1e-9 * FM, "a return ends on the cap or within")
    gap = np.abs(walked.gap).max() / float(modes[-1].sum())
    tolerance = Tolerance(5e-3, 1e-3, "of first order in the step of 2 um")
    findings.check("work less stored less dissipated", "1", gap, 0.0, tolerance, scale=1.0)


CASE = Case(
    "cycles-of-crushing",
    "A73",
    "One contact crushed to and fro",
    area="Contact laws",
    run=run,
    quick=True,
    no_problems="one contact point, driven by displacement: exact at any setting",
)
