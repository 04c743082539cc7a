"""How near the contacts are to leaving their elastic answer for the first time."""

import numpy as np

from masonry.kernels.patches import deepest
from masonry.model.model import Model
from masonry.monitors.energy import Seen


def utilisation(model: Model, seen: Seen, rest: np.ndarray) -> float:
    """Largest share of its strength that a contact uses, in tension or in shear; at 1 it tears, slips or opens.

    rest  (C,) Pa, normal stress under the dead loads alone: a joint without tensile strength opens when that has gone
    """
    _, joint_properties, _, bounds = model.groups
    most = 0.0
    for g, joint in enumerate(joint_properties):
        if joint.tensile_strength is None:
            continue
        span = slice(bounds[g], bounds[g + 1])
        sigma, tau = seen.sigma[span], seen.tau[span]
        strength = joint.cohesion - sigma * joint.tan_friction
        in_shear = np.where(tau > 0.0, np.divide(tau, strength, out=np.ones_like(tau), where=strength > 0.0), 0.0)
        capacity = joint.tensile_strength - np.minimum(rest[span], 0.0)
        gained = sigma - np.minimum(rest[span], 0.0)
        in_tension = np.divide(gained, capacity, out=np.ones_like(sigma), where=capacity > 0.0)
        most = max(most, float(in_shear.max(initial=0.0)), float(in_tension.max(initial=0.0)))
    return min(most, 1.0)


def pressed(model: Model) -> float:
    """How far (m) patches are pressed together at most: about as far a block moves until its faces part."""
    assert model.large is not None
    near = model.large.near
    return float(deepest(near, np.ones(len(near.pieces.body)))[0])
