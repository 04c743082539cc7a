"""May joints rock about points within their edges? A run says so of joints that did."""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.configuration.parts.parts import parts_of
from masonry.laboratory.remarks.edge_reach import rocking


def remarks(assembly: Assembly) -> list[str]:
    """A line for each contact group with such joints."""
    rotates, joints = may_rotate(assembly), assembly.joints
    which = rotates[joints.block_a] | rotates[joints.block_b]
    return [doubt.line for doubt in rocking(assembly, which, "turn, where they rock,")]


def may_rotate(assembly: Assembly) -> np.ndarray:
    """(B,) which blocks are free to rotate about some axis."""
    model, rotates = assembly.model, np.zeros(assembly.specimen.blocks.count, dtype=bool)
    for part in parts_of(model):
        rotates[part.blocks] = part.turns_about().any(axis=(1, 2))
    return rotates
