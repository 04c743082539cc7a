"""A torn contact that stands open and slides: the residual cohesion that its faces still have.

    opening ^     kappa .--.            torn to kappa, closed to e, slid there until the cohesion of the cone is gone:
            |          /    \\___ e ->   tau = c_res (1 - d e/kappa) - sigma tan_res
            |_________/__________ slip  d = 1 - f(kappa)/f_T lost in tension if both modes share it, else 0;
                                        sigma = f(kappa) e/kappa (independent), 0 where slip has taken it (combined)

Linear law, of which nothing is left at the end: at e = kappa, half and a tenth of it, at e = 0 and under compression.

Reference: the rule of the errata, "torn faces lose the residual cohesion as they open, and find it again on closing".
"""

from verification.case import Case, Findings
from verification.fixtures.one_contact import along, law, walk
from verification.fixtures.single_tension import ROUNDING, UM
from verification.references.closed_forms import Joint, tension

JOINT = Joint(c_res=0.2e6)
WIDEST = (10 * UM, 40 * UM)
FRACTIONS = (1.0, 0.5, 0.1, 0.0)
PRESSED = 1e-6
FAR = 1e-3


def slid(kappa: float, e: float, coupling: str) -> float:
    """Shear stress (Pa) at the end of the path."""
    chosen = law("linear", residual_cohesion=JOINT.c_res, coupling=coupling)
    corners = [(0, 0, 0), (0, 0, kappa), (0, 0, e), (FAR, 0, e)]
    return float(walk(chosen, along(corners, 0.5 * UM)).tau[-1])


def run() -> Findings:
    """Partly and wholly torn contacts, at some openings."""
    findings = Findings()
    for kappa in WIDEST:
        left = float(tension("linear", JOINT, kappa))
        for fraction in FRACTIONS:
            e = fraction * kappa
            lost = JOINT.c_res * (1.0 - (1.0 - left / JOINT.fT) * fraction)
            alone = JOINT.c_res - left * fraction * JOINT.tan_res
            for coupling, wanted in (("combined", lost), ("independent", max(alone, 0.0))):
                where = f"torn to {kappa / UM:g} um, at {fraction:g} of it, {coupling}"
                value = slid(kappa, e, coupling)
                findings.check(f"shear stress, {where}", "Pa", value, wanted, ROUNDING, scale=JOINT.c_res)
        wanted = JOINT.c_res + JOINT.kn * PRESSED * JOINT.tan_res
        quantity = f"shear stress, torn to {kappa / UM:g} um, pressed"
        findings.check(quantity, "Pa", slid(kappa, -PRESSED, "combined"), wanted, ROUNDING)
    return findings


CASE = Case(
    "residual-cohesion-of-open-faces",
    "2.2",
    "Residual cohesion of faces that stand open",
    area="Contact laws",
    run=run,
    quick=True,
    no_problems="one contact point, driven by displacement: exact at any setting",
)
