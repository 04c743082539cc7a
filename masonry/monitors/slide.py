"""How far contacts slide over their faces: they keep their place and area, which is an error as large as that share."""

from typing import Any

import numpy as np

from geometry.joints.extents import joint_extents
from masonry.errors import Stopped
from masonry.model.model import Model
from masonry.monitors.energy import Seen
from masonry.runtime.state import State

APART = 1e-3
"""A contact without compression that is wider open than this share of its extent touches nothing any more."""
ROLLER = 1e-6
"""Shear over normal stiffness up to which an elastic contact is a roller."""


class Slide:
    """The largest slip of any contact that touches so far, over the extent of its joint along the slip.

    The joint of two units is all of their faces that look the same way, however many blocks they are cut into; within a
    unit, where a joint is cut at random, it is the smaller of the two blocks. Extents are those of a rectangle round
    the joint. Rollers, contacts that never carry any shear, may slide as far as they like.
    """

    def __init__(self, model: Model, limit: float) -> None:
        self.model, self.limit = model, limit
        self.largest = 0.0
        self.axes, self.extent = joint_extents(model.blocks, model.joints)
        self.least = self.extent.min(axis=1, initial=np.inf)
        sticks = [not is_roller(interface) for interface in model.groups.properties]
        self.sticks = np.array(sticks, dtype=bool)[model.group]

    def look(self, step: int, seen: Seen) -> None:
        """Raise Stopped if a contact slid by more than the limit."""
        opening, slip, sigma, tau = seen
        further = self.sticks & (slip > self.largest * self.least) & ((sigma < 0.0) | (tau > 0.0))
        which = np.flatnonzero(further)
        which = which[(sigma[which] < 0.0) | (opening[which] < APART * self.least[which])]
        if len(which) == 0:
            return
        (one, two), u = self.model.contacts.sides[which].T, self.model.contacts.u
        share = np.abs(np.einsum("ckj,cj->ck", self.axes[which], u[two] - u[one])) / self.extent[which]
        highest = int(np.argmax(share.max(axis=1)))
        worst, reached = int(which[highest]), float(share[highest].max())
        self.largest = max(self.largest, reached)
        if reached > self.limit:
            raise Stopped(
                f"step {step}: {self.model.contact(worst)} has slid by {slip[worst]:.3g} m, {reached:.3g} of the "
                f"extent of its joint, more than solver.slip_limit = {self.limit:g}; contacts keep the place and the "
                "area that they begin with"
            )

    def state(self) -> State:
        """The largest slip so far."""
        return {"largest": self.largest}

    def restore(self, state: State) -> None:
        """Go on from there."""
        self.largest = state["largest"]


def is_roller(interface: Any) -> bool:
    """Whether contacts with these properties carry no shear, however hard they are pressed."""
    if interface.tensile_strength is None:
        return bool(interface.shear_stiffness <= ROLLER * np.min(interface.normal_stiffness))
    strengths = (
        interface.cohesion,
        interface.tan_friction,
        interface.residual_cohesion,
        interface.tan_residual_friction,
    )
    return not any(np.any(strength) for strength in strengths if strength is not None)
