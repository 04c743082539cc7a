"""Blocks whose meshes do not match at their joints: a uniform stress passes exactly, a bent one with h^2.

      ______ ______ ______
     |_|_|_|__|__|_|_|_|_|  -> sigma        patch: u_x = sigma x/E + (joints passed) sigma/kn, u_y = -nu sigma y/E
     |_|_|_|__|__|_|_|_|_|  ->              joint: every overlap of two triangles has points of its own
     |_|_|_|__|__|_|_|_|_|

The contact points lie in the common refinement of the two faces, three in each piece, so tractions that are linear
there are integrated exactly and the patch test holds to rounding (points at the nodes of one side alone would fail it,
with an error of the order h). A bent joint is only as good as the tets round it: two blocks as a short cantilever,
their cells 2:3 in size, against the same with faces that match.
"""

import numpy as np

from masonry.laboratory.result import Result
from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.scene_text import made_of_tets
from verification.fixtures.scene_text import run as run_text
from verification.fixtures.structured import row_of_boxes

MODULUS, POISSON, NORMAL, SHEAR, STRESS = 10e9, 0.2, 150e9, 70e9, 1e5
CUTS, HEIGHT, DEPTH = [0.0, 0.1, 0.22, 0.3], 0.1, 0.08
CELLS = [(2, 3, 3), (3, 2, 5), (2, 4, 3)]
COUNTS = (2, 4, 8, 16)

AT_REST = "[settle]\nsteps = 20000\n[solver]\ndamping = 0.3\nrows = 40\n"
ROLLER = '[[support]]\non = "box {box}.{face}-"\nfix = "{face}"\n'
PATCH = (
    made_of_tets(2000.0, MODULUS, POISSON, NORMAL, SHEAR)
    + AT_REST
    + ROLLER.format(box=0, face="x")
    + "".join(ROLLER.format(box=b, face=axis) for b in range(3) for axis in "yz")
    + f'[[traction]]\non = "box 2.x+"\nstress = {{ x = "{STRESS} Pa" }}\n'
)
BEAM = (
    made_of_tets(2000.0, MODULUS, 0.0, NORMAL, SHEAR)
    + AT_REST
    + f'[[support]]\non = "box 0.x-"\nfix = "all"\n[[traction]]\non = "box 1.x+"\nstress = {{ z = "{STRESS} Pa" }}\n'
)


def patch(findings: Findings) -> None:
    """Three blocks in uniaxial tension between rollers."""
    specimen, mesh = row_of_boxes(CUTS, CELLS, DEPTH, HEIGHT, HEIGHT * DEPTH)
    result = findings.note("patch", run_text(PATCH, None, specimen, mesh))
    strain, box = STRESS / MODULUS, np.repeat(np.arange(3), np.diff(mesh.node_start))
    exact = mesh.nodes * strain * np.array([1.0, -POISSON, -POISSON])
    exact[:, 0] += box * STRESS / NORMAL
    moved = result.history.frames[-1].nodes
    worst = int(np.argmax(np.abs(moved - exact).max(axis=1)))
    tolerance = Tolerance(
        1e-12, 1e-14, "exact in principle: what is left is how far the run has come to rest, and rounding"
    )
    value = np.abs(moved - exact)[worst].max()
    findings.check("displacement, the worst node", "m", value, 0.0, tolerance, scale=np.abs(exact).max())


def beam(cells: int, other: int) -> tuple[float, Result]:
    """Deflection (m) of the tip of two blocks with so many cells over the height."""
    specimen, mesh = row_of_boxes([0.0, 0.1, 0.2], [(cells, 1, cells), (other, 1, other)], 0.05, 0.1, 0.005)
    result = run_text(BEAM, {"settle.steps": 1500 * max(cells, other)}, specimen, mesh)
    tip = np.abs(mesh.nodes[:, 0] - 0.2) < 1e-9
    return float(result.history.frames[-1].nodes[tip, 2].mean()), result


def run() -> Findings:
    """The patch, and the ladder of beams."""
    findings = Findings()
    patch(findings)
    values: list[float] = []
    matching: list[float] = []
    for n in COUNTS:
        for other, sequence in ((3 * n // 2, values), (n, matching)):
            value, result = beam(n, other)
            findings.note(f"{n} and {other} cells over the height", result)
            sequence.append(value)
    limits = [sequence[-1] + (sequence[-1] - sequence[-2]) / 3 for sequence in (values, matching)]
    errors = [np.abs(np.array(sequence) / limits[1] - 1) for sequence in (values, matching)]
    tolerance = Tolerance(
        0.05,
        0.02,
        "8:12 and 16:24 cells over the height against the limit of faces that match; tets of constant strain are of "
        "second order, and points in the common refinement take nothing from it",
        "converged run",
    )
    findings.check("order of the error in h", "1", np.log2(errors[0][-2] / errors[0][-1]), 2.0, tolerance)
    tolerance = Tolerance(
        5e-4, 1e-4, "faces that match tend to the same; the difference is of the order h^4", "converged run"
    )
    findings.check("deflection extrapolated by h^2", "m", limits[0], limits[1], tolerance)
    cells = np.array(COUNTS, dtype=float)
    findings.plot(
        "Error of the deflection of two blocks",
        "cells over the height of the coarser block (1)",
        "error (1)",
        Line("n : 3n/2", cells, errors[0], "points"),
        Line("n : n", cells, errors[1], "dashed"),
        log=True,
    )
    return findings


CASE = Case(
    name="faces-that-do-not-match",
    row="A2",
    title="Faces that do not match",
    area="Elastic assemblies",
    run=run,
    problems=("cantilever-tets",),
)
