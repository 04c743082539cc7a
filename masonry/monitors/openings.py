"""How wide contacts open, and how deep they close: beyond small displacements a stiffness is no joint's any more."""

import numpy as np

from geometry.polyhedra import measures
from masonry.model.model import Model
from masonry.monitors.observer import Observer, View


class Openings(Observer):
    """The widest opening of any contact, and the largest closure, over the extent of the thinner of its two blocks
    along its normal."""

    def __init__(self, model: Model) -> None:
        self.extent = thinner(model)

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        opening = view.seen.opening
        return {
            "widest": float(opening.max(initial=0.0)),
            "overlap": float((-opening / self.extent).max(initial=0.0)),
        }


def thinner(model: Model) -> np.ndarray:
    """(C,) m, the extent of the thinner of the two blocks of each contact, along its normal."""
    blocks, joints = model.blocks, model.joints
    _, first, patch = np.unique(joints.patch, return_index=True, return_inverse=True)
    both = (measures.extents(blocks, b[first], joints.normal[first]) for b in (joints.block_a, joints.block_b))
    return np.asarray(np.minimum(*both)[patch.reshape(-1)])
