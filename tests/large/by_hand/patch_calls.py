"""What the step and rows ask of patches, called from Python."""

import numpy as np

from masonry.jit.compiled_parts import RepeatedCall
from masonry.patches import measures
from masonry.patches.arrays import Near
from masonry.patches.press import press as rigid
from masonry.patches.press_deforming import press_deforming as deforming

RIGID, DEFORMING = RepeatedCall(rigid), RepeatedCall(deforming)
"""Put together once for the same arrays: that takes milliseconds, and tests press thousands of times."""


def press(near: Near, dt: float) -> None:
    """Forces of patches between rigid blocks, into near.motion.push."""
    RIGID.of(near, dt)()


def press_deforming(near: Near, dt: float) -> None:
    """Forces of patches between blocks of which some deform, into near.motion.push."""
    DEFORMING.of(near, dt)()


def stored_energy(near: Near) -> float:
    """J."""
    energy = np.zeros(1)
    measures.stored_energy.of(near, energy)()
    return float(energy[0])


def deepest(near: Near, width: np.ndarray) -> float:
    """The deepest overlap over the width (B,) m of the thinner block."""
    overlap, pair = np.zeros(1), np.zeros(1, dtype=np.int64)
    measures.deepest.of(near, width, overlap, pair)()
    return float(overlap[0])
