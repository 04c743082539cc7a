"""A convex domain divided into cells in all three dimensions."""

import time
from collections.abc import Sequence

import numpy as np
from scipy.stats.qmc import Halton
from threadpoolctl import threadpool_limits

from geometry.blocks import CellReport, GeometryError
from geometry.cells.domain import Domain
from geometry.cells.power import Power, tessellate
from geometry.cells.power_blocks import cell_volumes, edge_lengths
from geometry.cells.request import report_of
from geometry.cells.space_regularise import SMALL, regularise
from geometry.cells.transport import SpaceDiagram, hold_sizes


def divide_space(
    domain: Domain,
    targets: np.ndarray,
    sites: np.ndarray | None,
    rng: np.random.Generator,
    laguerre: bool = True,
    regular: bool = True,
) -> tuple[Power, CellReport]:
    """A power diagram of one convex domain, and what it came to; the same bits for the same state of rng.

    targets   (n,) m3, volumes of the cells; they are scaled to fill the domain
    sites     (n, 3) m, seeds of the cells; None: spread evenly at random
    laguerre  hold the targets by weights; False: a Voronoi division, whose sizes fall out as they may
    regular   lengthen short edges; faces stay planar
    Raises GeometryError for targets that are not greater than 0, or sites that do not lie in the domain one by one.
    """
    begin = time.perf_counter()
    targets = np.asarray(targets, dtype=float)
    n = len(targets)
    if n == 0 or not np.all(np.isfinite(targets)) or targets.min() <= 0:
        raise GeometryError("cells: at least one cell is needed, and all sizes must be greater than 0")
    h = (domain.volume / n) ** (1 / 3)
    target = targets * (n / targets.sum())
    seeds = random_sites_in(domain, n, rng) if sites is None else _checked(domain, sites, n, h)
    diagram = SpaceDiagram(domain.scaled(h), (seeds - domain.centre) / h)
    with threadpool_limits(1):  # sums of several threads of BLAS are not the same on all machines
        if regular and n > 1:
            regularise(diagram, target, laguerre, rng)
        elif laguerre:
            hold_sizes(diagram, target)
    power = tessellate(domain.centre + h * diagram.site, h**2 * diagram.weight, domain)
    return power, space_report([power], [target * h**3], time.perf_counter() - begin)


def space_report(powers: Sequence[Power], targets: Sequence[np.ndarray], seconds: float) -> CellReport:
    """Quality of the divisions of several domains together; targets (n,) m3 for each."""
    target = np.concatenate(targets)
    h = float(np.cbrt(target.mean()))
    length = np.concatenate([edge_lengths(power) for power in powers]) / h
    volume = np.concatenate([cell_volumes(power) for power in powers])
    return report_of(length, SMALL, volume / target, h, None, seconds)


def random_sites_in(domain: Domain, n: int, rng: np.random.Generator) -> np.ndarray:
    """(n, 3) m, at random and of even density over the domain (a scrambled Halton sequence)."""
    low, high = domain.corners.min(axis=0), domain.corners.max(axis=0)
    sequence, sites = Halton(3, seed=rng), np.zeros((0, 3))
    while len(sites) < n:
        some = low + (high - low) * sequence.random(n)
        sites = np.concatenate([sites, some[domain.contains(some)]])
    return sites[:n]


def _checked(domain: Domain, sites: np.ndarray, n: int, h: float) -> np.ndarray:
    """The sites (n, 3), if each of them lies in the domain and apart from the others."""
    sites = np.asarray(sites, dtype=float)
    if sites.shape != (n, 3):
        raise GeometryError(f"cells: {n} cells need sites of shape ({n}, 3), not {sites.shape}")
    outside = ~domain.contains(sites)
    if np.any(outside):
        x, y, z = sites[np.argmax(outside)]
        raise GeometryError(f"cells: the site ({x:g}, {y:g}, {z:g}) m does not lie in the domain")
    order = np.lexsort(sites.T)
    twice = np.linalg.norm(np.diff(sites[order], axis=0), axis=1) < 1e-6 * h
    if np.any(twice):
        x, y, z = sites[order][np.argmax(twice)]
        raise GeometryError(f"cells: two sites lie at ({x:g}, {y:g}, {z:g}) m; move them apart")
    return sites
