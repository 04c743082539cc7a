"""Supports and loads of a specimen: force and moment of supports, drive and dead loads; work of the loads."""

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

import numpy as np

from masonry.configuration.parts.parts import parts_of
from masonry.model.layout import KINDS
from masonry.model.loads import Conditions, PointForce
from masonry.model.model import Model
from masonry.monitors.observer import Observer, View
from masonry.rows.history import Standing

FORCE, MOMENT, ALL = slice(0, 3), slice(3, 6), slice(None)
NO_SHIFT = np.zeros((0, 3)), np.zeros((0, 3))
Parts = dict[str, tuple[np.ndarray, np.ndarray]]
"""Per kind: rows of its dofs (n,), and for each the shares or loads of its dofs (n, dofs)."""


@dataclass(frozen=True)
class Outer:
    """Action on a specimen from outside: a support, the drive, or a dead load.

    parts   of a support or drive: 1 at the dofs that it holds; of a load: its generalised forces at a factor of 1
    varies  number of a load's history, None where its factor is that of the dead loads
    points  of a load: forces at points of rigid blocks, whose moments change in large displacement
    """

    name: str
    parts: Parts
    varies: int | None = None
    points: tuple[PointForce, ...] = ()


class Surroundings:
    """All that acts on a model from outside. A dof that several supports hold counts with the first of them."""

    def __init__(self, conditions: Conditions | None = None) -> None:
        self.holds: list[Outer] = []
        self.loads: list[Outer] = []
        if conditions is None:
            return
        taken = {kind: np.zeros_like(mask) for kind, mask in conditions.prescribed.items()}
        for name, masks in conditions.held_by.items():
            own = {kind: masks[kind] & ~taken[kind] for kind in KINDS}
            taken = {kind: taken[kind] | own[kind] for kind in KINDS}
            self.holds.append(Outer(name, _parts({kind: own[kind].astype(float) for kind in KINDS})))
        self.holds += [Outer(plan.environment, {}) for plan in conditions.elements if plan.environment is not None]
        for name, load in conditions.each_load.items():
            varies = next((k for k, varying in enumerate(conditions.varying) if varying is load), None)
            points = tuple(conditions.at_points.get(name, ()))
            self.loads.append(Outer(name, _parts(load), varies, points))

    def standing(
        self,
        model: Model,
        before: list[np.ndarray],
        force: np.ndarray,
        step: int,
        displacement: float,
        load_factors: list[float],
    ) -> Standing:
        """The forces now; `before`: velocities one step earlier; force (C, 3) N of the contacts on their side a;
        `load_factors` of the loads that act."""
        parts = {part.name: part for part in parts_of(model)}
        reactions, elements = np.zeros((len(self.holds), 6)), {one.plan.environment: one for one in model.elements}
        for k, one in enumerate(self.holds):
            if not one.parts and (element := elements.get(one.name)) is not None:
                reactions[k] = element.of_environment(parts.values())
            for kind, (rows, mask) in one.parts.items():
                reactions[k] += parts[kind].resultant(rows, mask * parts[kind].body.hold[rows])
        loads = self.resultants(model, load_factors)
        return Standing(step, displacement, reactions, loads, *of_motion(model, before), force)

    def resultants(self, model: Model, load_factors: list[float]) -> np.ndarray:
        """(L, 6) of the loads at their factors, where blocks are now."""
        acting, parts = np.zeros((len(self.loads), 6)), {part.name: part for part in parts_of(model)}
        for k, (one, load_factor) in enumerate(zip(self.loads, load_factors, strict=True)):
            for kind, (rows, load) in one.parts.items():
                acting[k] += load_factor * parts[kind].resultant(rows, parts[kind].load(rows, load))
        for k, (moments, _) in enumerate(self.shifts(model)):
            acting[k, MOMENT] += load_factors[k] * moments.sum(axis=0)
        return acting

    def shifts(self, model: Model) -> list[tuple[np.ndarray, np.ndarray]]:
        """Of each load, of its forces at points at a factor of 1: moments (P, 3) N m that they have besides those at
        the start, and turns (P, 3) rad of their blocks so far."""
        if not any(element.shifts_moments for element in model.elements):
            return [NO_SHIFT] * len(self.loads)
        return [shift_of(model, one.points) if one.points else NO_SHIFT for one in self.loads]

    def along(self, model: Model, axis: int | None) -> np.ndarray:
        """(L,) N: the force of each load along an axis at a factor of 1; none without an axis."""
        count = len(self.loads)
        return np.zeros(count) if axis is None else self.resultants(model, [1.0] * count)[:, axis]

    def elements_along(self, model: Model, axis: int | None) -> float:
        """N along an axis, of elements that support the blocks from outside; 0 without an axis or without such ones."""
        if axis is None:
            return 0.0
        supports = [one for one in model.elements if one.is_support and one.plan.environment is not None]
        return sum((float(one.of_environment(parts_of(model))[axis]) for one in supports), start=0.0)

    def moved(self, model: Model) -> np.ndarray:
        """(L,) J: what each load at a factor of 1 would have done on the way to where the specimen stands."""
        displacements = {part.name: part.displacements for part in parts_of(model)}
        work = np.zeros(len(self.loads))
        for k, one in enumerate(self.loads):
            for kind, (rows, load) in one.parts.items():
                work[k] += float(np.sum(load * displacements[kind][rows]))
        return work


