"""What the contacts of the undeformed shape show and store."""

import numpy as np

from masonry.kernels import contact
from masonry.model.model import Model
from masonry.rows.columns import CRUSHING


def look_at_contacts(model: Model, seen: np.ndarray) -> float:
    """Fill seen (4, C): opening and slip (m), normal and shear stress (Pa); return the stored energy (J)."""
    law_parameters, joint_properties, states, bounds = model.groups
    return sum(
        contact.observe(
            law_parameters[g], joint_properties[g], states[g], bounds[g], bounds[g + 1], *model.contacts, seen
        )
        for g in range(len(law_parameters))
    )


def stored_in_contacts(model: Model) -> float:
    """Elastic energy (J) of the contacts of the undeformed shape."""
    return look_at_contacts(model, np.zeros((4, len(model.group))))


def crushing_of(model: Model) -> dict[str, float]:
    """J that crushing took in the contacts of the undeformed shape, under the name of its column; nothing where it is
    not modelled."""
    crushed = model.state.crushed
    return {} if crushed is None else {CRUSHING: float(model.joints.area @ crushed[:, 2])}


def taken_by_dashpots(model: Model) -> float:
    """J that the dashpots of the contacts of the undeformed shape took."""
    return 0.0 if model.dashpots is None else float(model.joints.area @ model.dashpots.taken)


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
