"""What summary.json says of bars."""

from dataclasses import dataclass

from masonry.runtime.record import Record, one_of


@dataclass(frozen=True, eq=False)
class BarRecord(Record):
    """The greatest and the least force of any bar at any step, and of which bar; how many yielded, by how much the
    one that did most was longer at the end, and by how much each was."""

    count: int = 0
    largest_force_n: float = 0.0
    largest_of: int = 0
    least_force_n: float = 0.0
    least_of: int = 0
    yielded: int = 0
    longest_plastic_m: float = 0.0
    plastic_m: list[float] | None = None


@dataclass(frozen=True, eq=False)
class WithBars(Record):
    """The key of summary.json that a run with bars fills."""

    bars: BarRecord | None = one_of(BarRecord)
