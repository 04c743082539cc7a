"""Which blocks have come loose: nothing that bears joins them to a block that is held or driven."""

import numpy as np

from masonry.configuration.parts.parts import parts_of
from masonry.model.model import Model


def loose_blocks(model: Model, bears: np.ndarray) -> np.ndarray:
    """(B,) whether each block is loose, by which contacts (C,) bear something; elements count as bearing."""
    joints, loose = model.joints, np.ones(model.blocks.count, dtype=bool)
    for part in parts_of(model):
        supported = (part.body.dt_over_mass[: len(part.owner)] == 0.0).any(axis=1)
        loose[part.owner[supported]] = False
    sides = np.column_stack([joints.block_a, joints.block_b])[bears]
    for links in (element.plan.links() for element in model.elements):
        ends_in_space = (links < 0).any(axis=1)
        loose[links[ends_in_space].max(axis=1)] = False
        sides = np.concatenate([sides, links[~ends_in_space]])
    changes = True
    while changes:
        reached = sides[loose[sides[:, 0]] != loose[sides[:, 1]]]
        changes = len(reached) > 0
        loose[reached] = False
    return loose
