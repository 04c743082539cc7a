"""Records of the databases ESM and ITACA (DYNA): a head of KEY: VALUE, then one number a line.

Source: INGV, https://esm-db.eu and https://itaca.mi.ingv.it, "DYNA 1.2 format".
"""

import re

from masonry.errors import SceneError, visible
from masonry.ground.records.number_cells import number_of
from masonry.ground.records.one_series import begins_at, series_file, series_of
from masonry.ground.records.record_file import RecordFile

LOOKED_AT = 100
"""Lines among which the head stands; it has 64."""
_KEY = re.compile(r"([A-Z0-9_/^]{2,60}):(.*)")
KINDS = ("ACCELERATION", "VELOCITY", "DISPLACEMENT")


def dyna(name: str, lines: list[str]) -> RecordFile | None:
    """None where this is none. Raises SceneError where it is damaged, or holds a spectrum."""
    keys = [(k, match) for k, line in enumerate(lines[:LOOKED_AT]) if (match := _KEY.match(line[:1000]))]
    head = {match[1]: match[2].strip() for _, match in keys}
    if "SAMPLING_INTERVAL_S" not in head or "NDATA" not in head:
        return None
    kind = head.get("DATA_TYPE", "")
    if kind and kind not in KINDS:
        raise SceneError(f"{name} holds '{visible(kind[:40])}', and no motion: {', '.join(KINDS)}")
    step, count = (number_of(head[key]) for key in ("SAMPLING_INTERVAL_S", "NDATA"))
    if step is None or count is None or step <= 0.0:
        key = "NDATA" if count is None else "SAMPLING_INTERVAL_S"
        raise SceneError(f"{name}: '{key}' is '{visible(head[key][:40])}', which is no number above 0")
    begin = begins_at(lines, keys[-1][0] + 1)
    values = series_of(name, "a file of ESM or ITACA", lines[begin:], int(count), step)
    return series_file(name, values, head.get("UNITS", "").lower() or None, step)
