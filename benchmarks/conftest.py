"""What `make bench` shows at its end and writes into bench.json besides the timings: figures, with reach and aim.

Figures of a machine are recorded and never fail; what can fail are the gates, and these are ratios.
"""

from collections.abc import Callable
from typing import NamedTuple

import pytest

from masonry.runtime.tables import columns

FIGURES: list["Figure"] = []
LEFT_OUT: dict[str, dict[str, float | None]] = {}


class Figure(NamedTuple):
    """One line of the table; reach and aim are upper limits in the same unit, or None."""

    row: str
    value: float
    unit: str
    reach: float | None = None
    aim: float | None = None
    spread: float | None = None  # of the rounds: upper quartile over the least, less 1
    least: bool = False  # reach and aim are lower limits

    def verdict(self) -> str:
        """How the value stands to its limits."""
        if self.reach is None:
            return ""
        sign = -1.0 if self.least else 1.0
        if self.aim is not None and sign * self.value <= sign * self.aim:
            return "aim kept"
        return "reached" if sign * self.value <= sign * self.reach else "MISSED"


@pytest.fixture
def figure() -> Callable[..., None]:
    """figure(row, value, unit, reach=None, aim=None, spread=None, least=False): a line of the table."""

    def add(*values, **named) -> None:
        FIGURES.append(Figure(*values, **named))

    return add


@pytest.fixture
def left_out() -> dict[str, dict[str, float | None]]:
    """scene -> {feature: share of a step that leaving it out saves, None where the scene uses it}: a second table."""
    return LEFT_OUT


def pytest_benchmark_update_json(config, benchmarks, output_json) -> None:
    """The figures go into bench.json beside the timings."""
    output_json["figures"] = [entry._asdict() for entry in FIGURES]
    output_json["left_out"] = LEFT_OUT


def pytest_terminal_summary(terminalreporter) -> None:
    """The tables."""
    if FIGURES:
        lines = [("", "measured", "spread", "reach", "aim", "")]
        for f in FIGURES:
            limits = ["" if x is None else f"{x:g}" for x in (f.reach, f.aim)]
            spread = "" if f.spread is None else f"+{100 * f.spread:.0f} %"
            lines.append((f.row, f"{f.value:.3g} {f.unit}", spread, *limits, f.verdict()))
        _write(terminalreporter, "figures", lines)
    if LEFT_OUT:
        features = list(next(iter(LEFT_OUT.values())))
        lines = [("", *features)]
        for scene, saved in LEFT_OUT.items():
            cells = ["used" if fraction is None else f"{100 * fraction:.0f} %" for fraction in saved.values()]
            lines.append((scene, *cells))
        _write(terminalreporter, "left out of the shipped scenes, and what of a step that saves", lines)


def _write(terminalreporter, title: str, lines: list[tuple[str, ...]]) -> None:
    terminalreporter.section(title)
    terminalreporter.write_line("\n".join(columns(lines)))
