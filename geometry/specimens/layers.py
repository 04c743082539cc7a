"""Layers one above the other: units, beds of mortar between them, plates; what prism and couplet are made of."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import Blocks, CellReport, Specimen
from geometry.cells.request import CellsAsked
from geometry.checks import require_counts, require_lengths
from geometry.polyhedra.construct import concatenate, from_boxes
from geometry.polyhedra.overlaps import check_overlaps
from geometry.specimens.filling import fill_with_cells, fill_with_grid

Filling = Sequence[int] | CellsAsked
"""How boxes are divided: (nx, ny, nz) blocks in each, or cells in all of them together."""


def filled(low: np.ndarray, high: np.ndarray, filling: Filling, group: str) -> tuple[Blocks, tuple[CellReport, ...]]:
    """Boxes low[u]..high[u] (U, 3) m divided as asked, and what cells came to; the unit of a block is u."""
    if isinstance(filling, CellsAsked):
        blocks, report = fill_with_cells(low, high, filling, group)
        return blocks, (report,)
    return fill_with_grid(low, high, [filling] * len(low), group), ()


def stack(
    kind: str,
    units: int,
    size: tuple[float, float, float],
    filling: Filling,
    mortar: tuple[float, Filling] | None,
    plates: float | None,
) -> Specimen:
    """So many units of size (x, y, z) m one above the other, with sets "units", "bottom", "top", "mortar" and plates.

    Blocks stand in the order units, mortar, plates, each from below. The section is that of a unit seen from above.
    """
    _require(kind, units, size, filling, mortar, plates)
    bed = 0.0 if mortar is None else mortar[0]
    level = np.cumsum([plates or 0.0, *([size[2], bed] * units)[:-1]])
    low, high = level[0::2], level[1::2]
    blocks, reports = filled(*_boxes(low, high, size), filling, "units")
    parts = [blocks]
    sets = {
        "bottom": np.flatnonzero(blocks.unit == 0),
        "top": np.flatnonzero(blocks.unit == units - 1),
        "units": np.arange(blocks.count),
    }
    if mortar is not None and units > 1:
        beds, more = filled(*_boxes(high[:-1], low[1:], size), mortar[1], "mortar")
        sets["mortar"] = blocks.count + np.arange(beds.count)
        beds.unit[:] += units
        parts, reports = [*parts, beds], reports + more
    if plates is not None:
        count = sum(part.count for part in parts)
        ends = _boxes(np.array([0.0, level[-1]]), np.array([plates, level[-1] + plates]), size)
        parts.append(from_boxes(*ends, np.array([0, 1]) + 2 * units, np.zeros(2), ("plates",)))
        sets |= {"bottom plate": np.array([count]), "top plate": np.array([count + 1])}
    blocks = concatenate(parts)
    check_overlaps(blocks)
    return Specimen(blocks, sets, section=size[0] * size[1], shape=kind, cells=reports)


def _require(
    kind: str,
    units: int,
    size: tuple[float, float, float],
    filling: Filling,
    mortar: tuple[float, Filling] | None,
    plates: float | None,
) -> None:
    require_lengths(kind, dict(zip(("length", "width", "height"), size, strict=True)))
    require_counts(kind, "number of units", (units,), "z")
    if not isinstance(filling, CellsAsked):
        require_counts(kind, "divisions", filling, "xyz")
    if mortar is not None:
        require_lengths(kind, {"mortar thickness": mortar[0]})
        if not isinstance(mortar[1], CellsAsked):
            require_counts(kind, "mortar divisions", mortar[1], "xyz")
    if plates is not None:
        require_lengths(kind, {"plates": plates})


def _boxes(low: np.ndarray, high: np.ndarray, size: tuple[float, float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Low and high corners (n, 3) of boxes over the whole plan from level low (n,) to high (n,)."""
    zero = np.zeros(len(low))
    return np.stack([zero, zero, low], axis=1), np.stack([zero + size[0], zero + size[1], high], axis=1)
