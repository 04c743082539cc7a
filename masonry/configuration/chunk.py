"""Some steps that are taken without a look at them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from masonry.elements.element import ElementCalls, Elements
from masonry.jit.compiled_parts import StepCalls


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


def begin_at(elements: Elements, chunk: Chunk, step: int) -> None:
    """Hand the elements a chunk, of which a step is next."""
    for element in elements:
        element.begin(chunk.steps, chunk.base, step)


def with_calls(step: StepCalls, of_elements: Sequence[ElementCalls]) -> StepCalls:
    """A step with what elements begin and end it with."""
    begins = [call for calls in of_elements for call in calls.begins]
    return step.around(begins, [call for calls in of_elements for call in calls.ends])
