"""A couplet under 3 MPa that crushes as it is sheared: cap and Coulomb line at once, beside the interface model.

           v v v v v v v   3 MPa, dead
           ______________
     -->  |    upper     |   every node moves along x by the same, none along y, all are free along z
          |==============|   cap with fm = 7 MPa: 3 MPa alone is beyond its first yield; shear brings it to its peak
          |    lower     |
          |______________|
           ////////////// held

The upper block sinks as the joint crushes under shear. Cohesion and friction stay, so that what softens is the cap.
The dead load alone makes it yield, with some shear at its ends, so the implicit steps of the load count too: with four
of them nodes are apart by 2e-5, however fine those of the drive are.
"""

import numpy as np

from verification.case import Case, Findings
from verification.checks.beside_pair import Allowed, compare
from verification.references.interface.model import InterfaceModel
from verification.scene_runs import assembled

SCENE = "couplet-crushed"
PLACES = [*np.linspace(0, 40e-6, 9)[1:], *np.linspace(40e-6, 200e-6, 9)[1:]]
HEIGHT, NEAR = 0.1, 1e-9


def conditions(model: InterfaceModel) -> None:
    """The base is held; the upper block moves along x, under a dead pressure."""
    model.hold("xyz", lambda x, block: x[:, 2] < NEAR)
    model.hold("y", lambda x, block: block == 1)
    model.drive("x", lambda x, block: block == 1)
    model.dead = model.pressed([0.0, 0.0, -3e6], lambda x: x[2] > HEIGHT - NEAR)


def run() -> Findings:
    """Curve and nodes."""
    findings = Findings()
    allowed = Allowed(elastic=(3e-11, 3e-10), softening=(1e-6, 1e-5), nodes=(1.5e-6, 1e-5))
    compare(
        findings,
        "couplet",
        lambda: assembled(SCENE),
        conditions,
        PLACES,
        allowed,
        move=4000,
        wait=4000,
        parts=(16, 32),
    )
    return findings


CASE = Case(
    "couplet-crushed",
    "A75",
    "A couplet crushed under shear and compression, against the interface model on the same tets",
    area="Fracture",
    run=run,
    scene=SCENE,
    no_problems="implicit and explicit steps on one mesh: the error of either is in the case",
)
