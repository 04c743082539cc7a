"""Observer of a run: at each row of the history it is shown the specimen; it says numbers of each row by name, and of
the whole run by records."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy as np

from masonry.configuration.energy import Seen
from masonry.model.model import Model
from masonry.runtime.state_file import State, attributes, load_attributes

Record = TypeVar("Record")


class ObserverRecords:
    """Records of observers on a whole run, each asked for by its type."""

    def __init__(self, records: Iterable[Any] = ()) -> None:
        self._records = {type(record): record for record in records}

    def __getitem__(self, kind: type[Record]) -> Record:
        """The record of a type that each run has."""
        return self._records[kind]

    def get(self, kind: type[Record]) -> Record | None:
        """The record of a type; None where no observer has one."""
        return self._records.get(kind)


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

    def records(self) -> list[Any]:
        """Records on the whole run, each of a type of its own."""
        return []

    def state(self) -> State:
        """State that it remembers."""
        return attributes(self, self.REMEMBERED)

    def restore(self, state: State) -> None:
        """Go on from there."""
        load_attributes(self, self.REMEMBERED, state)
