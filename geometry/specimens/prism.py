"""The prism: units stacked one above the other, with joints of no thickness or beds of mortar between them."""

import numpy as np

from geometry.blocks import Specimen
from geometry.specimens.layers import Filling, stack


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
