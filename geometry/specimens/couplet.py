"""The couplet: two units one above the other, with a joint or a bed of mortar between them."""

from geometry.blocks import Specimen
from geometry.specimens.layers import Filling, stack


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
