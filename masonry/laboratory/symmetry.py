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
    for axis, image in _images(_inside(joints)):
        alone = [float(area @ np.abs(damage - damage[image]) / (2.0 * area @ damage)) for damage in cracks]
        if min(alone) <= KEPT and alone[-1] >= LOST:
            return axis
    return ""


def _inside(joints: Joints) -> np.ndarray:
    """(C, 3) m, places half-way from the contacts to the middles of their joints: no two joints share one."""
    corners = np.diff(joints.patch_start)
    middle = np.add.reduceat(joints.patch_points, joints.patch_start[:-1], axis=0) / corners[:, None]
    return np.asarray(0.5 * (joints.point + middle[joints.patch]))


def _images(place: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    """Axes across which places (C, 3) m are symmetric, with the number of each one's mirror image (C,)."""
    low, high = place.min(axis=0), place.max(axis=0)
    for k, axis in enumerate("xyz"):
        mirrored = place.copy()
        mirrored[:, k] = low[k] + high[k] - place[:, k]
        steps = _steps(np.concatenate([place, mirrored]), SAME * float((high - low).max()))
        here, there = steps[: len(place)], steps[len(place) :]
        one, other = np.lexsort(here.T), np.lexsort(there.T)
        if np.array_equal(here[one], there[other]):
            image = np.empty(len(place), dtype=np.int64)
            image[one] = other
            yield axis, image


def _steps(place: np.ndarray, width: float) -> np.ndarray:
    """Which of all different x, y, z each place (C, 3) has, counted from below; those nearer than a width are one."""
    order = np.argsort(place, axis=0)
    rises = np.diff(np.take_along_axis(place, order, axis=0), axis=0, prepend=place.min(axis=0)[None]) > width
    found = np.empty(place.shape, dtype=np.int64)
    np.put_along_axis(found, order, np.cumsum(rises, axis=0), axis=0)
    return found
