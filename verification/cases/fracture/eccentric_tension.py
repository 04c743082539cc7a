"""A joint pulled open from one side: the run against the interface model on the same tets.

           ______________
          |              |^
          |    upper     |^  the nodes of this side move up together, free along x and y
          |______________|^
          |======joint===|      exponential law; the crack runs from right to left, and the upper block turns
          |    lower     |
          |______________|
           ////////////// held

Tets with contacts at their nodes are linear finite elements with a joint lumped at the vertices of its facets, so the
two curves must be one. The interface model (scikit-fem, verification.references.interface) has its own envelopes,
pairing of facets and Newton's method; it shares the mesh alone. In the run the drive moves in smooth increments, and
waits.

Unloading along the secant makes tension a function of the largest opening so far: the curve does not depend on the
size of implicit steps where openings only grow.
"""

import numpy as np

from verification.case import Case, Findings
from verification.checks.beside_pair import Allowed, compare
from verification.references.interface.model import InterfaceModel
from verification.scene_runs import assembled

SCENE = "eccentric-tension"
PLACES = [*np.linspace(0, 8e-6, 9)[1:], *np.linspace(8e-6, 60e-6, 27)[1:]]
LENGTH, HIGH, NEAR = 0.1, 0.05, 1e-9


def conditions(model: InterfaceModel) -> None:
    """The base is held, a side of the upper block is moved up."""
    model.hold("xyz", lambda x, block: x[:, 2] < NEAR)
    model.drive("z", lambda x, block: (block == 1) & (x[:, 0] > LENGTH - NEAR))


def run() -> Findings:
    """Curve and nodes, before the first damage and through 94 % of the softening."""
    findings = Findings()
    allowed = Allowed(elastic=(3e-11, 3e-10), softening=(5e-6, 2e-5), nodes=(5e-6, 2e-5))
    compare(findings, "eccentric tension", lambda: assembled(SCENE), conditions, PLACES, allowed, move=2000, wait=1000)
    return findings


CASE = Case(
    "eccentric-tension",
    "A7",
    "Eccentric tension through softening, against the interface model on the same tets",
    area="Fracture",
    run=run,
    quick=True,
    scene=SCENE,
    problems=("eccentric-tension",),
)
