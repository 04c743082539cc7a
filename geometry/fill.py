"""Boxes of a specimen (units, mortar beds) divided into blocks: a regular grid, or cells."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import Blocks
from geometry.cells.asked import CellReport, CellsAsked
from geometry.grid import divide
from geometry.shapes import from_boxes


def fill_with_grid(low: np.ndarray, high: np.ndarray, divisions: Sequence[Sequence[int]], group: str) -> Blocks:
    """Every box low[u]..high[u] (U, 3) m divided into its own nx x ny x nz; the unit of a block is u."""
    cells = [divide(a, b, n) for a, b, n in zip(low.tolist(), high.tolist(), divisions, strict=True)]
    unit = np.repeat(np.arange(len(cells)), [len(part) for part, _ in cells])
    lows, highs = (np.concatenate([cell[k] for cell in cells]) for k in (0, 1))
    return from_boxes(lows, highs, unit, np.zeros(len(unit)), (group,))


def fill_with_cells(low: np.ndarray, high: np.ndarray, asked: CellsAsked, group: str) -> tuple[Blocks, CellReport]:
    """Every box low[u]..high[u] (U, 3) m divided into cells, all together; the unit of a block is u."""
    raise NotImplementedError
