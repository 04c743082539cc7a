"""One contact that slides, turns back, and slides the other way, under constant compression.

    tau        ___
              /   \\___ 80 um        back along k_s to -tau(80 um), then on along the mirrored envelope from there
       ______/_______/____ u
            /       /
      _____/_______/

Strength lost one way is lost the other way: the envelope goes on with the slip beyond the strength left. A loop
dissipates its area: D of the envelope at 80 um + 160 um - 2 tau/k_s on returning to -80 um.

Reference: by hand from eqs (8), (13), (15), (17) of the paper.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.single_shear import slid
from verification.fixtures.single_tension import UM
from verification.references.closed_forms import Joint, dissipated_in_shear, shear

JOINT = Joint()
COMPRESSION = 0.5e6
LAWS = ("linear", "polynomial", "exponential")


def run() -> Findings:
    """Stress on the way back, and the area of the loop."""
    findings, lines = Findings(), []
    us0 = float(JOINT.peak(COMPRESSION)) / JOINT.ks
    for name in LAWS:
        top = float(shear(name, JOINT, 80 * UM, COMPRESSION))
        walked = slid(name, COMPRESSION, us0, 80 * UM, -80 * UM, -120 * UM)
        x = walked.path[:, 0]
        reversal, again = int(np.argmax(x)), int(np.argmin(np.abs(x + 80 * UM)))
        slides_back = 80 * UM - 2.0 * top / JOINT.ks
        reached = 80 * UM + np.maximum(slides_back - x, 0.0)
        back = top - JOINT.ks * (80 * UM - x)
        wanted = np.where(x >= slides_back, back, -shear(name, JOINT, reached, COMPRESSION))[reversal:]
        off = float(np.abs(walked.stress[reversal:, 0] - wanted).max())
        loop = float(dissipated_in_shear(name, JOINT, reached[again], COMPRESSION))
        slid_on = np.concatenate([x[: reversal + 1], [80 * UM], reached[reversal:][reached[reversal:] > 80 * UM]])
        slid_on = slid_on[: reversal + 2 + int(np.sum(reached[reversal : again + 1] > 80 * UM))]
        trapezoid = float(np.trapezoid(shear(name, JOINT, slid_on, COMPRESSION), slid_on))
        trapezoid += 0.5 * JOINT.ks * x[0] ** 2
        trapezoid -= 0.5 * float(shear(name, JOINT, reached[again], COMPRESSION)) ** 2 / JOINT.ks
        expected = abs(trapezoid - loop) / loop
        rough = expected > 1e-13
        reason = "three times the error of the trapezoid along the envelope"
        tolerance = Tolerance(1e-12, 1e-14, "the same straight lines and envelope: rounding")
        findings.check(f"stress after the turn, {name}, largest deviation", "Pa", off, 0.0, tolerance, scale=top)
        tolerance = Tolerance(3 * expected if rough else 1e-12, expected if rough else 1e-14, reason)
        findings.check(f"dissipated in the loop, {name}", "J/m2", walked.dissipated[again], loop, tolerance)
        lines.append(Line(name, 1e6 * x, 1e-6 * walked.stress[:, 0]))
    findings.plot("Slip that turns back", "slip (um)", "shear stress (MPa)", *lines)
    return findings


CASE = Case(
    "slip-reversal",
    "2.2",
    "One contact that slides forth and back",
    area="Contact laws",
    run=run,
    quick=True,
    no_problems="one contact point, driven by displacement: exact at any setting",
)