def shift_of(model: Model, points: tuple[PointForce, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Moments (P, 3) N m that forces at points of rigid blocks have besides those at the start, and turns (P, 3) rad of
    these blocks so far."""
    body, rows = model.bodies.rigid, model.layout.local[[point.block for point in points]]
    arm, force = (np.array([getattr(point, name) for point in points]) for name in ("arm", "force"))
    rotation = np.einsum("pij,pj->pi", body.frame[rows] - np.eye(3), arm)
    shift = np.where([[point.fixed] for point in points], -body.q[rows, :3], rotation)
    return np.cross(shift, force), np.array(body.q[rows, 3:])


def _parts(values: dict[str, np.ndarray] | dict[str, np.ndarray | None]) -> Parts:
    """The rows that are not zero."""
    parts = {}
    for kind, array in values.items():
        if array is not None and len(rows := np.flatnonzero(np.any(array != 0.0, axis=1))):
            parts[kind] = rows, np.ascontiguousarray(array[rows])
    return parts


def of_motion(model: Model, before: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """(6,) of damping and (6,) of inertia, minus mass times acceleration, on all dofs that are free.

    Contacts and the blocks' own stresses add nothing to the sum over all blocks, and free dofs move by eq. (1): so
    reactions, loads, damping and inertia add up to 0 at every step, at rest or not. `before`: velocities a step ago.
    """
    damping, inertia = np.zeros(6), np.zeros(6)
    for part, old in zip(parts_of(model), before, strict=True):
        damping += part.resultant(ALL, np.where(part.free, part.body.hold, 0.0))
        inertia -= part.resultant(ALL, part.gained(old) / model.dt)
    return damping, inertia


@dataclass(frozen=True)
class WorkDone:
    """J by each load (L,): at the end, and at the end of the settling."""

    by_load: np.ndarray
    settling: np.ndarray

    @property
    def after_settling(self) -> np.ndarray:
        return np.asarray(self.by_load - self.settling)


class WorkOfLoads(Observer):
    """Work (J) of each load so far, by the trapezoid from row to row: exact while its factor stays as it is, and its
    moments about the centroids of rigid blocks do."""

    REMEMBERED = ("done", "settled", "moved", "load_factors", "by_shifts", "moments", "turns")

    def __init__(self, surroundings: Surroundings) -> None:
        self.surroundings = surroundings
        count, points = len(surroundings.loads), sum(len(load.points) for load in surroundings.loads)
        self.done, self.settled, self.moved, self.load_factors, self.by_shifts = np.zeros((5, count))
        self.moments, self.turns = np.zeros((2, points, 3))

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        moved, now = self.surroundings.moved(model), np.array(view.load_factors)
        if any(element.shifts_moments for element in model.elements):
            self._shift(model)
            moved = moved + self.by_shifts
        self.done = self.done + 0.5 * (now + self.load_factors) * (moved - self.moved)
        self.moved, self.load_factors = moved, now
        if view.settling:
            self.settled = self.done
        return {}

    def _shift(self, model: Model) -> None:
        """Add the work of the moments that changed as blocks moved, at factors of 1."""
        of_loads = self.surroundings.shifts(model)
        moments, turns = (np.concatenate([one[i] for one in of_loads]) for i in (0, 1))
        done = 0.5 * np.sum((moments + self.moments) * (turns - self.turns), axis=1)
        load = np.repeat(np.arange(len(of_loads)), [len(one[0]) for one in of_loads])
        self.by_shifts = self.by_shifts + np.bincount(load, done, len(of_loads))
        self.moments, self.turns = moments, turns

    def records(self) -> list[Any]:
        return [WorkDone(self.done, self.settled)]


def balance(holds: tuple[tuple[str, str], ...], loads: tuple[str, ...], standing: Standing) -> dict[str, Any]:
    """Force (N) and moment (N m, about the origin of the scene) of every support, the drive and every load, of damping
    and inertia, and the sum of all: 0 but for rounding; holds: name, and what it takes hold of.
    """
    forces: dict[str, Any] = {"step": standing.step, "displacement_m": standing.displacement}
    for (name, on), acts in zip(holds, standing.reactions, strict=True):
        forces[name] = {"on": on, **_words(acts)}
    for name, acts in zip(loads, standing.loads, strict=True):
        forces[name] = _words(acts)
    motion = standing.damping + standing.inertia
    forces |= {"damping": _words(standing.damping), "inertia": _words(standing.inertia)}
    forces["sum"] = _words(standing.reactions.sum(axis=0) + standing.loads.sum(axis=0) + motion)
    return forces


def open_by(standings: Collection[Standing], size: float, least: float = 0.0) -> float:
    """Residual of the sum of all forces, or of all moments over the size (m) of the specimen, as a share.

    Its measure is the largest force of all the moments in time that are given: one that has fallen to nothing by the
    end tells nothing of rounding. Where that is below `least` (N), as on what flies freely, it is `least`.
    """
    left = max((_largest(_all(one).sum(axis=0), size) for one in standings), default=0.0)
    return left / max(_scale(standings, size), least)


def moved_by(standing: Standing, standings: Collection[Standing], size: float) -> float:
    """Resultant of damping and inertia at one moment in time, measured alike: 0 at rest."""
    return _largest(standing.damping + standing.inertia, size) / _scale(standings, size)


def _all(standing: Standing) -> np.ndarray:
    return np.vstack([standing.reactions, standing.loads, standing.damping, standing.inertia])


def _scale(standings: Collection[Standing], size: float) -> float:
    """The largest force (N), or moment over the size; never 0."""
    return max((_largest(_all(one), size) for one in standings), default=0.0) or 1.0


def _largest(acts: np.ndarray, size: float) -> float:
    """Of forces and moments (..., 6): the largest component (N), of moments over a length (m)."""
    return float(max(np.abs(acts[..., FORCE]).max(), np.abs(acts[..., MOMENT]).max() / size))


def _words(acts: np.ndarray) -> dict[str, list[float]]:
    return {"force_n": acts[FORCE].tolist(), "moment_nm": acts[MOMENT].tolist()}
