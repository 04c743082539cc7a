"""The numbers of a summary as criteria ask for them: what is missing, null or no number was not measured."""

import math
from collections.abc import Mapping
from typing import Any

Table = Mapping[str, Any]


class Evidence:
    """A summary to be judged."""

    def __init__(self, summary: Table) -> None:
        self.summary = summary

    def number(self, key: str) -> float | None:
        """The number at a dotted key, `energy_j.kinetic`; None where it was not measured."""
        table: Any = self.summary
        for name in key.split("."):
            table = table.get(name) if isinstance(table, Mapping) else None
        try:
            return None if math.isnan(table) else table
        except TypeError:
            return None

    def magnitude(self, key: str) -> float | None:
        """The same without its sign."""
        value = self.number(key)
        return None if value is None else abs(value)

    def table(self, key: str) -> Table:
        """The table of a key; an empty one where there is none."""
        table = self.summary.get(key)
        return table if isinstance(table, Mapping) else {}

    @property
    def in_real_time(self) -> bool:
        """Whether masses are real, and the run is a motion in time."""
        return bool(self.summary.get("in_real_time"))

    def accuracy(self, otherwise: float) -> float:
        """The accuracy that the drive was asked for; another number where none was."""
        value = self.number("control.accuracy")
        return otherwise if value is None else value

    @property
    def has_drive(self) -> bool:
        """Whether something is driven."""
        return has_drive(self.summary)

    @property
    def grows(self) -> bool:
        """Whether a load grew, or went to and fro, in search of a collapse."""
        return bool(self.table("collapse_load"))

    @property
    def falls(self) -> bool:
        """Whether something fell under that load."""
        return self.number("collapse_load.falls") is not None

    @property
    def branch(self) -> Table:
        """Outcome of the gauge that was to be controlled behind the collapse; empty without a collapse."""
        return Evidence(self.table("collapse_load")).table("branch") if self.falls else {}


def has_drive(summary: Table) -> bool:
    """Whether the run has a drive; True where the summary has no reactions to tell."""
    end = Evidence(summary).table("reactions").get("end")
    return not isinstance(end, Mapping) or "drive" in end
