"""The joint pulled open from one side, on grids of tets, against quadratic tets and Gauss points.

The specimen of `eccentric-tension`, each block divided into 2n x n x n bricks of six tets. A run is its own
discretisation of the joint and the blocks, to more digits than matter here; what is left is the error of that
discretisation: linear tets too stiff in bending, and joints lumped at vertices. Both fall as h^2, at the peak as in the
elastic range. The clamped base and the driven side have corners where stress is singular, far from the joint.

Tier 2 stands for the truth with n = 4; with n = 2 its first stiffness is 1.1 % higher. As that falls nearly by the
second power, what it is still off itself is a fifth of the error of the finer run, at most.
"""

import numpy as np

from geometry.blocks import Specimen, TetMesh
from geometry.polyhedra.construct import from_boxes
from verification.case import Case, Findings, Line, Tolerance
from verification.cases.fracture.eccentric_tension import HIGH, LENGTH, SCENE, conditions
from verification.checks import increments
from verification.checks.beside_pair import follow
from verification.checks.paired_run import law_of
from verification.references.interface.mesh import grids
from verification.references.interface.model import model
from verification.scene_runs import assembled

Array = np.ndarray
WIDTH = 0.05
PLACES = np.linspace(0.0, 20e-6, 21)[1:].tolist()
BRICKS = (4, 8)
ELASTIC = 3
"""Number of the place at which the joint is still sound in all of them."""


def lines(cells: int, low: float) -> tuple[Array, Array, Array]:
    """Planes (m) of the bricks of a block that begins at z = low."""
    across = np.linspace(0.0, WIDTH, cells + 1)
    return np.linspace(0.0, LENGTH, 2 * cells + 1), across, np.linspace(low, low + HIGH, cells + 1)


def made(cells: int) -> tuple[Specimen, TetMesh]:
    """Both blocks and their tets, for a run."""
    body = grids([lines(cells, 0.0), lines(cells, HIGH)])
    nodes, tets = body.mesh.p.T, body.mesh.t.T.astype(np.int64)
    owner = np.zeros(len(nodes), dtype=np.int64)
    owner[tets] = body.block[:, None]
    order = np.argsort(owner, kind="stable")
    tets, nodes = np.argsort(order)[tets], nodes[order]
    over = np.linalg.det(nodes[tets[:, 1:]] - nodes[tets[:, :1]]) < 0
    tets[over] = tets[over][:, [1, 0, 2, 3]]
    starts = [np.searchsorted(of, np.arange(3)) for of in (owner[order], body.block)]
    low = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, HIGH]])
    blocks = from_boxes(low, low + [LENGTH, WIDTH, HIGH], np.arange(2), np.zeros(2), ("units",))
    sets = {"lower": np.array([0]), "upper": np.array([1])}
    return Specimen(blocks, sets, LENGTH * WIDTH), TetMesh(nodes, starts[0], tets, starts[1])


def run() -> Findings:
    """First stiffness and peak of runs on two grids."""
    findings = Findings()
    specimen = {cells: assembled(SCENE, None, *made(cells)) for cells in BRICKS}
    material, contact = (getattr(specimen[BRICKS[0]].scene, key) for key in ("material", "contact"))
    law = law_of(contact["unit_unit"])
    units = material["units"]
    fine = model(
        grids([lines(4, 0.0), lines(4, HIGH)]), units.young_modulus, units.poisson_ratio, lambda a, b: law, degree=2
    )
    conditions(fine)
    truth = follow(fine, PLACES)[0] / (LENGTH * WIDTH)
    curves = [Line("quadratic tets", np.array(PLACES) * 1e6, truth / 1e6, "dashed")]
    errors = []
    for cells, assembly in specimen.items():
        result = findings.note(f"{cells} bricks", increments.run(assembly, PLACES, move=1500, wait=1000))
        stress = result.history.rows["stress"][1:]
        curves.append(Line(f"run, {cells} bricks in height", np.array(PLACES) * 1e6, stress / 1e6))
        errors.append((stress[ELASTIC] / truth[ELASTIC] - 1.0, stress.max() / truth.max() - 1.0))
        for what, value, reference, scale in (
            ("elastic stress", stress[ELASTIC], truth[ELASTIC], 1.2),
            ("peak", stress.max(), truth.max(), 0.5),
        ):
            tolerance = Tolerance(
                1.5 * scale / cells**2,
                scale / cells**2,
                "too stiff in bending by 1.2/n^2 for n bricks, of which the peak feels less than half",
                "refined model",
            )
            findings.check(f"{what}, {cells} bricks in a block's height", "Pa", value, reference, tolerance)
    for k, what in enumerate(("elastic stress", "peak")):
        tolerance = Tolerance(0.2, 0.1, "h^2, from below while bricks are few", "refined model")
        findings.check(f"order of the error, {what}", "1", np.log2(errors[0][k] / errors[1][k]), 2.0, tolerance)
    findings.plot("Joint pulled open from one side", "displacement (um)", "stress (MPa)", *curves)
    return findings


CASE = Case(
    "eccentric-tension-refined",
    "A7",
    "Eccentric tension through softening, against quadratic tets",
    area="Fracture",
    run=run,
    scene=SCENE,
    problems=("eccentric-tension",),
)
