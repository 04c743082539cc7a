"""Lines above the numbers of a record: samples, the time from one to the next, their unit."""

import re
from typing import NamedTuple

from masonry.errors import SceneError, visible
from masonry.ground.records.motion_units import is_unit
from masonry.ground.records.number_cells import number_of

_NUMBER = r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[EeDd][-+]?\d+)?)"
_THOUSANDTHS = r"(?![\d.])(?:\s*(ms)(?:ec)?\b)?"
_OF_SECONDS = r"\s*(?:[(\[]\s*s(?:ec)?\s*[)\]])?\s*[=:]?\s*"
_COUNTS = (
    r"\b(?:NPTS|NDATA)\s*[=:]?\s*(\d+)",
    rf"(\d+)\s*,?\s+(?:{_NUMBER}\s*,?\s+)?NPTS\b",
    r"\bnumber of (?:points|samples|data(?: points)?)\s*[=:]\s*(\d+)",
)
_STEPS = (
    rf"\b(?:DT|TSTEP|time step|sampling[_ ]interval\w*){_OF_SECONDS}{_NUMBER}{_THOUSANDTHS}",
    rf"\d+\s*,?\s+{_NUMBER}\s*,?\s+NPTS\s*,?\s+DT\b()",
    rf"\bequal(?:ly)?\s+spac\w+\s+(?:of|at)\s+{_NUMBER}{_THOUSANDTHS}",
)
_RATE = re.compile(rf"\bsampling (?:rate|freq\w*)\s*(?:\(\s*Hz\s*\))?\s*[=:]?\s*{_NUMBER}", re.IGNORECASE)
_UNIT = re.compile(r"\bUNITS?\b(\s+(?:OF|ARE|IN|IS))?\s*[=:]?\s*[(\[]?\s*([A-Za-z][A-Za-z0-9/^*²]*)", re.IGNORECASE)
LONGEST_LINE = 1000
"""Letters of a line of a head that are looked at."""


class RecordHead(NamedTuple):
    """Samples, the time from one to the next (s), and their unit, each None where a head does not say it."""

    samples: int | None
    step: float | None
    unit: str | None


def head_of(name: str, lines: list[str]) -> RecordHead:
    """Data in the lines of a head. Raises SceneError where they are given twice and not alike."""
    lines = [line[:LONGEST_LINE] for line in lines]
    count = _one(name, "samples", [_searched(_COUNTS, line) for line in lines])
    steps = [_step_in(line) for line in lines]
    step = _one(name, "s from sample to sample", steps)
    return RecordHead(None if count is None else int(count), step, _unit(lines))


def _unit(lines: list[str]) -> str | None:
    """A unit of a motion, or what a head says to be its units in so many words."""
    words = [(match[1], match[2].lower()) for line in lines if (match := _UNIT.search(line))]
    said = next((word for _, word in words if is_unit(word)), None)
    return said or next((word for link, word in words if link), None)


def _searched(patterns: tuple[str, ...], line: str) -> float | None:
    for pattern in patterns:
        if match := re.search(pattern, line, re.IGNORECASE):
            number = number_of(match[1])
            scale = 1e-3 if match.lastindex and match.lastindex > 1 and str(match[match.lastindex])[:1] == "m" else 1.0
            return None if number is None else scale * number
    return None


def _step_in(line: str) -> float | None:
    step = _searched(_STEPS, line)
    if step is not None:
        return step
    match = _RATE.search(line)
    rate = None if match is None else number_of(match[1])
    return 1.0 / rate if rate else None


def _one(name: str, what: str, numbers: list[float | None]) -> float | None:
    said = [number for number in numbers if number is not None]
    if said and max(said) - min(said) > 1e-3 * max(said):
        raise SceneError(
            f"{name} says {visible(f'{said[0]:g}')} and {max(said, key=lambda n: abs(n - said[0])):g} {what}"
        )
    return said[0] if said else None
