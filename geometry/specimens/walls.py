"""Walls of expanded units: a bond filled with blocks, and the sets that every wall has."""

from math import gcd

import numpy as np

from geometry.blocks import Blocks, CellReport, GeometryError
from geometry.cells.request import CellRequest
from geometry.polyhedra.measures import bounds
from geometry.specimens.bond import WHOLE, Bond
from geometry.specimens.filling import fill_with_cells, fill_with_grid
from geometry.specimens.stacked import Filling


def fill_bond(kind: str, bond: Bond, filling: Filling) -> tuple[Blocks, tuple[CellReport, ...]]:
    """The blocks of a wall; filling is (nx, ny, nz) blocks of a whole unit (parts get their share), or cells."""
    if isinstance(filling, CellRequest):
        blocks, report = fill_with_cells(bond.low, bond.high, filling, "units")
        return blocks, (report,)
    nx, ny, nz = filling
    step = WHOLE // gcd(WHOLE, *bond.parts.tolist())
    if nx > 1 and nx % step:
        part, even = ("half a unit", "an even number") if step == 2 else ("a quarter of a unit", "a multiple of 4")
        below = [nx - nx % step] if nx > step else [1]
        raise GeometryError(
            f"{kind}: divisions along x is {nx}, but {part} takes its share of them: 1 or {even}; "
            f"nearest: {below[0]} or {nx - nx % step + step}"
        )
    along = np.maximum(1, nx * bond.parts // WHOLE)
    return fill_with_grid(bond.low, bond.high, [(int(n), ny, nz) for n in along], "units"), ()


def wall_sets(blocks: Blocks, bond: Bond) -> dict[str, np.ndarray]:
    """ "units", "left end", "right end" (blocks at the ends), "bottom course", "top course"."""
    low, high = bounds(blocks)
    near, course = 1e-9 * max(bond.length, bond.height), bond.course[blocks.unit]
    return {
        "units": np.arange(blocks.count),
        "left end": np.flatnonzero(low[:, 0] <= near),
        "right end": np.flatnonzero(high[:, 0] >= bond.length - near),
        "bottom course": np.flatnonzero(course == 0),
        "top course": np.flatnonzero(course == course.max()),
    }
