"""Supports and floor that move with the ground: after each step they get the velocities of the next one.

Parts of their own, so that a scene whose supports rest compiles and calls nothing of this file.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from masonry.jit.compiled_parts import Call, CompiledPart
from masonry.jit.records import unpack

ROOM = 512
"""Steps of a chunk, at most."""


class MovedSupports(NamedTuple):
    """Supports that move with the ground.

    dofs      by kind of bodies, (K, 3) row and number of each dof and the column of its velocity; None without
    velocity  (ROOM, C) m/s of each component, before the first step of a chunk and after each
    now       (1,) row of the velocities after the step that is next
    """

    dofs: tuple[np.ndarray | None, ...]
    velocity: np.ndarray
    now: np.ndarray

    def at_rest(self, steps: int) -> np.ndarray:
        """(steps + 1, C) m/s."""
        return np.zeros((steps + 1, self.velocity.shape[1]))

    def begin(self, velocity: np.ndarray, step: int) -> None:
        """Velocities (n + 1, C) m/s of a chunk, of which a step (from 0 on) is next."""
        self.velocity[: len(velocity)] = velocity
        self.now[0] = step + 1


def shaking(supports: MovedSupports, bodies: Sequence[Any]) -> list[Call]:
    """What the ground does to the bodies that it moves."""
    pairs = [(body, dofs) for body, dofs in zip(bodies, supports.dofs, strict=True) if dofs is not None]
    moves = [_carry.of(body.v, dofs, supports.velocity, supports.now) for body, dofs in pairs]
    return [*moves, _pass.of(supports.now)]


@CompiledPart
def _carry(record):
    v, dofs, velocity, now = unpack(record)
    for k in range(len(dofs)):
        v[dofs[k, 0], dofs[k, 1]] = velocity[now[0], dofs[k, 2]]


@CompiledPart
def _pass(record):
    (now,) = unpack(record)
    now[0] += 1
