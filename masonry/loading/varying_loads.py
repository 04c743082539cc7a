"""Loads that vary, each by a history of its own: straight from chunk to chunk, by one array of changes for all."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from masonry.configuration.parts.parts import parts_of
from masonry.model.model import Model
from masonry.rows.rest_criterion import LONE

STRETCH = 200
"""Steps between two knots, at most."""


def knots(load_factors: np.ndarray, settle: int, straight: float, kinks: Sequence[int] | np.ndarray = ()) -> np.ndarray:
    """Steps, rising, between which each row (H, n + 1) is taken for straight: at most STRETCH apart, at the end of the
    settling and at all `kinks`; one apart where the factors bend too much from step to step.

    straight  of the largest factor of a history: how far it may leave the straight line between two knots
    """
    last = load_factors.shape[1] - 1
    at = np.unique(np.concatenate([[0], np.arange(settle, last, STRETCH), kinks, [last]]).astype(np.int64))
    while True:
        apart = np.zeros(last)
        for load_factor in load_factors:
            most = float(np.abs(load_factor).max()) or 1.0
            line = np.interp(np.arange(last), at, load_factor[at])
            apart = np.maximum(apart, np.abs(load_factor[:-1] - line) / most)
        bent = (np.maximum.reduceat(apart, at[:-1]) > straight) & (np.diff(at) > 1)
        if not bent.any():
            return at
        at = np.union1d(at, (at[:-1] + at[1:])[bent] // 2)


def works_of(model: Model, moved: dict[str, np.ndarray]) -> np.ndarray:
    """(H,) J, what each load that varies does at a load factor of 1 as dofs (by kind, rows of each) move so far."""
    return np.array(
        [
            sum(float(np.sum(load * moved[k])) for k, load in one.items() if load is not None and k in moved)
            for one in model.varying
        ]
    )


def _at_points(model: Model) -> list[tuple[Any, np.ndarray]]:
    """Forces of elements and (H, ...) N those of each load, where some loads vary."""
    return [each for element in model.elements for each in element.varying()] if model.varying else []


class SharedLoads:
    """Loads that pass from some factors to others within a chunk, in proportion to its steps."""

    def __init__(self, model: Model, stay: int = 0) -> None:
        """So many of them, the first, may `stay`: they act in full and vary no more."""
        self.model, self.parts = model, []
        for part in parts_of(model):
            body, rows = part.body, np.arange(len(part.body.v))
            if body.change is not None:
                loads = [one[part.name] for one in model.varying]
                each = [np.zeros(body.load.shape) if load is None else part.load(rows, load) for load in loads]
                at_once, vary = np.array(each[:stay]), np.array(each[stay:])
                self.parts.append((body, body.load + at_once.sum(axis=0), vary))
        self.at_points = [
            (points, points.load + each[:stay].sum(axis=0), each[stay:]) for points, each in _at_points(model)
        ]
        self.passed = np.zeros(0)

    def rest_over_each(self) -> float:
        """Sum of the forces of the loads that stay over that of the greatest that varies; or, where that is less,
        `LONE` times the same of a block that both act on."""
        rest = sum(float(np.abs(rest[:, :3]).sum()) for _, rest, _ in self.parts)
        whole = rest / max(sum(np.abs(each[:, :, :3]).sum(axis=(1, 2)) for _, _, each in self.parts).max(), 1e-300)
        return min(whole, LONE * min(map(self._least, self.parts), default=whole))

    def _least(self, part: tuple[Any, np.ndarray, np.ndarray]) -> float:
        """The least of the same shares of the blocks of a kind that both act on; infinite where there are none."""
        body, rest, each = part
        bodies = next(one for one in parts_of(self.model) if one.body is body)
        stays, varies = (bodies.sums(np.abs(f[..., :3]).sum(axis=-1).T) for f in (rest, each))
        both = (stays > 0.0)[:, None] & (varies > 0.0)
        return float(np.min(np.broadcast_to(stays[:, None], both.shape)[both] / varies[both], initial=np.inf))

    def pass_over(self, begin: np.ndarray, end: np.ndarray, steps: int) -> np.ndarray:
        """Set the loads of the bodies for so many steps from factors (H,) to others; returns (steps + 1,) what they add
        to the factors of the dead load."""
        factors = np.stack([begin, end - begin])[:, None]
        for body, rest, each in (*self.parts, *self.at_points):
            load, change = factors @ each.reshape(len(each), -1)
            body.load[...] = rest + load.reshape(rest.shape)
            body.change[...] = change.reshape(rest.shape)
        if len(self.passed) != steps + 1:
            self.passed = np.linspace(0.0, 1.0, steps + 1)
        return self.passed


class VaryingLoads(SharedLoads):
    """Loads that pass from their factors at the start of a chunk to those at its end.

    Within a chunk each load changes in proportion to the steps, so the step itself needs no more than the loads at the
    start and their change, however many histories there are. A chunk ends at the next knot of the histories at the
    latest, and one that ends before, as a row is due, leaves the line from knot to knot as it is.
    """

    def __init__(self, model: Model, load_factors: np.ndarray, settle: int, straight: float, kinks: np.ndarray) -> None:
        super().__init__(model)
        self.settle, self.knots = settle, knots(load_factors, settle, straight, kinks)
        steps = np.arange(load_factors.shape[1])
        self.load_factors = np.array(
            [np.interp(steps, self.knots, load_factor[self.knots]) for load_factor in load_factors]
        )

    def latest(self, first: int) -> int:
        """The step at which a chunk from a step on ends at the latest."""
        knot = int(self.knots[np.searchsorted(self.knots, first, side="right")])
        return min(first + STRETCH, knot)

    def apply(self, first: int, last: int, dead_load: np.ndarray) -> np.ndarray:
        """Set the loads of the bodies for a chunk of steps; returns its shares of the dead load, those of the change
        included."""
        passed = self.pass_over(self.load_factors[:, first], self.load_factors[:, last], last - first)
        return dead_load if first < self.settle else dead_load + passed
