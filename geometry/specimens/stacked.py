"""Units one above the other with beds of mortar or bare joints between them: the couplet and the prism."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import Blocks, CellReport, Specimen
from geometry.cells.request import CellRequest
from geometry.checks import require_counts, require_lengths
from geometry.polyhedra.construct import concatenate, from_boxes
from geometry.polyhedra.overlaps import check_overlaps
from geometry.specimens.filling import fill_with_cells, fill_with_grid

Filling = Sequence[int] | CellRequest
"""How boxes are divided: (nx, ny, nz) blocks in each, or cells in all of them together."""


def filled(low: np.ndarray, high: np.ndarray, filling: Filling, group: str) -> tuple[Blocks, tuple[CellReport, ...]]:
    """Boxes low[u]..high[u] (U, 3) m divided as asked, and what cells came to; the unit of a block is u."""
    if isinstance(filling, CellRequest):
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
    if not isinstance(filling, CellRequest):
        require_counts(kind, "divisions", filling, "xyz")
    if mortar is not None:
        require_lengths(kind, {"mortar thickness": mortar[0]})
        if not isinstance(mortar[1], CellRequest):
            require_counts(kind, "mortar divisions", mortar[1], "xyz")
    if plates is not None:
        require_lengths(kind, {"plates": plates})


def _boxes(low: np.ndarray, high: np.ndarray, size: tuple[float, float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Low and high corners (n, 3) of boxes over the whole plan from level low (n,) to high (n,)."""
    zero = np.zeros(len(low))
    return np.stack([zero, zero, low], axis=1), np.stack([zero + size[0], zero + size[1], high], axis=1)


def couplet(
    length: float,
    width: float,
    height: float,
    divisions: Filling = (1, 1, 1),
    mortar: tuple[float, Filling] | None = None,
    plates: float | None = None,
) -> Specimen:
    """Two units length x width x height (m, along x, y, z), each divided into (nx, ny, nz) blocks, or both into cells.

    mortar  thickness (m) and division of a bed between them; without it the units meet in a joint of no thickness
    plates  thickness (m) of an end plate below and above, one block each
    The section is length * width. Raises GeometryError for a size that is not positive.
    """
    return stack("couplet", 2, (length, width, height), divisions, mortar, plates)


def prism(
    units: int,
    length: float,
    width: float,
    height: float,
    divisions: Filling = (1, 1, 1),
    mortar: tuple[float, Filling] | None = None,
    plates: float | None = None,
) -> Specimen:
    """Units length x width x height (m, along x, y, z), each divided into (nx, ny, nz) blocks, or all into cells.

    mortar  thickness (m) of the beds between them, and how they are divided
    plates  thickness (m) of an end plate below and above, one block each
    There is a set for every unit, "unit 1" (the lowest), "unit 2", .... The section is length * width. Raises
    GeometryError for a size that is not positive.
    """
    specimen = stack("prism", units, (length, width, height), divisions, mortar, plates)
    laid = specimen.blocks.unit[specimen.sets["units"]]
    specimen.sets.update({f"unit {u + 1}": np.flatnonzero(laid == u) for u in range(units)})
    return specimen
