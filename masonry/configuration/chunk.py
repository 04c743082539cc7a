"""Some steps that are taken without a look at them."""

from dataclasses import dataclass

import numpy as np

from masonry.kernels.shaking import MovedSupports


@dataclass(frozen=True)
class Chunk:
    """Some steps: share of the dead load (n + 1,) and speed of the drive (n + 1,) m/s, before and after each step.

    row    whether a row of the history is due after it
    place  m, signed: where the drive is after it, if that is known better than the sum of the speeds
    base   (n + 1, C) m/s, velocities of supports that move, each component, before and after each step; None without
    """

    dead_load: np.ndarray
    speed: np.ndarray
    row: bool
    place: float | None = None
    base: np.ndarray | None = None

    @property
    def steps(self) -> int:
        return len(self.speed) - 1


def begin_at(supports: MovedSupports | None, chunk: Chunk, step: int) -> None:
    """Hand supports that move the velocities of a chunk, of which a step is next; they rest where it has none."""
    if supports is not None:
        supports.begin(supports.at_rest(chunk.steps) if chunk.base is None else chunk.base, step)
