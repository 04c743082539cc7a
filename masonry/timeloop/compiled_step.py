"""The compiled step of a model: made or loaded from the cache, and taken."""

import hashlib

import numpy as np

from masonry.configuration import energy
from masonry.configuration.chunk import Chunk
from masonry.configuration.configuration import configuration_of
from masonry.jit.compiler import is_kept, kind_of, once
from masonry.model.model import Model
from masonry.monitors.collisions.collision import compile_look
from masonry.runtime.interrupts import interruptible_wait
from masonry.runtime.processors import compiled_for


def compile_for(model: Model, threads: int) -> None:
    """Compile (or load from the cache) the step for exactly this model, without taking one.

    The compiler hears of no signal for long, and should not be cut off where a notebook goes on: it works in a thread.
    """

    def compile_step() -> None:
        configuration = configuration_of(model)
        configuration.advance(Chunk(np.zeros(1), np.zeros(1), False), threads, 0, 0, np.zeros(0))
        energy.observe(model)
        if not configuration.any_size:
            compile_look(model)

    with once(_kind(model, threads)):
        interruptible_wait(compile_step)


def is_compiled(model: Model, threads: int) -> bool:
    """Whether the step for such a model is there to be loaded."""
    return is_kept(_kind(model, threads))


def _kind(model: Model, threads: int) -> str:
    """The name of all models that one compiled step serves: on machines of a cluster that share a cache, others may be
    compiled for another processor."""
    parallel = True if threads > 1 else None
    kind = kind_of((parallel, model.damping, *model.step_arguments()))
    return hashlib.sha256(f"{kind} {compiled_for()}".encode()).hexdigest()[:16]


def advance_model(model: Model, chunk: Chunk, threads: int, first: int, steps: int, drive_force: np.ndarray) -> None:
    """Take some compiled steps of a chunk; drive_force (steps,) N out, after each."""
    configuration_of(model).advance(chunk, threads, first, steps, drive_force)
