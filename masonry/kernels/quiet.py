"""Quiet boundaries: dashpots on the dofs of faces, Lysmer and Kuhlemeyer (1969), taken at the middle of the step.

Parts of their own, so that a scene without any compiles and calls nothing of this file.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from masonry.jit.compiled_parts import Call, CompiledPart
from masonry.jit.records import unpack


class QuietRows(NamedTuple):
    """Rows of dofs of one kind of bodies on which dashpots act.

    row, block  (K,) row of v, and of the works of its block
    drag        (K, n, n) N s/m, and the same of turns or strains: force for velocity
    answer      (K, n, n) (M/dt + drag/2)^-1 drag/2 of the dofs that are free: what a step takes off both velocities
    before      (K, n) velocities before the kick
    change      (K, n) room
    force       (K, n) N, of the dashpots at the last step
    """

    row: np.ndarray
    block: np.ndarray
    drag: np.ndarray
    answer: np.ndarray
    before: np.ndarray
    change: np.ndarray
    force: np.ndarray


def remembering(quiet: Sequence[QuietRows | None], bodies: Sequence[Any]) -> list[Call]:
    """Calls of quiet boundaries at the start of a step."""
    return [
        _remember.of(rows.row, rows.before, body.v)
        for rows, body in zip(quiet, bodies, strict=True)
        if rows is not None
    ]


def absorbing(quiet: Sequence[QuietRows | None], bodies: Sequence[Any], dt: float) -> list[Call]:
    """Calls of quiet boundaries at the end of a step."""
    return [
        _absorb.of(*rows, body.v, body.work, dt) for rows, body in zip(quiet, bodies, strict=True) if rows is not None
    ]


@CompiledPart
def _remember(record):
    row, before, v = unpack(record)
    for k in range(len(row)):
        for i in range(before.shape[1]):
            before[k, i] = v[row[k], i]


@CompiledPart
def _absorb(record):
    """M (v+ - v-)/dt = F - drag (v+ + v-)/2: v holds v- + dt F/M before, v+ after; the work goes to the damping."""
    row, block, drag, answer, before, change, force, v, work, dt = unpack(record)
    n = before.shape[1]
    for k in range(len(row)):
        for i in range(n):
            total = 0.0
            for j in range(n):
                total += answer[k, i, j] * (before[k, j] + v[row[k], j])
            change[k, i] = total
        for i in range(n):
            v[row[k], i] -= change[k, i]
        done = 0.0
        for i in range(n):
            total = 0.0
            for j in range(n):
                total -= 0.5 * drag[k, i, j] * (before[k, j] + v[row[k], j])
            done += before[k, i] * (total + force[k, i])
            force[k, i] = total
        work[block[k], 1] += 0.5 * dt * done
