"""How wide contacts open, and how deep they close: beyond small displacements a stiffness is no joint's any more."""

import numpy as np

from geometry.polyhedra import measures
from masonry.configuration.configuration import configuration_of
from masonry.elements.joints.joint_crushing import JointCrushing
from masonry.errors import MovedTooFar
from masonry.model.model import Model
from masonry.monitors.observer import Observer, View

CRUSHED = 0.1
"""Of the thinner of its two blocks: what a contact that crushed by more does not bear any longer falls through it."""


class Openings(Observer):
    """The widest opening of any contact, and the largest closure, over the extent of the thinner of its two blocks
    along its normal."""

    def __init__(self, model: Model) -> None:
        self.extent, self.crushing = thinner(model), configuration_of(model).crushing

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        """Raise MovedTooFar if a contact crushed by more than a tenth of a block."""
        opening = view.seen.opening
        require_bearing(model, self.crushing, self.extent, step)
        return {
            "widest": float(opening.max(initial=0.0)),
            "overlap": float((self.crushing.closed(opening) / self.extent).max(initial=0.0)),
        }


def require_bearing(model: Model, crushing: JointCrushing, extent: np.ndarray, step: int) -> None:
    """Raise MovedTooFar, naming the contact that crushed most, where that is too much; extent (C,) m: `thinner`."""
    ratio, worst = crushing.in_contacts(extent)
    if ratio > CRUSHED:
        raise MovedTooFar(
            f"step {step}: {model.contact(worst)} has crushed by {crushing.of_contacts()[worst]:.3g} m, {ratio:.3g} of "
            "the thinner of its blocks: what is left of its strength does not bear what presses it"
        )


def thinner(model: Model) -> np.ndarray:
    """(C,) m, the extent of the thinner of the two blocks of each contact, along its normal."""
    blocks, joints = model.blocks, model.joints
    _, first, patch = np.unique(joints.patch, return_index=True, return_inverse=True)
    both = (measures.extents(blocks, b[first], joints.normal[first]) for b in (joints.block_a, joints.block_b))
    return np.asarray(np.minimum(*both)[patch.reshape(-1)])
