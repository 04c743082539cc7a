"""Request for a division into cells, and report on the result."""

from dataclasses import dataclass

import numpy as np

from geometry.blocks import CellReport, GeometryError


@dataclass(frozen=True)
class CellRequest:
    """How to divide units into cells. Exactly one of total, per_unit and size is given.

    total       cells in all units together, shared out by volume
    per_unit    cells of a whole unit; parts of units get their share, at least 1
    size        m, root of the mean area of a plane cell, cube root of the mean volume of one in space
    space       False: cells of the plane (x, z), each as deep as the unit; True: cells in all three dimensions
    laguerre    weights hold the sizes asked for; False: a Voronoi division, whose sizes fall out as they may
    spread      coefficient of variation of the cells' sizes (area or volume), lognormal; 0 is equal sizes
    sizes       relative sizes of the cells of each unit, in place of spread
    sites       (x, y, z) m of the cells' seeds, in place of random ones
    seed        fixes everything that is random
    regularise  lengthen short edges and short joint segments between neighbouring units
    """

    total: int | None = None
    per_unit: int | None = None
    size: float | None = None
    space: bool = False
    laguerre: bool = True
    spread: float = 0.0
    sizes: tuple[float, ...] | None = None
    sites: tuple[tuple[float, float, float], ...] | None = None
    seed: int = 0
    regularise: bool = True

    def __post_init__(self) -> None:
        names = [name for name in ("total", "per_unit", "size") if getattr(self, name) is not None]
        if len(names) != 1:
            raise GeometryError(
                f"cells: exactly one of total, per_unit and size is needed, not {' and '.join(names) or 'none'}"
            )


def report_of(
    length: np.ndarray, small: float, size: np.ndarray, h: float, shortest_joint: float | None, seconds: float
) -> CellReport:
    """The report of a division from the lengths of its edges in h, and the sizes (n,) of its cells over their targets.

    small  the length in h below which an edge is small
    """
    return CellReport(
        count=len(size),
        h=h,
        shortest_over_mean=float(length.min() / length.mean()),
        shortest=float(length.min()),
        small_edges=float(np.mean(length < small)),
        size_error=float(np.abs(size - 1).max()),
        shortest_joint=shortest_joint,
        seconds=seconds,
    )
