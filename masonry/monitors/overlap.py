"""How deep contacts close into blocks: beyond small displacements a stiffness is no joint's any more."""

import numpy as np

from geometry.polyhedra import measures
from masonry.model.model import Model
from masonry.runtime.state import State


class Overlap:
    """The largest closure of any contact so far, over the extent of the thinner of its two blocks along its normal."""

    def __init__(self, model: Model) -> None:
        low, high = measures.bounds(model.blocks)
        joints, along = model.joints, np.abs(model.joints.normal)
        extents = [((high - low)[b] * along).sum(axis=1) for b in (joints.block_a, joints.block_b)]
        self.extent = np.minimum(*extents)
        self.largest = 0.0

    def look(self, opening: np.ndarray) -> None:
        """Opening (C,) m, negative where a contact is closed."""
        if len(opening):
            self.largest = max(self.largest, float((-opening / self.extent).max()))

    def state(self) -> State:
        """The largest closure so far."""
        return {"largest": self.largest}

    def restore(self, state: State) -> None:
        """Go on from there."""
        self.largest = state["largest"]
