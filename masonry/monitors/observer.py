"""Observer of a run: at each row of the history it is shown the specimen, and says what it found by name."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from masonry.configuration.energy import Seen
from masonry.model.model import Model
from masonry.runtime.state_file import State, attributes, load_attributes


@dataclass(frozen=True)
class View:
    """The specimen at a row.

    seen      what contacts show
    terms     the energy ledger (J), under the names of history.UNITS
    before    velocities one step earlier (energy.velocities)
    load_factors  of each dead load
    settling  whether the dead loads still settle
    rotation  the largest of any block so far, rad
    least, longest  det F and stretch of blocks that deform (energy.Observation)
    """

    seen: Seen
    terms: dict[str, float] = field(default_factory=dict)
    before: list[np.ndarray] = field(default_factory=list)
    load_factors: list[float] = field(default_factory=list)
    settling: bool = False
    rotation: float = 0.0
    least: float = 1.0
    longest: float = 1.0


class Observer:
    """Looks at each row; remembers the attributes that it names from one row to the next."""

    REMEMBERED: tuple[str, ...] = ()

    @property
    def has_fallen(self) -> bool:
        """Whether it has seen a block fall, as far as rows have shown."""
        return False

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        """Numbers of this row by name; raises Stopped where the run is not to be trusted any more."""
        raise NotImplementedError

    def found(self) -> dict[str, Any]:
        """Findings on the whole run, by name."""
        return {}

    def state(self) -> State:
        """State that it remembers."""
        return attributes(self, self.REMEMBERED)

    def restore(self, state: State) -> None:
        """Go on from there."""
        load_attributes(self, self.REMEMBERED, state)
