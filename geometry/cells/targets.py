"""How many cells each unit gets, how large each is to be, and where the seeds start."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import GeometryError
from geometry.cells.request import CellRequest

MOST_CELLS = 200_000
MOST_RATIO = 1e6
"""Largest over smallest of the sizes of a unit's cells."""


def share_out(request: CellRequest, volume: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """(U,) cells of each unit of volume (U,) m3 and depth (U,) m; a total is met exactly, by largest remainders."""
    if request.total is not None:
        counts = _largest_remainders(request.total, volume)
    elif request.per_unit is not None:
        counts = np.maximum(1, np.rint(request.per_unit * volume / volume.max())).astype(np.int64)
    else:
        assert request.size is not None
        cell_volume = request.size**3 if request.space else request.size**2 * depth
        counts = np.maximum(1, np.rint(np.minimum(volume / cell_volume, 1e9))).astype(np.int64)
    if counts.sum() > MOST_CELLS:
        raise GeometryError(f"cells: this would make {counts.sum()} cells; at most {MOST_CELLS} are allowed")
    return counts


def _largest_remainders(total: int, volume: np.ndarray) -> np.ndarray:
    if total < len(volume):
        raise GeometryError(f"cells: total is {total}, but there are {len(volume)} units; nearest: {len(volume)}")
    exact_count = total * volume / volume.sum()
    counts = np.maximum(1, np.floor(exact_count * (1 + 1e-12))).astype(np.int64)
    while counts.sum() < total:
        counts[np.argmax(np.round(exact_count - counts, 9))] += 1
    while counts.sum() > total:  # units too small for one cell got one all the same
        counts[np.argmax(np.where(counts > 1, np.round(counts - exact_count, 9), -np.inf))] -= 1
    return counts


def target_sizes(request: CellRequest, counts: np.ndarray, whole: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """(n,) sizes of all cells, unit by unit, that add up to the size whole (U,) of each unit."""
    sizes = np.ones(counts.sum())
    if request.sizes is not None:
        _require_sizes(request.sizes, counts)
        sizes = np.tile(np.asarray(request.sizes, dtype=float), len(counts))
    elif request.spread > 0:
        sizes = rng.lognormal(0.0, np.sqrt(np.log1p(request.spread**2)), len(sizes))
    unit = np.repeat(np.arange(len(counts)), counts)
    return sizes * (whole / np.bincount(unit, sizes))[unit]


def _require_sizes(sizes: tuple[float, ...], counts: np.ndarray) -> None:
    if not np.all(np.isfinite(sizes)) or min(sizes, default=0.0) <= 0:
        raise GeometryError("cells: every one of sizes must be greater than 0")
    if max(sizes) > MOST_RATIO * min(sizes):
        raise GeometryError(
            f"cells: sizes run from {min(sizes):g} to {max(sizes):g}; the largest may be {MOST_RATIO:.0e} times the "
            f"smallest, so nearest: {max(sizes) / MOST_RATIO:g}"
        )
    if np.any(counts != len(sizes)):
        odd = int(counts[counts != len(sizes)][0])
        raise GeometryError(f"cells: there are {len(sizes)} sizes, but a unit has {odd} cells; give {odd} sizes")


def given_sites(request: CellRequest, inside: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Seeds (n, 3) m of a scene sorted by unit, and how many each holds; inside (n, U) says which lie in which."""
    site = np.asarray(request.sites, dtype=float).reshape(-1, 3)
    if np.any(inside.sum(axis=1) != 1):
        x, y, z = site[np.flatnonzero(inside.sum(axis=1) != 1)[0]]
        raise GeometryError(f"cells: the site ({x:g}, {y:g}, {z:g}) m lies in no unit; move it or leave it out")
    counts = inside.sum(axis=0)
    if request.total != len(site):
        raise GeometryError(f"cells: there are {len(site)} sites; total must be their number: total = {len(site)}")
    if counts.min() < 1:
        u = int(np.argmin(counts))
        raise GeometryError(f"cells: unit {u} holds no site; every unit needs at least one")
    return site[np.argsort(np.argmax(inside, axis=1), kind="stable")], counts


def sites_in_outlines(outlines: Sequence[np.ndarray], counts: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """(n, 2) seeds spread evenly at random over convex polygons (k, 2), counter-clockwise, so many in each."""
    low, high = (np.array([side(outline, axis=0) for outline in outlines]) for side in (np.min, np.max))
    unit = np.repeat(np.arange(len(counts)), counts)
    site = rng.uniform(low[unit], high[unit])
    for u, outline in enumerate(outlines):
        wrong = np.flatnonzero(unit == u)
        while len(wrong := wrong[~_within(outline, site[wrong])]):
            site[wrong] = rng.uniform(low[u], high[u], (len(wrong), 2))
    return site


def _within(outline: np.ndarray, points: np.ndarray) -> np.ndarray:
    """(n,) whether points (n, 2) lie in a convex polygon, edges included."""
    along = np.roll(outline, -1, axis=0) - outline
    arm = points[:, None] - outline
    return np.asarray(np.all(along[:, 0] * arm[..., 1] - along[:, 1] * arm[..., 0] >= 0, axis=1))
