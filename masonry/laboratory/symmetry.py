"""Whether cracks that began symmetrically went on so: where two are alike, the pace decides which one opens."""

from collections.abc import Iterator

import numpy as np

from geometry.blocks import Joints
from masonry.history import Frame

SAME = 1e-6
"""Of the size of the specimen: how far a contact may lie from the mirror image of another one."""
CRACKED = 1e-3
"""Share of the area of all contacts, weighed by damage, from which on cracks count."""
KEPT, LOST = 0.02, 0.1
"""Share of the cracks without a mirror image, up to which they are symmetric, and from which on they are not. The
wallette of failure mode 1 comes from 0.000 to 0.6; with strengths that scatter by 1 % from 0.001 to 0.004, by 3 % from
0.01 to 0.02, and by 10 % from 0.04 to 0.09: then the pace decides nothing any more."""


def symmetry_lost(joints: Joints, frames: list[Frame]) -> str:
    """The axis ("x", "y" or "z") across whose middle plane the cracks were symmetric and are so no more; "" without."""
    area = joints.area
    cracks = [frame.damage for frame in frames if area @ frame.damage > CRACKED * area.sum()]
    if len(cracks) < 2:
        return ""
    for axis, image in _images(joints.point):
        alone = [float(area @ np.abs(damage - damage[image]) / (2.0 * area @ damage)) for damage in cracks]
        if min(alone) <= KEPT and alone[-1] >= LOST:
            return axis
    return ""


def _images(point: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    """Axes across which points (C, 3) m are symmetric, with the number of each one's mirror image (C,)."""
    from scipy.spatial import cKDTree

    low, high = point.min(axis=0), point.max(axis=0)
    tree = cKDTree(point)
    for k, axis in enumerate("xyz"):
        mirrored = point.copy()
        mirrored[:, k] = low[k] + high[k] - point[:, k]
        far, image = tree.query(mirrored, distance_upper_bound=SAME * float((high - low).max()))
        if np.isfinite(far).all() and len(np.unique(image)) == len(image):
            yield axis, image
