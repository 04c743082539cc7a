"""Numbers of summary.json that were refined without end: a record for each of them."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import floor, log10

from masonry.rows.columns import GRAVITY
from masonry.runtime.record import Record, one_of, table_of
from masonry.runtime.tables import Rows

NUMERICAL_ERROR = "numerical_error"
"""The key of summary.json that holds them."""
LIMITS_OF_USE = (
    "The bar is the error of resolution alone: contact points, pace, mesh, time step.",
    "What the model leaves out, and how well its values are known, is not in it.",
)
"""Two sentences for whoever reads a bar."""
REFINED = "Without end: what the same model gives when it is refined without end, with its 95 % interval."
NOTHING = 1e-6
"""Half width over a number, below which it is shown as 0."""
OF_ROW = {
    "peak stress": ("peak_stress_pa", "", 1e-6, "MPa"),
    "displacement at peak": ("displacement_at_peak_m", "", 1e3, "mm"),
    "stress at the end": ("final_stress_pa", "", 1e-6, "MPa"),
    "load factor": ("collapse_load.borne", "", 1.0, ""),
}
"""By the word of a row of the summary: key of its number, words behind it, factor from SI and unit."""
OF_GAUGE = {
    "gauges.{}.at_peak_m": " at the peak",
    "gauges.{}.final_m": " at the end",
    "shaking.gauges.{}.peak": " at most",
    "shaking.gauges.{}.residual": " at the end",
}
"""Keys of the numbers of a gauge, and words behind them."""
UNITS = {"velocity": (1.0, "m/s"), "acceleration": (1 / GRAVITY, "g")}
"""Factor from SI and unit of gauges of a motion that are no displacements."""


@dataclass(frozen=True, eq=False)
class RefinedNumber(Record):
    """Of a number: its value without end, half the width of the 95 % interval around that, the observed order, and by
    name of a resolution what is missing in this run."""

    limit: float = 0.0
    half_width: float = 0.0
    order: float | None = None
    parts: dict[str, float] | None = None

    def interval(self, factor: float = 1.0, unit: str = "") -> str:
        """`0.9650 ± 0.0043 MPa`: the bar with two digits, the value with as many decimals."""
        limit, half = self.limit * factor, self.half_width * factor
        if half <= NOTHING * abs(limit):
            return f"{limit:.4g} \u00b1 0 {unit}".strip()
        decimals = 1 - floor(log10(half))
        shown = max(decimals, 0)
        return f"{round(limit, decimals):.{shown}f} \u00b1 {round(half, decimals):.{shown}f} {unit}".strip()


@dataclass(frozen=True, eq=False)
class RefinedNumbers(Record):
    """Numbers by dotted key; by name of a resolution how many times finer than in this run it was at most."""

    numbers: dict[str, RefinedNumber] | None = table_of(RefinedNumber)
    refined: dict[str, float] | None = None

    def of(self, key: str) -> RefinedNumber | None:
        """That of a dotted key; None where it has none."""
        return (self.numbers or {}).get(key)

    def with_bars(self, rows: Rows, quantities: Mapping[str, str]) -> Rows:
        """Rows of words on a run, each with the bars of its numbers in a line of its own; at last those of numbers
        that have no row, and what no bar says.

        quantities  of gauges in a motion, by their names: "displacement", "velocity" or "acceleration"
        """
        said: set[str] = set()

        def bars(word: str) -> list[str]:
            factor, unit = UNITS.get(quantities.get(word, ""), (1e3, "mm"))
            places = [(key.format(word), when, factor, unit) for key, when in OF_GAUGE.items()]
            intervals = []
            for key, when, factor, unit in [OF_ROW[word]] if word in OF_ROW else places:
                if (number := self.of(key)) is not None:
                    said.add(key)
                    intervals.append(f"{number.interval(factor, unit)}{when}")
            return [f"without end {', '.join(intervals)}"] if intervals else []

        rows = [(word, [*lines, *bars(word)]) for word, lines in rows if lines]
        others = [f"{key} {number.interval()}" for key, number in (self.numbers or {}).items() if key not in said]
        return [*rows, ("error bars", [REFINED, *LIMITS_OF_USE, *others])]


@dataclass(frozen=True, eq=False)
class Refined(Record):
    """How far numbers are from those without end; a key that runs alone have for which that was asked."""

    numerical_error: RefinedNumbers | None = one_of(RefinedNumbers)

    def __iter__(self) -> Iterator[str]:
        return (name for name in super().__iter__() if name != NUMERICAL_ERROR or self.numerical_error is not None)

    def __len__(self) -> int:
        return sum(1 for _ in self)
