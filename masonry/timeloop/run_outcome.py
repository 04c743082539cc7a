"""Outcome of a run."""

from dataclasses import dataclass, field

import numpy as np

from masonry.loading.loading import LoadingOutcome
from masonry.monitors.collapse import Fallen
from masonry.monitors.events import Event
from masonry.monitors.observer import ObserverRecords
from masonry.rows.history import History, Standing
from masonry.rows.peak import before_a_collapse, borne, lowest_row, peak_row, turns_back
from masonry.runtime.processors import Seconds
from masonry.timeloop.around_peak import missed_between_rows


@dataclass
class Outcome:
    """What the loop found besides the rows: the peak seen at any step before a block had fallen, the share of the way
    through which it was borne until then, the share by which the force may have been higher between two steps, the
    largest force of a blow or after a fall (`blow`), and the lowest force; all but `blow` of rows where the drive
    turned back; the times; what observers said at each row, by their names for it, and of the whole run; what came of
    the loading; the sudden cracks; the forces from outside and of the contacts at the frames of the peak and of the
    end.
    """

    history: History
    peak_force: float = 0.0
    displacement_at_peak: float = 0.0
    borne_through: float = 1.0
    missed_between_steps: float | None = None
    blow: float = 0.0
    lowest_force: float = 0.0
    displacement_at_lowest: float = 0.0
    seconds_run: Seconds = Seconds()
    seconds_compile: Seconds = Seconds()
    observed: dict[str, np.ndarray] = field(default_factory=dict)
    records: ObserverRecords = field(default_factory=ObserverRecords)
    steps: int = 0
    interrupted: bool = False
    stopped: str = ""
    loading: LoadingOutcome = field(default_factory=LoadingOutcome)
    events: list[Event] = field(default_factory=list)
    standing: dict[str, Standing] = field(default_factory=dict)
    log: list[str] = field(default_factory=list)

    @property
    def standing_rows(self) -> dict[str, np.ndarray]:
        """The rows at which no block had fallen, and that at which the first one had."""
        fallen = self.records.get(Fallen)
        return before_a_collapse(self.history.rows, None if fallen is None else fallen.step)

    def take_extremes_of_rows(self) -> None:
        """Where the drive turned back, its extremes are rows of the curve: between two of them a blow of one step, as
        blocks part or meet in a quick passage, may be far off the curve, and is no strength."""
        rows = self.standing_rows
        if not turns_back(rows.get("displacement", np.zeros(0))):
            return
        peak, lowest = peak_row(rows), lowest_row(rows)
        force, place = borne(rows, "force"), rows["displacement"]
        self.missed_between_steps = missed_between_rows(place, force, peak)
        self.peak_force, self.displacement_at_peak = float(force[peak]), float(place[peak])
        self.lowest_force, self.displacement_at_lowest = 0.0, 0.0
        if force[lowest] < 0.0:
            self.lowest_force, self.displacement_at_lowest = float(force[lowest]), float(place[lowest])
