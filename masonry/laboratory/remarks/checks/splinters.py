"""Are blocks so unlike in size that one of them may be a mistake? A run of them is no less right, so that it is asked
before only."""

import numpy as np

from geometry.polyhedra.measures import volumes
from masonry.assembly.assemble import Assembly

LARGEST = 1e6
"""Volume of a block over that of another."""


def remarks(assembly: Assembly) -> list[str]:
    """A line with the two extremes; the floor is not one of them."""
    blocks, scene = assembly.specimen.blocks, assembly.scene
    floor = [number for number, name in enumerate(blocks.groups) if scene.is_floor(name)]
    size = np.where(np.isin(blocks.group, floor), np.nan, volumes(blocks))
    if np.isnan(size).all() or np.nanmax(size) <= LARGEST * np.nanmin(size):
        return []
    large, small = int(np.nanargmax(size)), int(np.nanargmin(size))
    return [
        f"specimen: block {large} has {size[large]:.3g} m3, block {small} {size[small]:.3g} m3, "
        f"{size[large] / size[small]:.2g} times less: is the smaller one a splinter, or the unit of one of them wrong?"
    ]
