"""The compiled step of a model: made or loaded from the cache, and taken."""

import numpy as np

from masonry.configuration import energy
from masonry.configuration.chunk import Chunk
from masonry.configuration.configuration import configuration_of
from masonry.configuration.setting_off import damp, phases
from masonry.kinematics.shared import SHARED
from masonry.model.model import Model
from masonry.monitors.collisions.collision import compile_look
from masonry.runtime.interrupts import interruptible_wait


def compile_for(model: Model, threads: int) -> None:
    """Compile (or load from the cache) the step for exactly this model, without taking one.

    The compiler hears of no signal for long, and should not be cut off where a notebook goes on: it works in a thread.
    """

    def compile_step() -> None:
        configuration = configuration_of(model)
        for settled in phases(model):
            damp(model, settled)
            configuration.advance(Chunk(np.zeros(1), np.zeros(1), False), threads, 0, 0, np.zeros(0))
        energy.observe(model)
        if not configuration.any_size:
            compile_look(model)

    interruptible_wait(compile_step)


def is_compiled(model: Model, threads: int) -> bool:
    """Whether all parts of the step of such a model are there to be loaded."""
    compiled = []
    for settled in phases(model):
        damp(model, settled)
        compiled.append(configuration_of(model).program(threads, np.zeros(SHARED)).is_compiled)
    return all(compiled)


def advance_model(model: Model, chunk: Chunk, threads: int, first: int, steps: int, drive_force: np.ndarray) -> None:
    """Take some compiled steps of a chunk; drive_force (steps,) N out, after each."""
    configuration_of(model).advance(chunk, threads, first, steps, drive_force)
