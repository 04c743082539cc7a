"""Cells of the plane: seeds, sizes held by weights, short edges and short joint segments lengthened.

Lloyd's relaxation first; then limited-memory BFGS on the energy of plane_energy.py over sites and weights of all units
together, with thresholds that rise in two stages; then Newton's method on the weights alone, which sets the sizes
exactly (semi-discrete optimal transport).
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import OptimizeResult, minimize
from scipy.sparse import coo_array
from scipy.sparse.linalg import spsolve

from geometry.cells.plane_energy import MOST, Domains, PlaneTargets, energy, tessellate

STAGES = ((0.30, 0.25), (0.36, 0.30))
"""Thresholds of edges and of joint segments, in h, by stage; the first alone is enough for what users are promised."""
SIZES_MATTER = 30.0
RELAXATIONS = 20
EVALUATIONS = 800
ENOUGH = 1e-4
"""Energy at which a stage ends: no edge lacks more than a hundredth of its threshold."""
NEVER = 1e10


@dataclass
class PlaneDiagram:
    """A power diagram of n cells in units of h, and room for its corners (see plane_energy)."""

    domains: Domains
    site: np.ndarray
    weight: np.ndarray
    corner: np.ndarray
    label: np.ndarray
    count: np.ndarray

    def update(self) -> bool:
        """Cut all cells anew; whether none is empty."""
        enough = tessellate(self.site, self.weight, self.domains, self.corner, self.label, self.count)
        return enough and bool(np.all(self.count >= 3))

    def loop(self, i: int) -> np.ndarray:
        """(k, 2) corners of cell i, counter-clockwise."""
        return self.corner[i, : self.count[i]]


def plane_diagram(domains: Domains, site: np.ndarray) -> PlaneDiagram:
    """The Voronoi division of the domains by these sites (n, 2), in units of h."""
    n = len(site)
    room = np.zeros((n, MOST, 2)), np.zeros((n, MOST), dtype=np.int64), np.zeros(n, dtype=np.int64)
    return PlaneDiagram(domains, site.copy(), np.zeros(n), *room)


def areas_and_centroids(diagram: PlaneDiagram) -> tuple[np.ndarray, np.ndarray]:
    """(n,) and (n, 2), in units of h; an empty cell has its site for a centroid."""
    inside = np.arange(MOST) < diagram.count[:, None]
    after = np.where(np.arange(1, MOST + 1) < diagram.count[:, None], np.arange(1, MOST + 1), 0)
    a = diagram.corner - diagram.site[:, None]
    b = np.take_along_axis(a, after[:, :, None], axis=1)
    cross = np.where(inside, a[:, :, 0] * b[:, :, 1] - a[:, :, 1] * b[:, :, 0], 0.0)
    area = cross.sum(axis=1) / 2
    moment = np.einsum("nk,nki->ni", cross, np.where(inside[:, :, None], a + b, 0.0)) / 6
    return area, diagram.site + moment / np.where(area != 0, area, 1.0)[:, None]


def relax(diagram: PlaneDiagram, times: int) -> None:
    """Lloyd's relaxation: every site moves to the centroid of its cell."""
    for _ in range(times):
        if diagram.update():
            diagram.site = areas_and_centroids(diagram)[1]
    diagram.update()


def regularise(diagram: PlaneDiagram, target: np.ndarray, laguerre: bool) -> float:
    """Move sites (and weights, if laguerre) until nothing is short; returns the energy that is left."""
    n, residual = len(diagram.site), np.inf
    to_site, to_weight = np.empty((n, 2)), np.empty(n)

    def value(x: np.ndarray, wishes: PlaneTargets) -> tuple[float, np.ndarray]:
        weight = x[2 * n :] if laguerre else diagram.weight
        room = diagram.corner, diagram.label, diagram.count
        total = energy(x[: 2 * n].reshape(n, 2), weight, diagram.domains, wishes, *room, to_site, to_weight)
        if not np.isfinite(total):
            return NEVER, np.zeros_like(x)
        return total, np.concatenate([to_site.ravel(), to_weight]) if laguerre else to_site.ravel().copy()

    x = np.concatenate([diagram.site.ravel(), diagram.weight]) if laguerre else diagram.site.ravel()
    for edge, segment in STAGES:
        wishes = PlaneTargets(target, edge, segment, SIZES_MATTER if laguerre else 0.0, 1.0, 1.0)
        options = {"maxfun": EVALUATIONS, "maxiter": EVALUATIONS, "maxcor": 20}
        minimum = minimize(value, x, (wishes,), "L-BFGS-B", jac=True, callback=_until_enough, options=options)
        x, residual = minimum.x, float(minimum.fun)
    diagram.site = x[: 2 * n].reshape(n, 2).copy()
    if laguerre:
        diagram.weight = x[2 * n :].copy()
    diagram.update()
    return residual


def _until_enough(intermediate_result: OptimizeResult) -> None:
    if intermediate_result.fun < ENOUGH:
        raise StopIteration


def hold_sizes(diagram: PlaneDiagram, target: np.ndarray, tolerance: float = 1e-10, iterations: int = 60) -> bool:
    """Newton's method on the weights until every area is its target (n,); damped so that no cell dries up.

    Kitagawa, Merigot and Thibert (2019). Returns whether all areas are within the tolerance of their targets.
    """
    if not diagram.update():
        return False
    area = areas_and_centroids(diagram)[0]
    minimum = 0.5 * min(area.min(), target.min())
    for _ in range(iterations):
        lack = target - area
        if np.abs(lack / target).max() <= tolerance:
            return True
        step, before, fraction = _newton_step(diagram, lack), diagram.weight, 1.0
        while fraction > 1e-6:
            diagram.weight = before + fraction * step
            if diagram.update():
                area = areas_and_centroids(diagram)[0]
                progress = np.linalg.norm(target - area) <= (1 - 0.5 * fraction) * np.linalg.norm(lack)
                if area.min() >= minimum and progress:
                    break
            fraction *= 0.5
        else:
            diagram.weight = before
            diagram.update()
            return bool(np.abs(lack / target).max() <= 1e-6)
    return False


def _newton_step(diagram: PlaneDiagram, lack: np.ndarray) -> np.ndarray:
    """Change of the weights that makes up for the lack of area (n,), to first order; one weight a unit stays."""
    n = len(lack)
    cell, label, length = edges(diagram)
    once = label > cell
    i, j, length = cell[once], label[once], length[once]
    coefficient = length / (2 * np.linalg.norm(diagram.site[i] - diagram.site[j], axis=1))
    diagonal = np.bincount(i, coefficient, n) + np.bincount(j, coefficient, n)
    free = np.ones(n, dtype=bool)
    free[diagram.domains.cell_start[:-1]] = False
    rows, columns = np.concatenate([i, j, np.arange(n)]), np.concatenate([j, i, np.arange(n)])
    matrix = coo_array((np.concatenate([-coefficient, -coefficient, diagonal]), (rows, columns)), shape=(n, n)).tocsr()
    step = np.zeros(n)
    if free.any():
        step[free] = spsolve(matrix[free][:, free].tocsc(), lack[free])
    return step


def edges(diagram: PlaneDiagram) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Cell (m,), label (m,) and length (m,) in h of every edge of every cell."""
    cell, k = np.nonzero(np.arange(MOST) < diagram.count[:, None])
    after = np.where(k + 1 < diagram.count[cell], k + 1, 0)
    return cell, diagram.label[cell, k], np.linalg.norm(diagram.corner[cell, after] - diagram.corner[cell, k], axis=1)
