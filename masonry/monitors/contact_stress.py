"""The mean stress of rigid blocks, which have no strain: what the forces of their contacts come to."""

import numpy as np

from masonry.model.model import Model

PAIRS = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
"""xx yy zz yz xz xy"""


def contact_stress(model: Model) -> np.ndarray:
    """(R, 6) Pa, tension positive, in the order of the rigid blocks: the sum of force x arm over the volume.

    That is the mean stress of a block in equilibrium under its contacts and its weight (Love 1927, art. 123). Zero for
    blocks that are held or driven, where forces act whose places are not known; a traction on a block is missing in it.
    """
    rigid, layout, joints = model.bodies.rigid, model.layout, model.joints
    which = layout.members["rigid"]
    free = np.zeros(layout.volume.shape)
    free[which[(rigid.dt_over_mass > 0.0).all(axis=1)]] = 1.0
    force = model.contacts.force
    block = np.concatenate([joints.block_a, joints.block_b])
    arm = np.concatenate([joints.point, joints.point]) - layout.centroid[block]
    acting = np.concatenate([force, -force])
    sums = [0.5 * np.bincount(block, acting[:, i] * arm[:, j] + acting[:, j] * arm[:, i], len(free)) for i, j in PAIRS]
    stress: np.ndarray = np.stack(sums, axis=1)[which] * (free / layout.volume)[which, None]
    return stress
