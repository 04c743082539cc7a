"""Linear and polynomial softening, and damage of each mode on its own, against the interface model on the same tets.

The two courses in tension, where points open and slide at once, by each law; and by the exponential law with
`coupling = "independent"`: tension and cohesion are then lost each by its own envelope, D = dt for one and ds for the
other, as the equations of the paper stand.

A linear joint ends in a kink. Where the last points of the wall's joints come there, steps of the interface model have
an error of first order (1.6e-4 of the peak for one step to each place, 1e-4 for two, 5e-5 for four), so it makes eight.
"""

from functools import partial

from verification.case import Case, Findings
from verification.cases.fracture.wallette_of_two_courses import PLACES, SCENE, conditions
from verification.checks.beside_pair import Allowed, compare
from verification.scene_runs import assembled

VARIANTS: dict[str, dict[str, object]] = {
    "linear": {"law": "linear"},
    "polynomial": {
        "law": "polynomial",
        "contact.unit_unit.exponent_tension": 3.0,
        "contact.unit_unit.exponent_shear": 2.5,
    },
    "independent": {"contact.unit_unit.coupling": "independent"},
}


def run() -> Findings:
    """Curves and nodes by each variant."""
    findings = Findings()
    smooth = Allowed(elastic=(1e-9, 1e-8), softening=(1e-5, 5e-5), nodes=(1e-7, 1e-6))
    kinked = Allowed(elastic=(1e-9, 1e-8), softening=(3e-5, 1e-4), nodes=(1e-6, 1e-5))
    for name, keys in VARIANTS.items():
        allowed, parts = {"linear": (kinked, 8), "polynomial": (kinked, 16)}.get(name, (smooth, 1))
        make = partial(assembled, SCENE, keys)
        compare(findings, f"two courses, {name}", make, conditions, PLACES, allowed, 3000, 1000, parts)
    return findings


CASE = Case(
    "other-laws-of-tets",
    "A7",
    "Linear, polynomial and uncoupled softening, against the interface model on the same tets",
    area="Fracture",
    run=run,
    problems=("two-courses-of-tets",),
)
