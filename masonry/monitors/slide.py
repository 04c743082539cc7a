"""How far contacts slide over their faces: they keep their place and area, which is an error as large as that share."""

from math import inf
from typing import Any

import numpy as np

from geometry.jit_cache import compiled
from geometry.joints.extents import joint_extents
from masonry.errors import MovedTooFar
from masonry.model.model import Model
from masonry.monitors.observer import Observer, View

APART = 1e-3
"""A contact without compression that is wider open than this share of its extent touches nothing any more, but where
its law is elastic: that holds however wide it is pulled."""
ROLLER = 1e-6
"""Shear over normal stiffness up to which an elastic contact is a roller."""


class Slide(Observer):
    """The largest slip of any contact that touches so far, over the extent of its joint along the slip.

    The joint of two units is all of their faces that look the same way, however many blocks they are cut into; within a
    unit, where a joint is cut at random, it is the smaller of the two blocks. Extents are those of a rectangle round
    the joint. Rollers, contacts that never carry any shear, may slide as far as they like, but where blocks may turn
    and fall: there they would hold what has slid off.
    """

    REMEMBERED = ("largest",)

    def __init__(self, model: Model, limit: float = inf, rollers: bool = True) -> None:
        """limit: of the slip over the extent, from which on a run stops; rollers: whether these may slide freely"""
        self.limit = limit
        self.largest = 0.0
        self.axes, self.extent = joint_extents(model.blocks, model.joints)
        self.least = self.extent.min(axis=1, initial=np.inf)
        sticks = [not (rollers and is_roller(joint)) for joint in model.groups.properties]
        glued = [joint.tensile_strength is None for joint in model.groups.properties]
        self.glued = np.array(glued, dtype=bool)[model.group]
        self.sticking = np.where(np.array(sticks, dtype=bool)[model.group], self.least, np.nan)  # nan: never further

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        """Raise MovedTooFar if a contact slid by more than the limit."""
        joint = self.sticking, self.least, self.glued, self.axes, self.extent
        reached, worst = farthest(tuple(view.seen), self.largest, joint, model.contacts.sides, model.contacts.u)
        self.largest = max(self.largest, reached)
        if reached > self.limit:
            raise MovedTooFar(
                f"step {step}: {model.contact(worst)} has slid by {view.seen.slip[worst]:.3g} m, {reached:.3g} of the "
                f"extent of its joint, more than solver.slip_limit = {self.limit:g}; contacts keep the place and the "
                "area that they begin with"
            )
        return {"slip": self.largest}


@compiled
def farthest(seen, largest, joint, sides, u):
    """The largest slip of a contact that touches, along its joint and over the extent of that, of those that may have
    slid further than `largest`; and which it is, -1 where there is none. The rest as in Seen, Slide and Contacts."""
    opening, slip, sigma, tau = seen
    sticking, least, glued, axes, extent = joint
    reached, worst = 0.0, -1
    for c in range(len(slip)):
        if not slip[c] > largest * sticking[c]:
            continue
        if sigma[c] < 0.0 or (tau[c] > 0.0 and (opening[c] < APART * least[c] or glued[c])):
            one, two = sides[c, 0], sides[c, 1]
            x, y, z = u[two, 0] - u[one, 0], u[two, 1] - u[one, 1], u[two, 2] - u[one, 2]
            for k in range(2):
                along = abs(axes[c, k, 0] * x + axes[c, k, 1] * y + axes[c, k, 2] * z) / extent[c, k]
                if along > reached or worst < 0:
                    reached, worst = along, c
    return reached, worst


def is_roller(joint: Any) -> bool:
    """Whether contacts with these properties carry no shear, however hard they are pressed."""
    if joint.tensile_strength is None:
        return bool(joint.shear_stiffness <= ROLLER * np.min(joint.normal_stiffness))
    strengths = (
        joint.cohesion,
        joint.tan_friction,
        joint.residual_cohesion,
        joint.tan_residual_friction,
    )
    return not any(np.any(strength) for strength in strengths if strength is not None)
