"""The couplet: two units one above the other, with a joint or a bed of mortar between them."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import Specimen
from geometry.grid import divide
from geometry.overlaps import check_overlaps
from geometry.shapes import concatenate, from_boxes
from geometry.sizes import require_counts, require_lengths


def couplet(
    length: float,
    width: float,
    height: float,
    divisions: Sequence[int] = (1, 1, 1),
    mortar: tuple[float, Sequence[int]] | None = None,
    plates: float | None = None,
) -> Specimen:
    """Two units length x width x height (m, along x, y, z), each divided into divisions = (nx, ny, nz) blocks.

    mortar  thickness (m) and divisions of a bed between them; without it the units meet in a joint of no thickness
    plates  thickness (m) of an end plate below and above, one block each
    The section is length * width. Raises GeometryError for a size that is not positive.
    """
    require_lengths("couplet", {"length": length, "width": width, "height": height})
    require_counts("couplet", "divisions", divisions, "xyz")
    layers: list[tuple[str, str, float, Sequence[int]]] = [("bottom", "units", height, divisions)]
    if mortar is not None:
        require_lengths("couplet", {"mortar thickness": mortar[0]})
        require_counts("couplet", "mortar divisions", mortar[1], "xyz")
        layers.append(("mortar", "mortar", mortar[0], mortar[1]))
    layers.append(("top", "units", height, divisions))
    if plates is not None:
        require_lengths("couplet", {"plates": plates})
        layers = [("bottom plate", "plates", plates, (1, 1, 1)), *layers, ("top plate", "plates", plates, (1, 1, 1))]

    parts, sets, level, count = [], {}, 0.0, 0
    for unit, (name, group, thickness, cells) in enumerate(layers):
        low, high = divide((0.0, 0.0, level), (length, width, level + thickness), cells)
        part = from_boxes(low, high, np.full(len(low), unit), np.zeros(len(low)), (group,))
        parts.append(part)
        sets[name] = np.arange(count, count + part.count)
        count, level = count + part.count, level + thickness
    blocks = concatenate(parts)
    check_overlaps(blocks)
    return Specimen(blocks, sets, section=length * width, shape="couplet")
