"""Cost of the worst block: how much longer the time step would be without it."""

from dataclasses import dataclass

import numpy as np

from masonry.model.layout import KINDS, Layout


@dataclass(frozen=True)
class StepCost:
    """block: the one to blame; without: how many times longer the time step would be without it; usual: how many times
    longer if no block were worse than the median one."""

    block: int
    without: float
    usual: float


def step_cost(
    layout: Layout, sums: dict[str, np.ndarray], real: dict[str, np.ndarray], free: dict[str, np.ndarray], scaled: bool
) -> StepCost | None:
    """From row sums, real masses and free dofs by kind, as in stable_step.py; None where fewer than two blocks move.

    scaled: masses are scaled to one bound, so that the time step goes with the whole mass over the whole stiffness;
    otherwise the single worst dof sets it.
    """
    mass, stiffness, worst = (np.zeros(len(layout.kind)) for _ in range(3))
    for kind in KINDS:
        block = layout.owner[kind]
        mass += np.bincount(block, (real[kind] * free[kind])[:, :3].sum(axis=1), len(mass))
        stiffness += np.bincount(block, (sums[kind] * free[kind])[:, :3].sum(axis=1), len(mass))
        ratio = np.where(free[kind], sums[kind] / real[kind], 0.0).max(axis=1, initial=0.0)
        np.maximum.at(worst, block, ratio)
    moving = np.flatnonzero(worst > 0)
    if len(moving) < 2:
        return None
    if not scaled:
        squares = 1 / worst[moving]
        order = np.argsort(squares, kind="stable")
        least = squares[order[0]]
        return StepCost(
            int(moving[order[0]]),
            float(np.sqrt(squares[order[1]] / least)),
            float(np.sqrt(max(np.median(squares) / least, 1.0))),
        )
    moving = moving[mass[moving] > 0]
    if len(moving) < 2:
        return None
    m, k = mass[moving], stiffness[moving]
    without = (m.sum() - m) / np.maximum(k.sum() - k, 1e-300) * (k.sum() / m.sum())
    mended = np.minimum(k, m * np.median(k / m))
    blame = int(np.argmax(without))
    return StepCost(int(moving[blame]), float(np.sqrt(without[blame])), float(np.sqrt(k.sum() / mended.sum())))
