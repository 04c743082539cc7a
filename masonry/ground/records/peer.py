"""Records of PEER (.AT2, .VT2, .DT2), and what else says NPTS above numbers that go on from line to line.

The head of the database: `NPTS= 4000, DT= .0100 SEC`, of older files `4000 0.0100 NPTS, DT`; units stand above,
`UNITS OF G`. OpenSees, SeismoSignal and others write both in other orders, and marks around the numbers.
"""

import re

from masonry.errors import SceneError, visible
from masonry.ground.records.one_series import begins_at, series_file, series_of
from masonry.ground.records.record_file import RecordFile
from masonry.ground.records.record_head import head_of

LOOKED_AT = 100
"""Lines among which the head stands."""
LONGEST = 10_000
"""Letters of a head."""
_SAYS_STEP = re.compile(r"\b(?:DT|TSTEP)\s*[=:]\s*(\S+)", re.IGNORECASE)
_SAYS_SAMPLES = re.compile(r"\bNPTS\b", re.IGNORECASE)


def peer(name: str, lines: list[str]) -> RecordFile | None:
    """None where this is none. Raises SceneError where it is damaged."""
    said = [k for k, line in enumerate(lines[:LOOKED_AT]) if _SAYS_SAMPLES.search(line[:1000])]
    if not said:
        return None
    begin = begins_at(lines, said[-1] + 1)
    head = head_of(name, lines[:begin])
    for k in said if head.samples is None else ():
        if re.search(r"\d", lines[k]):
            raise SceneError(f"{name}: '{visible(lines[k].strip()[:40])}' is no number of a file of PEER")
    if head.samples is None:
        return None
    if head.step is None and (odd := _SAYS_STEP.search("\n".join(lines[:begin])[:LONGEST])):
        raise SceneError(f"{name}: '{visible(odd[1][:40])}' is no number of a file of PEER")
    values = series_of(name, "a file of PEER", lines[begin:], head.samples, head.step)
    return series_file(name, values, head.unit, head.step)
