"""A couplet of tets sheared under 0.5 MPa, through its peak: the run against the interface model on the same mesh.

           v v v v v v v   0.5 MPa, dead
           ______________
     -->  |    upper     |   every node moves along x by the same, none along y, all are free along z
          |==============|   Table 1: exponential law, friction falls with the cohesion
          |    lower     |
          |______________|
           ////////////// held: it bends and shears, so that the joint is not stressed evenly

The share of the shear strength falls with the slip along the curve of the normal stress that acts: points whose normal
stress changes while they slip depend on the path, and a wide implicit step has an error of first order there: 7.6e-5 of
the peak with one step to each place, 1.9e-5 with 4, and 4.7e-6 with the 16 that are taken.
"""

import numpy as np

from verification.case import Case, Findings
from verification.checks.beside_pair import Allowed, compare
from verification.references.interface.model import InterfaceModel
from verification.scene_runs import assembled

SCENE = "couplet-of-tets"
PLACES = [*np.linspace(0, 20e-6, 6)[1:], *np.linspace(20e-6, 40e-6, 11)[1:], *np.linspace(40e-6, 200e-6, 17)[1:]]
HEIGHT, NEAR = 0.1, 1e-9


def conditions(model: InterfaceModel) -> None:
    """The base is held; the upper block moves along x, under a dead pressure."""
    model.hold("xyz", lambda x, block: x[:, 2] < NEAR)
    model.hold("y", lambda x, block: block == 1)
    model.drive("x", lambda x, block: block == 1)
    model.dead = model.pressed([0.0, 0.0, -0.5e6], lambda x: x[2] > HEIGHT - NEAR)


def run() -> Findings:
    """Curve and nodes, before the first damage and until half of the strength above the residual is gone."""
    findings = Findings()
    allowed = Allowed(elastic=(1e-14, 1e-12), softening=(3e-6, 1e-5), nodes=(3e-6, 1e-5))
    compare(
        findings,
        "couplet of tets",
        lambda: assembled(SCENE),
        conditions,
        PLACES,
        allowed,
        move=1000,
        wait=1000,
        parts=16,
    )
    return findings


CASE = Case(
    "couplet-of-tets",
    "A8",
    "Couplet in shear under 0.5 MPa, against the interface model on the same tets",
    area="Fracture",
    run=run,
    quick=True,
    scene=SCENE,
    problems=("couplet-of-tets",),
)
