"""Two files of records: which numbers moved by more than their tolerance, and what became slower or faster."""

from dataclasses import dataclass
from typing import Any

from verification.case import BOUND
from verification.records import Record, version_of

SLOWER = 1.5
FELT = 0.1
"""Seconds: times that differ by less are not told apart."""
UNTOLD = 0.01
"""The tolerance of a record that has none, as those of the problems: a hundredth of the reference."""


@dataclass(frozen=True)
class Change:
    """Change of one record against its older self; `bad` where a number moved, or a case no longer holds."""

    where: str
    sentence: str
    bad: bool


def last_version(records: list[Record], but: tuple[str, str] | None = None) -> list[Record]:
    """The records of the version that was written last; of the last one that is not `but` where there are others."""
    versions = list(dict.fromkeys(version_of(r) for r in records))
    others = [v for v in versions if v != but] or versions
    return [r for r in records if others and version_of(r) == others[-1]]


def compare(old: list[Record], new: list[Record]) -> list[Change]:
    """Every change that counts, in the order of the new records; what only one of the two has comes last."""
    before, after = ({_key(r): r for r in records} for records in (old, new))
    changes = [change for key, r in after.items() if key in before for change in _number(before[key], r)]
    times_before, times_after = _times(before), _times(after)
    if {r.get("processor") for r in old} == {r.get("processor") for r in new}:
        for where, seconds in times_after.items():
            changes += _time(where, times_before.get(where), seconds)
    covered = {r["case"] for r in new}
    changes += [Change(_where(r), "is new", False) for key, r in after.items() if key not in before]
    gone = [r for key, r in before.items() if key not in after and r["case"] in covered]
    return changes + [Change(_where(r), "is no longer measured", True) for r in gone]


def _key(record: Record) -> tuple[Any, ...]:
    names = ("chapter", "case", "quantity", "knob", "rung")
    return (*(record.get(name) for name in names), str(record.get("knobs") or ""))


def _where(record: Record) -> str:
    parts = (record["case"], record.get("knob"), record.get("rung"), record.get("quantity"))
    return ", ".join(str(part) for part in parts if part)


def _number(old: Record, new: Record) -> list[Change]:
    """At most one change: the status, or the value; a bound holds or not, and no move within it counts."""
    if old.get("status") != new.get("status"):
        worse = new.get("status") not in ("PASS", "OK")
        reason = f" ({new['reason']})" if new.get("reason") else ""
        return [Change(_where(new), f"was {old.get('status')}, is {new.get('status')}{reason}", worse)]
    value, was = new.get("value"), old.get("value")
    if value is None or was is None or new.get("kind_of_reference") == BOUND:
        return []
    tolerance = new.get("tolerance")
    limit = UNTOLD if tolerance is None else tolerance
    scale = abs(new.get("scale") or new.get("reference") or was or 1.0)
    moved = (value - was) / scale
    if abs(moved) <= limit:
        return []
    sentence = f"moved from {was:.7g} to {value:.7g} {new.get('unit', '')}, by {moved:+.1e}; tolerance {limit:.0e}"
    return [Change(_where(new), sentence, True)]


def _times(records: dict[tuple[Any, ...], Record]) -> dict[str, float]:
    """Seconds by case, or by setting where a record has one; of stepping alone where known: compiling tells nothing."""
    times: dict[str, float] = {}
    for r in records.values():
        seconds = r["seconds_stepping"] if "seconds_stepping" in r else r.get("seconds")
        if seconds:
            times[_where({**r, "quantity": None})] = seconds
    return times


def _time(where: str, was: float | None, seconds: float) -> list[Change]:
    if was is None or abs(seconds - was) < FELT or 1.0 / SLOWER <= seconds / was <= SLOWER:
        return []
    word = "slower" if seconds > was else "faster"
    return [Change(where, f"is {max(seconds / was, was / seconds):.2g} times {word}: {was:.2g} s, now {seconds:.2g} s",
                   False)]  # fmt: skip
