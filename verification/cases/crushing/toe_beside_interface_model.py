"""A joint pressed on one side until its toe crushes and its other side opens, beside the interface model.

           ______________
          |              ||  the nodes of this side move down together, free along x and y
          |    upper     ||
          |______________|v
          |======joint===|   cap: hardens, softens; on the left the joint opens and tears
          |    lower     |
          |______________|
           ////////////// held

One discretisation, two programs: linear tets and a joint lumped at the corners of its facets. The interface model
returns to cap and Coulomb line by a multiplier found together with the stress; the program by a share of the stress.

Between two places a point that crushes under shear follows a curve whose direction changes: an implicit step has an
error of first order there, so that several are made to each place.

The curve is within 3e-6 of the peak. Nodes are apart by 2e-5 of the way, and that is the interface model's: with four
times as many steps those of the run move by 3e-6; with 16, 32, 64 and 128 parts those of the model move by 0.8e-5,
4e-5 and 0.2e-5, all of it one tilt of the upper block, which a joint that softens at both ends hardly holds.
"""

import numpy as np

from verification.case import Case, Findings
from verification.checks.beside_pair import Allowed, compare
from verification.references.interface.model import InterfaceModel
from verification.scene_runs import assembled

SCENE = "toe-crushed"
PLACES = [*np.linspace(0, 10e-6, 6)[1:], *np.linspace(10e-6, 60e-6, 11)[1:]]
LENGTH, NEAR = 0.1, 1e-9


def conditions(model: InterfaceModel) -> None:
    """The base is held, a side of the upper block is moved down."""
    model.hold("xyz", lambda x, block: x[:, 2] < NEAR)
    model.drive("z", lambda x, block: (block == 1) & (x[:, 0] > LENGTH - NEAR), -1.0)


def run() -> Findings:
    """Curve and nodes, while the toe hardens, bears most, and softens."""
    findings = Findings()
    allowed = Allowed(elastic=(3e-11, 3e-10), softening=(2.5e-6, 1e-5), nodes=(2e-5, 6e-5))
    compare(
        findings,
        "toe",
        lambda: assembled(SCENE),
        conditions,
        PLACES,
        allowed,
        move=128000,
        wait=8000,
        parts=(32, 64),
    )
    return findings


CASE = Case(
    "toe-crushed",
    "A74",
    "A joint whose toe crushes, against the interface model on the same tets",
    area="Fracture",
    run=run,
    scene=SCENE,
    no_problems="implicit and explicit steps on one mesh: the error of either is in the case",
)
