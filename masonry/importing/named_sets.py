"""Names of the blocks of a file in a scene: sets by name, by group and by place; the section, and its origin."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import Blocks
from geometry.polyhedra.measures import bounds, extent, face_areas_normals_centroids
from masonry.importing.scene_file import ASKED

SECTIONS = 1e-12, 1e8  # m2, what a scene allows


def sets_of(blocks: Blocks, names: Sequence[str], near: float = 0.0) -> dict[str, np.ndarray]:
    """Blocks of each name and of each group, those that reach the bottom and the top, and all; groups come first.

    near  m from the lowest and the highest plane that counts as there
    """
    low, high = bounds(blocks)
    near = max(near, 1e-6 * extent(blocks))
    sets = {
        "all": np.arange(blocks.count),
        "bottom": np.flatnonzero(low[:, 2] <= low[:, 2].min() + near),
        "top": np.flatnonzero(high[:, 2] >= high[:, 2].max() - near),
    }
    members: dict[str, list[int]] = {}
    for b, name in enumerate(names):
        members.setdefault(name, []).append(b)
    sets |= {name: np.array(numbers) for name, numbers in members.items() if name}
    return sets | {name: np.flatnonzero(blocks.group == g) for g, name in enumerate(blocks.groups)}


def section_of(blocks: Blocks, section: float | None) -> float:
    """m2, as asked, or the area of the faces in the lowest plane; else that of the box round all, seen from above."""
    if section is not None:
        return section
    low, high = bounds(blocks)
    span = high.max(axis=0) - low.min(axis=0)
    return lowest_area(blocks) or float(span[0] * span[1])


def lowest_area(blocks: Blocks) -> float:
    """m2 of the faces that look down in the lowest plane; 0 where there is none."""
    area, normal, centroid = face_areas_normals_centroids(blocks)
    low = bounds(blocks)[0]
    at_bottom = (normal[:, 2] < -1 + 1e-9) & (centroid[:, 2] <= low[:, 2].min() + 1e-6 * extent(blocks))
    return float(area[at_bottom].sum())


def section_words(blocks: Blocks, section: float | None) -> str:
    """Where the section comes from."""
    if section is not None:
        return ASKED
    return "the area of the faces in the lowest plane" if lowest_area(blocks) else "the box round all, seen from above"
