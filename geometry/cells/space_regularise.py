"""Short edges of a power diagram in space lengthened, while its sizes are held.

How it works. (1) Start: Lloyd's relaxation and optimal transport in turn, until sites are near the centroids of cells
of the right sizes; from a start less relaxed than this, one edge in ten stays short. (2) Limited-memory BFGS on the
energy of space_energy.py over sites and weights, in stages: at first sizes matter little and the edges of a cell's own
triangles hardly count, which makes the energy nearly continuous where a triangle shrinks to nothing and an edge grows
out of it (three triangle edges, each counted by one cell of three, are worth the one edge), so that faces come and go
downhill; then sizes matter more and triangles count in full. (3) Newton's method on the weights alone, which sets the
sizes exactly. (4) Where short edges are left, (2) and (3) are done again: first with a higher threshold to begin with,
then from the best state so far with the sites about its short edges shaken. All budgets are numbers of evaluations,
never times, so that the same seed gives the same bits.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import OptimizeResult, minimize
from scipy.spatial import cKDTree

from geometry.cells.power import tessellate
from geometry.cells.power_blocks import edges
from geometry.cells.space_energy import SpaceTargets
from geometry.cells.transport import SpaceDiagram, hold_sizes, relax

SMALL = 0.25
"""Edges below this share of h are small."""
ENOUGH = 1e-4
"""Energy at which a stage ends: no edge lacks more than a fiftieth of its threshold."""
NEVER = 1e10


@dataclass(frozen=True)
class Stage:
    """Threshold of edges, weight of sizes, how much a cell's own triangles count, and the evaluations to spend."""

    edge: float
    of_size: float
    of_triangles: float
    evaluations: int


STAGES = (Stage(0.31, 2.0, 0.15, 400), Stage(0.29, 30.0, 0.3, 150), Stage(0.27, 300.0, 1.0, 300))
AGAIN = (Stage(0.33, 3.0, 0.15, 100), Stage(0.29, 30.0, 0.3, 100), Stage(0.27, 300.0, 1.0, 200))
ROUNDS, TRIED_AGAIN = 4, 4000
"""How often it is tried again where short edges are left, at most; and the cells that may be tried again in all, since
a round of 5000 cells takes two minutes and mends little."""
SHAKEN, SHAKE = 0.8, 0.12
"""h, sites within this distance of a short edge are shaken; and how far."""


def settle(diagram: SpaceDiagram, target: np.ndarray, laguerre: bool, relaxations: int = 10) -> None:
    """Sites to the centroids of cells that are nearly as large as their targets (n,)."""
    relax(diagram, relaxations)
    for _ in range(relaxations):
        if laguerre:
            hold_sizes(diagram, target, tolerance=0.1, iterations=3)
        relax(diagram, 1)


def regularise(diagram: SpaceDiagram, target: np.ndarray, laguerre: bool, rng: np.random.Generator) -> None:
    """Move sites (and weights, if laguerre) until no edge is small, and sizes are their targets (n,)."""
    settle(diagram, target, laguerre)
    if laguerre:
        hold_sizes(diagram, target, tolerance=0.01, iterations=20)
    best, minimum = (diagram.site, diagram.weight), np.inf
    for number in range(1 + min(ROUNDS, TRIED_AGAIN // diagram.count)):
        if number > 1:
            _shake(diagram, rng)
        for stage in AGAIN if number else STAGES:
            _descend(diagram, target, stage, laguerre)
        if laguerre:
            hold_sizes(diagram, target)
        lack = float(np.sum(1 - _short_edges(diagram)[1] / SMALL))
        if lack < minimum:
            best, minimum = (diagram.site, diagram.weight), lack
        diagram.site, diagram.weight = best
        if minimum == 0.0:
            break


def _descend(diagram: SpaceDiagram, target: np.ndarray, stage: Stage, laguerre: bool) -> None:
    n = diagram.count
    scale = np.clip(np.cbrt(target), 0.95, 1.0)
    wishes = SpaceTargets(target, scale, stage.edge, stage.of_size if laguerre else 0.0, stage.of_triangles)

    def value(x: np.ndarray) -> tuple[float, np.ndarray]:
        diagram.site = x[: 3 * n].reshape(n, 3).copy()
        if laguerre:
            diagram.weight = x[3 * n :].copy()
        total = diagram.energy(wishes)
        if not np.isfinite(total):
            return NEVER, np.zeros_like(x)
        slope = [diagram.to_site.ravel(), diagram.to_weight] if laguerre else [diagram.to_site.ravel()]
        return total, np.concatenate(slope)

    x = np.concatenate([diagram.site.ravel(), diagram.weight]) if laguerre else diagram.site.ravel().copy()
    evaluations = stage.evaluations
    options = {"maxfun": evaluations, "maxiter": evaluations, "maxcor": 20, "ftol": 1e-10}
    value(minimize(value, x, jac=True, method="L-BFGS-B", callback=_until_enough, options=options).x)


def _until_enough(intermediate_result: OptimizeResult) -> None:
    if intermediate_result.fun < ENOUGH:
        raise StopIteration


def _short_edges(diagram: SpaceDiagram) -> tuple[np.ndarray, np.ndarray]:
    """Middles (k, 3) and lengths (k,) of the small edges."""
    power = tessellate(diagram.site, diagram.weight, diagram.domain)
    begin, end = power.vertices[edges(power)].transpose(1, 0, 2)
    length = np.linalg.norm(end - begin, axis=1)
    return (begin + end)[length < SMALL] / 2, length[length < SMALL]


def _shake(diagram: SpaceDiagram, rng: np.random.Generator) -> None:
    """Move the sites near short edges at random."""
    near = cKDTree(_short_edges(diagram)[0]).query(diagram.site)[0] < SHAKEN
    diagram.site = diagram.site + near[:, None] * rng.normal(scale=SHAKE, size=diagram.site.shape)
