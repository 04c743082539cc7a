"""One contact whose slip turns by 90 degrees, without softening.

    y |   | path        The stress stays on the cone, |t| = T, and turns after the slip: t = T (cos a, sin a) with
      |   |             a' = (k_s/T) cos(a), so that  a(y) = 2 atan(tanh(k_s y/(2 T))).
      |___|             It is parallel to the increment of plastic slip at every step.
        60 um   x

The return to the cone is implicit, of first order in the step.

Reference: perfect plasticity on a circle, by hand; eq. (8) of the paper.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.one_contact import Walk, along, law, walk
from verification.fixtures.single_tension import UM
from verification.references.closed_forms import Joint

JOINT = Joint(c_res=0.87e6, tan_res=1.01)
COMPRESSION = 0.5e6
STRENGTH = JOINT.c0 + COMPRESSION * JOINT.tan0


def turned(most: float) -> tuple[Walk, np.ndarray]:
    """The path round the corner in steps of `most` (m), and which points are beyond the corner."""
    z = -COMPRESSION / JOINT.kn
    corners = [(0.0, 0.0, z), (60 * UM, 0.0, z), (60 * UM, 100 * UM, z)]
    trace = walk(law("linear", residual_cohesion=0.87e6, tan_residual_friction=1.01), along(corners, most))
    return trace, trace.path[:, 1] > 0.0


def run() -> Findings:
    """Size and direction of the stress after the corner, and the order of the latter."""
    findings, off = Findings(), []
    for most in (0.2 * UM, 0.1 * UM, 0.05 * UM):
        walked, beyond = turned(most)
        y = walked.path[beyond, 1]
        angle = 2 * np.arctan(np.tanh(JOINT.ks * y / (2 * STRENGTH)))
        had = np.arctan2(walked.stress[beyond, 1], walked.stress[beyond, 0])
        off.append(float(np.abs(had - angle).max()))
    slipped, stress = np.diff(walked.slip[:, :2], axis=0), walked.stress[1:, :2]
    moving = beyond[1:]
    cross = slipped[:, 0] * stress[:, 1] - slipped[:, 1] * stress[:, 0]
    size = np.hypot(*slipped.T) * np.hypot(*stress.T)
    skew = float(np.abs(cross[moving] / size[moving]).max())
    first = 0.05 * UM * JOINT.ks / STRENGTH
    tolerance = Tolerance(1e-12, 1e-14, "the return ends on the cone: rounding")
    value = np.abs(walked.tau[beyond] - STRENGTH).max()
    findings.check("|t| beyond the corner, largest deviation", "Pa", value, 0.0, tolerance, scale=STRENGTH)
    tolerance = Tolerance(5e-12, 1e-13, "a difference of slips of 0.05 um in 100 um: rounding")
    findings.check("sine of the angle from slip to stress, largest", "1", skew, 0.0, tolerance, scale=1.0)
    tolerance = Tolerance(
        first, 0.3 * first, "a step turns the stress by up to k_s du/T; an implicit step of first order errs by less"
    )
    findings.check("direction of the stress, largest deviation", "rad", off[2], 0.0, tolerance, scale=1.0)
    tolerance = Tolerance(0.02, 5e-3, "implicit step: the next term is du k_s/T of it")
    findings.check("order of the direction in du", "1", np.log2(off[1] / off[2]), 1.0, tolerance)
    x = 1e6 * y
    some = slice(0, None, 50)
    lines = (Line("contact", x, had), Line("closed form", x[some], angle[some], "points"))
    findings.plot("Direction of the stress after the corner", "slip along y (um)", "angle (rad)", *lines)
    return findings


CASE = Case(
    "slip-direction",
    "2.2",
    "One contact whose slip turns by 90 degrees",
    area="Contact laws",
    run=run,
    quick=True,
    no_problems="one contact point, driven by displacement: the order in its step is in the case",
)
