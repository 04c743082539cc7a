"""A cantilever of five blocks with elastic joints, loaded at its tip.

      |  P at the tip    w = P L^3/(3 E I) + P L/(kappa G A) + sum over joints at x_i of P (L - x_i)^2/(kn I) + P/(ks A)
    ##|____|____|____|____|____| |
    ##|____|____|____|____|____| v   Timoshenko (1921) with kappa = 5/6 for nu = 0, and the joints in series
      |<-        L           ->|

Constant-strain tets lock in bending: with n of them over the height they are too stiff by some 30 % (n = 2), falling
with h^2; joints with a point at each node are too stiff in bending by 2/n^2 as well. So the deflection itself is held
against one solve of the interface model, which has the same discretisation and is written apart from the program, and
theory against the order of the error and the limit extrapolated from the two finest meshes.
"""

import numpy as np

from geometry.blocks import TetMesh
from masonry.laboratory.result import Result
from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.scene_text import made_of_tets
from verification.fixtures.scene_text import run as run_text
from verification.fixtures.structured import row_of_boxes
from verification.references.interface.envelopes import Law
from verification.references.interface.mesh import solid
from verification.references.interface.model import model
from verification.references.interface.newton import EquilibriumPath

BLOCKS, LENGTH, HEIGHT, WIDTH = 5, 0.1, 0.1, 0.02
MODULUS, NORMAL, SHEAR, STRESS = 10e9, 150e9, 70e9, 1e4
COUNTS = (2, 4, 8, 16)
"""Tets over the height."""
STEPS = 5000
"""Steps for each of them: a beam with n over its height swings n times as slowly, counted in steps. With xi = 0.3 they
end within 1e-5 of rest; with the usual 0.8 the finest mesh still creeps, 0.1 to 0.7 % away."""

SCENE = f"""
{made_of_tets(2000.0, MODULUS, 0.0, NORMAL, SHEAR)}[[support]]
on = "box 0.x-"
fix = "all"
[[traction]]
on = "box {BLOCKS - 1}.x+"
stress = {{ z = "{-STRESS!r} Pa" }}
[settle]
steps = 1000
[solver]
damping = 0.3
rows = 40
"""


def theory() -> float:
    """Deflection of the tip, m."""
    force, length = STRESS * HEIGHT * WIDTH, BLOCKS * LENGTH
    area, second = HEIGHT * WIDTH, WIDTH * HEIGHT**3 / 12
    bulk = force * length**3 / (3 * MODULUS * second) + force * length / (5 / 6 * MODULUS / 2 * area)
    arms = length - LENGTH * np.arange(1, BLOCKS)
    return float(bulk + np.sum(force * arms**2 / (NORMAL * second) + force / (SHEAR * area)))


def at_once(mesh: TetMesh) -> np.ndarray:
    """(N, 3) m, displacements of the nodes by one solve of the interface model on the same mesh."""
    block, near = np.repeat(np.arange(BLOCKS), np.diff(mesh.tet_start)), 1e-9 * LENGTH
    beam = model(solid(mesh.nodes, mesh.tets, block), MODULUS, 0.0, lambda a, b: Law("elastic", NORMAL, SHEAR))
    beam.hold("xyz", lambda x, b: x[:, 0] < near)
    beam.load = beam.pressed((0.0, 0.0, -STRESS), lambda x: x[0] > BLOCKS * LENGTH - near)
    path = EquilibriumPath(beam)
    path.go(1.0)
    return beam.displacement(path.displacements())


def deflection(cells: int) -> tuple[float, float, Result]:
    """Mean deflection (m) of the loaded face, and that of the interface model."""
    n = round(cells * LENGTH / HEIGHT)
    cuts = list(LENGTH * np.arange(BLOCKS + 1))
    specimen, mesh = row_of_boxes(cuts, [(n, 1, cells)] * BLOCKS, WIDTH, HEIGHT, HEIGHT * WIDTH)
    result = run_text(SCENE, {"settle.steps": STEPS * max(cells, 10)}, specimen, mesh)
    still = at_once(mesh)
    tip = np.abs(mesh.nodes[:, 0] - BLOCKS * LENGTH) < 1e-9 * LENGTH
    moved = result.history.frames[-1].nodes
    return -float(moved[tip, 2].mean()), -float(still[tip, 2].mean()), result


def run() -> Findings:
    """The ladder of meshes, its order, and what it tends to."""
    findings, exact = Findings(), theory()
    values: list[float] = []
    same: list[float] = []
    for cells in COUNTS:
        value, still, result = deflection(cells)
        findings.note(f"{cells} tets over the height", result)
        values.append(value)
        same.append(value / still)
    worst = int(np.argmax(np.abs(np.array(same) - 1)))
    tolerance = Tolerance(
        3e-5,
        3e-6,
        "the same discretisation solved at once; what is left is how far the run has come to rest",
        "same discretisation",
    )
    quantity = f"deflection over that of the sparse solve, the farthest: {COUNTS[worst]} tets over the height"
    findings.check(quantity, "1", same[worst], 1.0, tolerance)
    errors = np.abs(np.array(values) / exact - 1)
    orders = np.log2(errors[:-1] / errors[1:])
    limit = values[-1] + (values[-1] - values[-2]) / 3
    for k, wrong in ((1, 0.15), (2, 0.06)):
        tolerance = Tolerance(
            3 * wrong / 2,
            wrong / 2,
            "constant-strain tets and joints with points at the nodes are of second order; the next order still adds "
            "a little",
        )
        findings.check(f"order of the error in h, {COUNTS[k]} and {COUNTS[k + 1]} tets", "1", orders[k], 2.0, tolerance)
    tolerance = Tolerance(
        2e-3, 6e-4, "a plane model of biquadratic elements tends to 0.06 % more than theory, which knows no warping"
    )
    findings.check("deflection extrapolated by h^2 from 8 and 16 tets", "m", limit, exact, tolerance)
    findings.remarks.append(
        "errors with "
        + ", ".join(f"{n}: {e:.1%}" for n, e in zip(COUNTS, -errors, strict=True))
        + " tets over the height"
    )
    findings.plot(
        "Error of the deflection",
        "tets over the height (1)",
        "error (1)",
        Line("masonry", np.array(COUNTS, dtype=float), errors, "points"),
        Line("h^2", np.array(COUNTS, dtype=float), errors[-1] * (16 / np.array(COUNTS)) ** 2, "dashed"),
        log=True,
    )
    return findings


CASE = Case(
    name="cantilever",
    row="A5",
    title="A cantilever of five blocks",
    area="Elastic assemblies",
    run=run,
    problems=("cantilever-rigid", "cantilever-tets"),
)
