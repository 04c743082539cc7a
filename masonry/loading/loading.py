"""How a load advances, chunk by chunk: what the time loop asks of a loading, and what comes of it."""

from abc import ABC, abstractmethod
from typing import Any, NamedTuple

import numpy as np

from masonry.configuration.chunk import Chunk
from masonry.configuration.energy import Seen
from masonry.monitors.events import Event
from masonry.runtime.progress import Effort
from masonry.runtime.state_file import Remembering

Arrays = dict[str, np.ndarray]
Rows = dict[str, np.ndarray]


class Expected(NamedTuple):
    """About what a run will take: steps, rows of its curve, chunks of steps, and looks at the whole specimen besides;
    and how many times as much at least and at most, where the specimen has a say in it."""

    steps: int
    rows: int
    chunks: float = 0.0
    looks: float = 0.0
    least: float = 1.0
    most: float = 1.0


class LoadingOutcome:
    """Outcome of a loading. That of a program is empty.

    borne, falls  of a load that grew: the factor that was borne last, and the least that was not; None without them
    """

    borne: float | None = None
    falls: float | None = None

    def control(self) -> dict[str, float]:
        """How the load was controlled: what was asked for, and what was reached."""
        return {}

    def collapse_load(self, rows: Rows, sets: dict[str, np.ndarray]) -> dict[str, Any] | None:
        """Of a load that was to collapse; None of others. sets: numbers of blocks, by name"""
        return None


class Loading(Remembering, ABC):
    """How the load of a run advances: the time loop takes one chunk after the other until there is none.

    REMEMBERED, parts  all that the next chunk depends on, but for the model (runtime/state_file): a checkpoint keeps it
    """

    @abstractmethod
    def next(self) -> Chunk | None:
        """The next chunk; None at the end."""

    @abstractmethod
    def load_factors(self) -> np.ndarray:
        """(H,) of the loads that vary, now."""

    @abstractmethod
    def progress(self) -> tuple[int, int]:
        """How much is done, and of how much."""

    def effort(self) -> Effort:
        """How much work is done and left: the same, where each part takes about as long."""
        now, whole = self.progress()
        return Effort(now, whole - now, whole - now)

    def feel(self, step: int, before: list[np.ndarray]) -> None:
        """Look at the specimen after each chunk; `before`: velocities one step before this one."""
        return None

    def counted(self, before: list[np.ndarray], path: np.ndarray, force: np.ndarray) -> np.ndarray:
        """Of the forces (n,) N of the drive, signed, at the steps of a chunk, at places (n,) m, so much as counts for
        its peak; before: as of `feel`."""
        return force

    def look(self, force: float, support: float, seen: Seen, terms: dict[str, float]) -> None:
        """Look at each row: forces of drive and support (N), what contacts show, and the ledger (J)."""
        return None

    def columns(self) -> dict[str, float]:
        """Additional values of a row, by the names of their columns."""
        return {}

    def turned_too_far(self) -> bool:
        """A block has turned further than small displacement allows: whether the run goes on nevertheless."""
        return False

    def moved_too_far(self) -> bool:
        """Blocks have crushed, slid or met further than can be told, at a row: whether that is but the end of a fall
        that was followed, and of the run."""
        return False

    @property
    def events(self) -> list[Event]:
        """The sudden cracks so far."""
        return []

    def outcome(self, peak: float) -> LoadingOutcome:
        """Outcome so far; peak: N, the largest force of the drive at any step, signed as `look` is shown it."""
        return LoadingOutcome()
