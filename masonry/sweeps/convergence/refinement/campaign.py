"""Which runs of a scene tell its error: each resolution alone, then all that matter together, within a cost."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from geometry.blocks import Blocks, GeometryError, Joints
from masonry.errors import SceneError
from masonry.scene import Scene, changed
from masonry.sweeps.convergence.refinement.analyses import RUN, RefinedAnalysis
from masonry.sweeps.convergence.refinement.extrapolation import FLAT
from masonry.sweeps.convergence.refinement.resolutions import ALL_EDGES, ALONG, ONE_AXIS, PATCHES, Resolution

BASE, SCATTER, TOGETHER = "as it is", "scatter", "together"
DRAWN, RIGID = "drawn again", "stiffness of dry joints"
NOT_REFINED = (BASE, SCATTER, TOGETHER, DRAWN, RIGID)
"""Names of runs that tell the error of no single resolution; the last two differ by more than resolution."""
APART = 0.01
"""Relative difference of runs that differ in nothing, from which on they go apart: as far as their step or their pace
differ."""
JITTERS, MORE_APART = (1.01, 1.0 / 1.01, 1.02, 1.0 / 1.02, 1.03), 4
"""Factors of refinement that mean nothing, one after the other; and runs that differ in nothing, where these go apart,
besides the first."""
MATTERS = 0.1
"""Fraction of the largest change, below which one resolution is left out of the run of all together."""
SKEW = 1e-6
"""Gap of the sides of a parallelogram over its diagonal, beyond which it is none."""
COST, COST_OF_TETS = 6.0, 8.0
"""Times the scene itself that all other runs may take, where nothing else is said."""
ABOUT = 0.5
"""The same, by which a run may be too dear: it is a forecast."""


@dataclass(frozen=True)
class Refinement:
    """A run of a campaign.

    name      of its resolution, or one of NOT_REFINED
    factor    by which it is finer
    settings  by dotted key
    cost      expected, over that of the scene as it is
    members   of TOGETHER, the resolutions that are made finer, and by which factor
    at_edges  points from edge to edge of the joints, where it is these that are made finer
    """

    name: str
    factor: float
    settings: dict[str, Any]
    cost: float = 1.0
    members: tuple[tuple[str, float], ...] = ()
    at_edges: int | None = None

    @property
    def label(self) -> str:
        """Name of the run in lines for people."""
        if self.name in (BASE, SCATTER, DRAWN):
            return self.name
        if self.name == RIGID:
            return f"{self.name} times {self.factor:.3g}"
        return f"{self.name} {'finer' if self.factor > 1.0 else 'coarser'} by {max(self.factor, 1.0 / self.factor):.3g}"


class Campaign:
    """The runs of a scene, planned in rounds."""

    def __init__(self, scene: Scene, cost: float | None = None, analysis: RefinedAnalysis = RUN) -> None:
        """The cost is how many times the scene itself all other runs may take together."""
        self.scene, self.analysis = scene, analysis
        self.size = size = analysis.size(scene)
        self.limit = cost if cost is not None else COST_OF_TETS if size.has_tets else COST
        self.y_is_idle = not analysis.acts_along_y(scene) and _is_plane(size.blocks)
        along = ALL_EDGES if _have_other_shapes(size.joints) else ONE_AXIS
        self.resolutions = [
            resolution
            for resolution in analysis.resolutions(scene)
            if (not resolution.name.startswith(ALONG) or resolution.name in along)
            and self.trial(resolution, resolution.factors[0]) is not None
        ]

    def first(self) -> list[Refinement]:
        """The scene as it is, a run that differs in nothing of meaning, and each resolution alone: the cheapest of its
        runs in any case, others as far as the cost reaches."""
        base = Refinement(BASE, 1.0, {})
        trials = [base, self._again(JITTERS[0])] if self.analysis.scatters else [base]
        spent, others = float(self.analysis.scatters), []
        for resolution in self.resolutions:
            alone = [self.trial(resolution, factor) for factor in self._first_factors(resolution)]
            first, *dearer = sorted((trial for trial in alone if trial is not None), key=lambda trial: trial.cost)
            trials.append(first)
            spent += first.cost
            others += dearer
        for trial in sorted(others, key=lambda trial: trial.cost):
            if spent + trial.cost <= self.limit:
                trials.append(trial)
                spent += trial.cost
        return trials

    def _first_factors(self, resolution: Resolution) -> Sequence[float]:
        """A coarser one stands on the other side of the scene's, so that both tell the order at once."""
        return resolution.factors[:2] if resolution.factors[0] < 1.0 else resolution.factors[:1]

    def second(
        self, done: Sequence[Refinement], changes: Mapping[str, float], scatter: float, spent: float
    ) -> list[Refinement]:
        """The runs that tell most for the rest of the cost: all together, what matters once more, or scatter.

        changes  by name of a resolution, the largest relative change of an answer
        scatter  the same of the run that differs in nothing
        spent    cost of all other runs so far, over the scene itself
        """
        largest = max(changes.values(), default=0.0)
        remaining = self.limit - spent
        if largest <= FLAT * scatter:
            return self._within([*self._of_edges(done), *self._more_again(scatter, remaining)], remaining)
        finer = {r.name: r for r in self.resolutions if any(t.name == r.name and t.factor > 1.0 for t in done)}
        matter = [name for name in finer if changes.get(name, 0.0) > MATTERS * largest]
        trials = []
        if len(matter) > 1:
            trials.append(self._of_all([finer[name] for name in matter]))
        for name in sorted(matter, key=lambda name: -changes[name]):
            finest = max(t.factor for t in done if t.name == name)
            factor = next((factor for factor in finer[name].factors if factor > finest), None)
            trials += [] if factor is None else [self.trial(finer[name], factor)]
        return self._within(trials, remaining)

    def _of_edges(self, done: Sequence[Refinement]) -> list[Refinement | None]:
        """Points from edge to edge, which may move nothing until they are many, once more, the cheapest first."""
        tried = {trial.name for trial in done}
        again = [self.trial(r, r.factors[1]) for r in self.resolutions if r.at_edges is not None and r.name in tried]
        return sorted(again, key=lambda trial: 0.0 if trial is None else trial.cost)

    def _within(self, trials: Sequence[Refinement | None], remaining: float) -> list[Refinement]:
        """Those of some runs, in their order, that a cost reaches."""
        chosen = []
        for trial in trials:
            if trial is not None and trial.cost <= remaining + ABOUT:
                chosen.append(trial)
                remaining -= trial.cost
        return chosen

    def _again(self, factor: float) -> Refinement:
        """A run that differs in nothing of meaning."""
        return Refinement(SCATTER, 1.0, self.analysis.jitter(self.scene, factor))

    def _more_again(self, scatter: float, remaining: float) -> list[Refinement]:
        """More of these, within the rest of the cost; none where they do not differ at all."""
        count = 0 if scatter == 0.0 else MORE_APART if scatter > APART else 1
        return [self._again(factor) for factor in JITTERS[1 : 1 + min(count, int(remaining))]]

    def _of_all(self, resolutions: Sequence[Resolution]) -> Refinement | None:
        """All of these by two, or as far as mesh goes."""
        settings: dict[str, Any] = {}
        members = [(r, next(factor for factor in r.factors if factor > 1.0)) for r in resolutions]
        for resolution, factor in members:
            settings = merged(settings, resolution.settings(factor) or {})
        return self._costed(
            Refinement(TOGETHER, 2.0, settings, members=tuple((r.name, factor) for r, factor in members))
        )

    def trial(self, resolution: Resolution, factor: float) -> Refinement | None:
        """The run of one resolution; None where the scene does not take it, or nothing changes."""
        if resolution.name == "points along y" and self.y_is_idle:
            return None
        settings = resolution.settings(factor)
        if settings is None:
            return None
        at_edges = None if resolution.at_edges is None else resolution.at_edges(factor)
        return self._costed(Refinement(resolution.name, factor, settings, at_edges=at_edges))

    def _costed(self, trial: Refinement) -> Refinement | None:
        """With what it costs; None where the scene does not take it, or it changes nothing."""
        try:
            size = self.analysis.size(changed(self.scene, trial.settings))
        except (SceneError, GeometryError):
            return None
        is_of_joints = "point" in trial.name and trial.name != PATCHES
        if is_of_joints and size.contacts == self.size.contacts:
            return None
        return replace(trial, cost=size.seconds / self.size.seconds)


def _is_plane(blocks: Blocks) -> bool:
    """Whether all blocks reach from the same y to the same y."""
    y = blocks.points[:, 1]
    return len(np.unique(np.round((y - y.min()) / max(np.ptp(y), 1e-300), 9))) == 2


def _have_other_shapes(joints: Joints) -> bool:
    """Whether some joints are no parallelograms: the fewest points along any two axes count in these."""
    if np.any(np.diff(joints.patch_start) != 4):
        return True
    corner = joints.patch_points.reshape(-1, 4, 3)
    gap = np.linalg.norm(corner[:, 0] - corner[:, 1] + corner[:, 2] - corner[:, 3], axis=1)
    return bool(np.any(gap > SKEW * np.linalg.norm(corner[:, 2] - corner[:, 0], axis=1)))


def merged(first: dict[str, Any], second: dict[str, Any]) -> dict[str, Any]:
    """Settings of both; numbers of points by axis are the larger of each."""
    merged = dict(first)
    for key, value in second.items():
        if isinstance(value, dict) and key in merged:
            merged[key] = {axis: max(number, merged[key][axis]) for axis, number in value.items()}
        else:
            merged[key] = value
    return merged
