"""How far apart the two sides of a joint may be for a mark to stand between them."""

from typing import TYPE_CHECKING

import numpy as np

from geometry.polyhedra.measures import volumes

if TYPE_CHECKING:
    from masonry.results.data import ResultData

NEAR = 0.1
"""Share of the size of the smaller block, the cube root of its volume."""


def reach(result: "ResultData") -> np.ndarray:
    """(C,) m by contact; without a bound in small displacement, where blocks stay side by side."""
    joints = result.joints
    if not result.is_large:
        return np.full(len(joints.area), np.inf)
    width = np.cbrt(volumes(result.specimen.blocks))
    return np.asarray(NEAR * np.minimum(width[joints.block_a], width[joints.block_b]))
