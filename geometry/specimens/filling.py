"""Boxes of a specimen (units, mortar beds) divided into blocks: a regular grid, or cells."""

import time
from collections.abc import Sequence

import numpy as np

from geometry.blocks import Blocks
from geometry.cells.request import CellReport, CellsAsked
from geometry.cells.targets import given_sites, random_sites, share_out, target_sizes
from geometry.polyhedra.construct import concatenate, from_boxes
from geometry.polyhedra.extrude import extrude
from geometry.polyhedra.grid import divide

PLANE = [0, 2]
ATTEMPTS = 3
"""Sets of random seeds that are tried before a division is left as it is."""


def fill_with_grid(low: np.ndarray, high: np.ndarray, divisions: Sequence[Sequence[int]], group: str) -> Blocks:
    """Every box low[u]..high[u] (U, 3) m divided into its own nx x ny x nz; the unit of a block is u."""
    cells = [divide(a, b, n) for a, b, n in zip(low.tolist(), high.tolist(), divisions, strict=True)]
    unit = np.repeat(np.arange(len(cells)), [len(part) for part, _ in cells])
    lows, highs = (np.concatenate([cell[k] for cell in cells]) for k in (0, 1))
    return from_boxes(lows, highs, unit, np.zeros(len(unit)), (group,))


def fill_with_cells(low: np.ndarray, high: np.ndarray, asked: CellsAsked, group: str) -> tuple[Blocks, CellReport]:
    """Every box low[u]..high[u] (U, 3) m divided into cells, all together; the unit of a block is u.

    Raises GeometryError for numbers that do not fit the boxes.
    """
    rng = np.random.default_rng(asked.seed)
    volume = np.prod(high - low, axis=1)
    if asked.sites is not None:
        site, counts = given_sites(asked, low, high)
    else:
        site, counts = None, share_out(asked, volume, high[:, 1] - low[:, 1])
    fill = _space_cells if asked.space else _plane_cells
    return fill(low, high, asked, group, counts, site, rng)


def _plane_cells(
    low: np.ndarray,
    high: np.ndarray,
    asked: CellsAsked,
    group: str,
    counts: np.ndarray,
    site: np.ndarray | None,
    rng: np.random.Generator,
) -> tuple[Blocks, CellReport]:
    from geometry.cells.plane_cells import divide_plane

    flat_low, flat_high = low[:, PLANE], high[:, PLANE]
    target = target_sizes(asked, counts, np.prod(flat_high - flat_low, axis=1), rng)
    if site is None:
        seeds = [random_sites(flat_low, flat_high, counts, rng) for _ in range(ATTEMPTS)]
    else:
        seeds = [site[:, PLANE]]
    (x0, z0), (x1, z1) = flat_low.T, flat_high.T
    polygons = list(np.stack([np.stack([x0, x1, x1, x0], axis=1), np.stack([z0, z0, z1, z1], axis=1)], axis=2))
    loops, report = divide_plane(polygons, counts, target, seeds, asked.laguerre, asked.regularise)
    unit = np.repeat(np.arange(len(counts)), counts)
    return extrude(loops, low[unit, 1], high[unit, 1], unit, (group,)), report


def _space_cells(
    low: np.ndarray,
    high: np.ndarray,
    asked: CellsAsked,
    group: str,
    counts: np.ndarray,
    site: np.ndarray | None,
    rng: np.random.Generator,
) -> tuple[Blocks, CellReport]:
    """Cells in space, unit by unit: what cells of two units share is cut up as it may fall."""
    from geometry.cells.domain import box_domain
    from geometry.cells.power_blocks import to_blocks
    from geometry.cells.space import divide_space, space_report

    start = np.concatenate([[0], np.cumsum(counts)])
    target = np.split(target_sizes(asked, counts, np.prod(high - low, axis=1), rng), start[1:-1])
    begin, parts, powers = time.perf_counter(), [], []
    for u, sizes in enumerate(target):
        seeds = None if site is None else site[start[u] : start[u + 1]]
        power, _ = divide_space(box_domain(low[u], high[u]), sizes, seeds, rng, asked.laguerre, asked.regularise)
        powers.append(power)
        parts.append(to_blocks(power, np.full(len(sizes), u), (group,)))
    return concatenate(parts), space_report(powers, target, time.perf_counter() - begin)
