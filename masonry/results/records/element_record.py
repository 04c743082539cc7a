"""What summary.json says of elements: a record for each kind of them."""

from dataclasses import dataclass, fields

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

    @property
    def words(self) -> str:
        """The greatest forces of bars, and how many of them yielded."""
        pushed = (
            f", {self.least_force_n / 1e3:.4g} kN at least (bar {self.least_of})" if self.least_force_n < 0.0 else ""
        )
        yielded = f"{self.yielded} of {self.count} yielded, by up to {1e3 * self.longest_plastic_m:.3g} mm"
        return (
            f"{self.largest_force_n / 1e3:.4g} kN at most (bar {self.largest_of}){pushed}; "
            f"{yielded if self.yielded else 'none yielded'}"
        )


@dataclass(frozen=True, eq=False)
class WithElements(Record):
    """The keys of summary.json that a run with elements fills, by their names."""

    bars: BarRecord | None = one_of(BarRecord)

    @property
    def words_on_elements(self) -> dict[str, str]:
        """By the name of each element that a run had, what it did."""
        records = ((entry.name, getattr(self, entry.name)) for entry in fields(WithElements))
        return {name: record.words for name, record in records if record}
