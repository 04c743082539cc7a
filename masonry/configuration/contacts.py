"""Opening, slip, stress and stored energy of the contacts of the undeformed shape."""

from typing import Any

import numpy as np

from masonry.jit.compiled_parts import Call
from masonry.kernels import contact
from masonry.model.model import Model


class ContactsLook:
    """Looks at all contacts of a model; the calls, one a group, are put together once."""

    def __init__(self, model: Model) -> None:
        self.model, self.seen, self.energy = model, np.zeros((4, len(model.group))), np.zeros(1)
        self.made_of: tuple[Any, ...] = ()

    def calls(self) -> list[Call]:
        """Those that look, of the arrays that the model has now."""
        model = self.model
        made_of = model.groups, model.contacts
        if not self.made_of or any(one is not other for one, other in zip(self.made_of, made_of, strict=True)):
            parameters, properties, states, bounds = model.groups
            groups = zip(parameters, properties, states, bounds[:-1], bounds[1:], strict=True)
            rest = *model.contacts, self.seen, self.energy
            self.made, self.made_of = [contact.look.of(*of_group, *rest) for of_group in groups], made_of
        return self.made

    def look(self) -> float:
        """Energy (J) stored in the contacts; `seen` has opening and slip (m), normal and shear stress (Pa) now."""
        self.energy[0] = 0.0
        for call in self.calls():
            call()
        return float(self.energy[0])


def sums_of_blocks(pair: np.ndarray, values: np.ndarray, count: int) -> np.ndarray:
    """(B,) sums of values (C,) over both blocks (C, 2) of each contact."""
    return np.asarray(np.bincount(pair[:, 0], values, count) + np.bincount(pair[:, 1], values, count))


def stiffness_of_contacts(model: Model) -> np.ndarray:
    """(C,) N/m, normal stiffness of the contacts of the undeformed shape."""
    stiffness = np.zeros(len(model.group))
    for g, joint in enumerate(model.groups.properties):
        stiffness[model.groups.bounds[g] : model.groups.bounds[g + 1]] = joint.normal_stiffness
    return np.asarray(stiffness * model.joints.area)


def pairs_of_contacts(model: Model) -> np.ndarray:
    """(C, 2) both blocks of each contact."""
    return np.column_stack([model.joints.block_a, model.joints.block_b]).astype(np.int64)
