"""Strengths that are drawn, and sizes of cells: their mean, spread and sum are those that were asked for.

    lognormal    value(z) of a standard normal z: mean and mean square by Gauss-Hermite quadrature over z, exact for
                 them to rounding: m and m^2 (1 + v^2);   the median is m/sqrt(1 + v^2)
    draws        a set of J joints: mean of the normals within 3/sqrt(J) of 0, mean square within 3 sqrt(2/J) of 1
    cells        areas proportional to the sizes given, and adding up to the unit; equal ones without sizes

Reference: Aitchison and Brown, The lognormal distribution; Abramowitz and Stegun 25.4.46.
"""

import numpy as np

from geometry.cells.request import CellRequest
from geometry.cells.targets import target_sizes
from geometry.polyhedra.measures import volumes
from geometry.specimens.filling import fill_with_cells
from masonry.model.draws import PROPERTIES, correlated, lognormal, standard_normals
from verification.case import Case, Findings, Tolerance

MEAN, VARIATION, JOINTS, CELLS, MANY = 0.58e6, 0.25, 4000, 60, 400_000
CORRELATION = 0.4
SIZES = (1.0, 2.0, 3.0, 4.0, 5.0)
SIDES = (0.2, 0.05, 0.08)


def of_draws(findings: Findings) -> None:
    """Moments of the distribution, and of the normals that it is made of."""
    node, weight = np.polynomial.hermite_e.hermegauss(60)
    weight /= weight.sum()
    value = lognormal(MEAN, VARIATION, node)
    for name, unit, had, wanted in (
        ("mean", "Pa", weight @ value, MEAN),
        ("mean square", "Pa2", weight @ value**2, MEAN**2 * (1 + VARIATION**2)),
        ("median", "Pa", lognormal(MEAN, VARIATION, np.zeros(1))[0], MEAN / np.sqrt(1 + VARIATION**2)),
    ):
        tolerance = Tolerance(1e-12, 1e-14, "a quadrature that is exact here: rounding")
        findings.check(f"lognormal: {name}", unit, had, wanted, tolerance)
    pairs = np.column_stack([np.arange(JOINTS), np.arange(JOINTS) + 1])
    normals = standard_normals(7, "unit_unit", pairs)
    count = np.sqrt(normals.size)
    value = abs(normals.mean()) * count
    findings.at_most("draws: mean of the normals, over its standard error", "1", value, 3.0, "three standard errors")
    quantity = "draws: mean square of the normals less 1, over its standard error"
    findings.at_most(quantity, "1", abs((normals**2).mean() - 1.0) * count / np.sqrt(2.0), 3.0, "three standard errors")
    one, other = correlated(normals, PROPERTIES[:2], CORRELATION).values()
    had = np.corrcoef(one, other)[0, 1]
    error = (1.0 - CORRELATION**2) / np.sqrt(JOINTS)
    quantity = "draws: correlation of two properties off what was asked for, over its standard error"
    findings.at_most(quantity, "1", abs(had - CORRELATION) / error, 3.0, "three standard errors")


def of_cells(findings: Findings) -> None:
    """Volumes of the cells of one unit, as in the list of sizes: of given sizes, of equal ones, and a spread."""
    low, high, whole = np.zeros((1, 3)), np.array([SIDES]), float(np.prod(SIDES))
    off = []
    for relative, sizes in ((SIZES, SIZES), (None, (1.0,) * 5)):
        volume = volumes(fill_with_cells(low, high, CellRequest(per_unit=5, sizes=relative), "units")[0])
        off.append(np.abs(volume * sum(sizes) / (whole * np.array(sizes)) - 1.0).max())
    tolerance = Tolerance(1e-9, 1e-10, "Newton's method on the weights of the power diagram")
    quantity = "given and equal sizes: volumes of the cells, largest relative error"
    findings.check(quantity, "1", max(off), 0.0, tolerance, scale=1.0)
    request = CellRequest(total=CELLS, spread=VARIATION)
    volume = volumes(fill_with_cells(low, high, request, "units")[0])
    wished = target_sizes(request, np.array([MANY]), np.array([whole]), np.random.default_rng(3))
    error = VARIATION * np.sqrt((1.0 + 2.0 * VARIATION**2) / (2.0 * MANY))
    tolerance = Tolerance(1e-12, 1e-14, "cells fill the unit: rounding")
    findings.check("spread sizes: sum", "m3", volume.sum(), whole, tolerance)
    quantity = "spread sizes: coefficient of variation off what was asked for, over its standard error"
    findings.at_most(quantity, "1", abs(wished.std() / wished.mean() - VARIATION) / error, 3.0, "three standard errors")


def run() -> Findings:
    """Draws and cells."""
    findings = Findings()
    of_draws(findings)
    of_cells(findings)
    return findings


CASE = Case(
    "draws-and-sizes",
    "A24",
    "Drawn strengths and sizes of cells: means, spreads and sums",
    area="Quasi-static loading",
    run=run,
    quick=True,
    no_problems="geometry and draws alone: nothing is run",
)
