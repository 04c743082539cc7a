"""One contact opened and slid at once: what yields first, and the strength that is left.

    slip |        . cone  k_s x = c0 - k_n z tan0
         |     .    |
         |  path    | cut-off  k_n z = f_T      path: (x, z) = l (cos a, sin a), a = 0, 15 ... 90 degrees
         |/_________|__ opening

First yield at l = min(f_T/(k_n sin a), c0/(k_s cos a + k_n sin a tan0)). Beyond it the normal stress is at most the
envelope of pure tension, f(z), and the shear stress at most the cone times the share f(z)/f_T that this envelope
leaves: slip only takes from both. All the way the stresses are those of a joint that is integrated apart from the
program (`interface/points.py`), in which strength and normal stress hold at once; the program takes the normal stress
with the strength before the step, so the two differ by something of the order of the step. With independent coupling
the normal stress is f(z) whatever the slip. A contact torn to z and closed again bears under a compression s at most
t_res + f(z)/f_T (t_max - t_res), and t_max with independent coupling. Where the cone ends below the cut-off
(c0/tan0 < f_T), tension ends at its apex.

Reference: eqs (7), (8), (12) to (17) of the paper.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.one_contact import along, law, walk
from verification.fixtures.single_tension import ROUNDING, UM
from verification.fixtures.thresholds import threshold
from verification.references.closed_forms import Joint, tension
from verification.references.interface.envelopes import Law
from verification.references.interface.points import traction, unharmed

JOINT = Joint()
WEAK = 0.3e6
"""Pa: a cohesion whose cone ends below the cut-off."""
ANGLES = (0, 15, 30, 45, 60, 75, 90)
LAWS = ("linear", "polynomial", "exponential")
FAR, STEP = 60 * UM, 0.05 * UM
APART = {"linear": 2e-4, "polynomial": 4e-4, "exponential": 8e-4}
"""Of the cohesion: by how much the stresses of both integrations differ at this step."""


def by_points(name: str, paths: np.ndarray) -> np.ndarray:
    """(N, n, 3) Pa along n paths of slip and opening (N, n, 3) m, by the joint of the interface model."""
    properties = {
        key: getattr(JOINT, key) for key in ("kn", "ks", "fT", "c0", "tan0", "c_res", "tan_res", "G_I", "G_II")
    }
    joint = Law(name, **properties, G_II_slope=JOINT.G_II_slope, alpha=JOINT.alpha, beta=JOINT.beta)
    normal, history, stresses = np.tile([0.0, 0.0, 1.0], (paths.shape[1], 1)), unharmed(joint, paths.shape[1]), []
    for places in paths:
        stress, history = traction(joint, history, normal, places)
        stresses.append(stress)
    return np.array(stresses)


def softening(findings: Findings, name: str) -> None:
    """Along all paths at once: the strength left, and the stresses of the joint that is integrated apart."""
    directions = [np.array([np.cos(a), 0.0, np.sin(a)]) for a in np.radians(ANGLES)]
    paths = np.stack([along([(0, 0, 0), FAR * d], STEP) for d in directions], axis=1)
    walks = [walk(law(name), path) for path in paths.swapaxes(0, 1)]
    beyond = 0.0
    for walked in walks:
        opening = walked.path[:, 2]
        envelope = tension(name, JOINT, opening)
        left = np.where(opening > JOINT.opening_at_peak, envelope / JOINT.fT, 1.0)
        cone = left * np.maximum(JOINT.c0 - walked.sigma * JOINT.tan0, 0.0)
        beyond = max(beyond, *(walked.sigma - envelope), *(walked.tau - cone))
    apart = np.abs(np.stack([walked.stress for walked in walks], axis=1) - by_points(name, paths)).max()
    tolerance = Tolerance(1e-12, 1e-15, "the return ends on the cone: " + ROUNDING.reason)
    quantity = f"stress beyond the envelope of pure tension and its share of the cone, {name}"
    findings.check(quantity, "Pa", max(beyond, 0.0), 0.0, tolerance, scale=JOINT.fT)
    tolerance = Tolerance(3 * APART[name], APART[name], "of first order in the step of 0.05 um", "same discretisation")
    quantity = f"stresses against a joint integrated apart, {name}, largest deviation"
    findings.check(quantity, "Pa", apart, 0.0, tolerance, scale=JOINT.c0)


def alone(findings: Findings) -> None:
    """With independent coupling slip takes nothing from the tension."""
    chosen, off = law("linear", coupling="independent"), 0.0
    for angle in np.radians(ANGLES):
        walked = walk(chosen, along([(0, 0, 0), FAR * np.array([np.cos(angle), 0.0, np.sin(angle)])], STEP))
        off = max(off, float(np.abs(walked.sigma - tension("linear", JOINT, walked.path[:, 2])).max()))
    quantity = "normal stress with independent coupling, largest deviation"
    findings.check(quantity, "Pa", off, 0.0, ROUNDING, scale=JOINT.fT)


def closed_again(findings: Findings) -> None:
    """Largest shear of a torn contact under compression, short of the slip at which an intact one softens."""
    torn, s = 10 * UM, 0.5e6
    peak, residual = float(JOINT.peak(s)), float(JOINT.residual(s))
    fraction, z, slip = float(tension("linear", JOINT, torn)) / JOINT.fT, -s / JOINT.kn, 0.999 * peak / JOINT.ks
    for coupling, wanted in (("combined", residual + fraction * (peak - residual)), ("independent", JOINT.ks * slip)):
        path = along([(0, 0, 0), (0, 0, torn), (0, 0, z), (wanted / JOINT.ks, 0, z), (slip, 0, z)], STEP)
        tau = float(walk(law("linear", coupling=coupling), path).tau.max())
        quantity = f"largest shear stress of a torn contact under compression, {coupling}"
        findings.check(
            quantity, "Pa", tau, wanted, Tolerance(1e-12, 1e-14, "the return ends on the cone: " + ROUNDING.reason)
        )


def first_yield(chosen: tuple, direction: np.ndarray) -> float:
    """How far (m) a contact can go at once before anything but its springs answers."""

    def yields(far: float) -> bool:
        seen = walk(chosen, far * direction[None])
        return bool(seen.intact_n[0] < 1 or seen.intact_s[0] < 1 or seen.slip.any() or seen.dissipated[0] > 0)

    return threshold(yields, 0.0, 100 * UM, 60)[0]


def run() -> Findings:
    """First yield at each angle, the strength left beyond it, and the apex of the cone."""
    findings, stress, limit = Findings(), [], []
    for name in LAWS:
        chosen, worst = law(name), 0.0
        for angle in np.radians(ANGLES):
            c, s = float(np.cos(angle)), float(np.sin(angle))
            wanted = min(
                JOINT.fT / (JOINT.kn * s) if s > 0 else np.inf,
                JOINT.c0 / (JOINT.ks * c + JOINT.kn * s * JOINT.tan0),
            )
            direction = np.array([c, 0.0, s])
            had = first_yield(chosen, direction)
            worst = max(worst, abs(had / wanted - 1.0))
            stress.append((JOINT.kn * had * s, JOINT.ks * had * c))
            limit.append((JOINT.kn * wanted * s, JOINT.ks * wanted * c))
        tolerance = Tolerance(1e-12, 1e-14, "bisection of a comparison of stresses: rounding")
        findings.check(f"first yield, {name}, largest deviation over all angles", "1", worst, 0.0, tolerance, scale=1.0)
        softening(findings, name)
        apex = WEAK / JOINT.tan0
        weak = walk(law(name, cohesion=WEAK), along([(0, 0, 0), (0, 0, apex / JOINT.kn), (0, 0, 3 * UM)], 0.1 * UM))
        pulled = weak.sigma.max()
        tolerance = Tolerance(1e-12, 1e-15, "the path comes to the apex: rounding")
        findings.check(f"most tension, cone below the cut-off, {name}", "Pa", pulled, apex, tolerance)
    alone(findings)
    closed_again(findings)
    yields, wanted_at = 1e-6 * np.array(stress), 1e-6 * np.array(limit[: len(ANGLES)])
    lines = (
        Line("first yield", yields[:, 0], yields[:, 1], "points"),
        Line("cone and cut-off", wanted_at[:, 0], wanted_at[:, 1], "dashed"),
    )
    findings.plot("First yield", "normal stress (MPa)", "shear stress (MPa)", *lines)
    return findings


CASE = Case(
    "mixed-mode",
    "2.2",
    "One contact opened and slid at once",
    area="Contact laws",
    run=run,
    quick=True,
    no_problems="one contact point, driven by displacement: exact at any setting",
)
