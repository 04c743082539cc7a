"""Boxes of a specimen (units, mortar beds) divided into blocks: a regular grid, or cells."""

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from geometry.blocks import Blocks, CellReport
from geometry.cells.request import CellRequest
from geometry.cells.targets import given_sites, share_out, sites_in_outlines, target_sizes
from geometry.polyhedra.construct import concatenate, divide, extrude, from_boxes

if TYPE_CHECKING:
    from geometry.cells.domain import Domain

PLANE = [0, 2]
ATTEMPTS = 3
"""Sets of random seeds that are tried before a division is left as it is."""


def fill_with_grid(low: np.ndarray, high: np.ndarray, divisions: Sequence[Sequence[int]], group: str) -> Blocks:
    """Every box low[u]..high[u] (U, 3) m divided into its own nx x ny x nz; the unit of a block is u."""
    cells = [divide(a, b, n) for a, b, n in zip(low.tolist(), high.tolist(), divisions, strict=True)]
    unit = np.repeat(np.arange(len(cells)), [len(part) for part, _ in cells])
    lows, highs = (np.concatenate([cell[k] for cell in cells]) for k in (0, 1))
    return from_boxes(lows, highs, unit, np.zeros(len(unit)), (group,))


def fill_with_cells(low: np.ndarray, high: np.ndarray, request: CellRequest, group: str) -> tuple[Blocks, CellReport]:
    """Every box low[u]..high[u] (U, 3) m divided into cells, all together; the unit of a block is u.

    Raises GeometryError for numbers that do not fit the boxes.
    """
    rng = np.random.default_rng(request.seed)
    volume = np.prod(high - low, axis=1)
    if request.sites is not None:
        places = np.asarray(request.sites, dtype=float).reshape(-1, 3)
        inside = np.all((places[:, None] > low) & (places[:, None] < high), axis=2)
        site, counts = given_sites(request, inside)
    else:
        site, counts = None, share_out(request, volume, high[:, 1] - low[:, 1])
    if request.space:
        from geometry.cells.domain import box_domain

        domains = [box_domain(a, b) for a, b in zip(low, high, strict=True)]
        return space_cells(domains, volume, request, group, counts, site, rng)
    flat_low, flat_high = low[:, PLANE], high[:, PLANE]
    (x0, z0), (x1, z1) = flat_low.T, flat_high.T
    outlines = np.stack([np.stack([x0, x1, x1, x0], axis=1), np.stack([z0, z0, z1, z1], axis=1)], axis=2)
    area = np.prod(flat_high - flat_low, axis=1)
    return plane_cells(list(outlines), low[:, 1], high[:, 1], area, request, group, counts, site, rng)


def plane_cells(
    outlines: Sequence[np.ndarray],
    low: np.ndarray,
    high: np.ndarray,
    area: np.ndarray,
    request: CellRequest,
    group: str,
    counts: np.ndarray,
    site: np.ndarray | None,
    rng: np.random.Generator,
) -> tuple[Blocks, CellReport]:
    """Cells of the plane (x, z) in prisms along y: convex outlines (k, 2) m of area (U,) between y = low and high (U,).

    counts (U,) and site (n, 3) m as from `share_out` and `given_sites`; the unit of a cell is the number of its prism.
    """
    from geometry.cells.plane_cells import divide_plane

    target = target_sizes(request, counts, area, rng)
    drawn = (sites_in_outlines(outlines, counts, rng) for _ in range(ATTEMPTS))
    seeds = list(drawn) if site is None else [site[:, PLANE]]
    loops, report = divide_plane(outlines, counts, target, seeds, request.laguerre, request.regularise)
    unit = np.repeat(np.arange(len(counts)), counts)
    return extrude(loops, low[unit], high[unit], unit, (group,)), report


def space_cells(
    domains: "Sequence[Domain]",
    volume: np.ndarray,
    request: CellRequest,
    group: str,
    counts: np.ndarray,
    site: np.ndarray | None,
    rng: np.random.Generator,
) -> tuple[Blocks, CellReport]:
    """Cells in space of convex domains of volume (U,) m3, one by one: what cells of two share is cut up as it may fall.

    counts (U,) and site (n, 3) m as from `share_out` and `given_sites`; the unit of a cell is the number of its domain.
    """
    from geometry.cells.power_blocks import to_blocks
    from geometry.cells.space import divide_space, space_report

    start = np.concatenate([[0], np.cumsum(counts)])
    target = np.split(target_sizes(request, counts, volume, rng), start[1:-1])
    begin, parts, powers = time.perf_counter(), [], []
    for u, (domain, sizes) in enumerate(zip(domains, target, strict=True)):
        seeds = None if site is None else site[start[u] : start[u + 1]]
        power, _ = divide_space(domain, sizes, seeds, rng, request.laguerre, request.regularise)
        powers.append(power)
        parts.append(to_blocks(power, np.full(len(sizes), u), (group,)))
    return concatenate(parts), space_report(powers, target, time.perf_counter() - begin)
