"""The plan of a load, which answers for its kind. Each plan stands in one file with its loading."""

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from masonry.loading.loading import Expected, Loading
from masonry.loading.scheduled import Program
from masonry.model.damping import Damping
from masonry.model.gauges import Gauge
from masonry.model.model import Model


class Plan(Protocol):
    """Loading that a scene asks for, and how a run makes it: what others ask of a plan, whatever its kind."""

    @property
    def dead_load(self) -> np.ndarray:
        """(n,) share of the dead load at each step from the first on, those of the settling at least."""
        ...

    @property
    def layers(self) -> np.ndarray | None:
        """(L, settle + 1) share of each load that comes on in layers, until the end of the settling; None without."""
        ...

    @property
    def settle(self) -> int:
        """Steps in which the dead loads settle before anything else moves."""
        ...

    @property
    def ramp(self) -> int:
        """Steps after them in which the drive's velocity rises."""
        ...

    @property
    def hurries_while_elastic(self) -> bool:
        """Whether the drive is fast until the first damage, where that harms nothing."""
        ...

    @property
    def moves_at_once(self) -> bool:
        """Whether all moves from the first step on, as nothing has to settle."""
        ...

    def factors_at(self, steps: np.ndarray) -> np.ndarray | None:
        """(L + H, n) factors of the loads that vary, at some steps (n,); None where none are known beforehand."""
        ...

    def ends_before(self, steps: int) -> bool:
        """Whether a run of so many steps has ended before its plan has."""
        ...

    def settling(self) -> "Plan":
        """The plan of the dead loads alone, as long as they settle."""
        ...

    def settling_damping(self, damping: Damping) -> Damping:
        """The damping of a model (as of Model.damping) while its dead loads are tried alone."""
        ...

    def expected(self, model: Model, rows: int, axis: int | None) -> Expected:
        """Size of a run, with so many rows where rows are regular; axis (0, 1, 2) of the drive, None without one."""
        ...

    def loading(self, model: Model, rows: int, gauges: tuple[Gauge, ...] = ()) -> Loading:
        """How the load advances in a run. gauges: those that a row reads"""
        ...


@dataclass(frozen=True)
class PacedPlan:
    """The plan of a load that is paced by what the specimen does: what such plans have in common.

    dead_load  (settle + 1,) share of the dead load at each step before the load advances; its last value stays
    """

    dead_load: np.ndarray
    layers: np.ndarray | None = field(default=None, kw_only=True)

    ramp = 0
    hurries_while_elastic = False
    moves_at_once = False

    @property
    def settle(self) -> int:
        return len(self.dead_load) - 1

    @property
    def varies(self) -> int:
        """How many loads of the scene vary with it: they are none yet while the dead loads settle."""
        return 0

    def factors_at(self, steps: np.ndarray) -> np.ndarray | None:
        """Nobody knows them beforehand."""
        return None

    def ends_before(self, steps: int) -> bool:
        """It does not say in how many steps it is made."""
        return False

    def settling(self) -> Program:
        """The dead loads alone, as long as they settle."""
        varying = np.zeros((self.varies, self.settle + 1)) if self.varies else None
        return Program(self.dead_load, np.zeros(self.settle + 1), self.settle, 0, varying, layers=self.layers)

    def settling_damping(self, damping: Damping) -> Damping:
        """As it is in the run."""
        return damping
