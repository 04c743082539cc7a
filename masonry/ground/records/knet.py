"""Records of K-NET and KiK-net (ASCII): counts that a scale of the head takes to gal, eight a line.

Counts have an offset: their mean is taken off, as the largest acceleration in the head has it.
Source: NIED, https://www.kyoshin.bosai.go.jp, "K-NET ASCII format".
"""

import re

from masonry.errors import SceneError, visible
from masonry.ground.records.number_cells import number_of
from masonry.ground.records.one_series import begins_at, series_file, series_of
from masonry.ground.records.record_file import RecordFile

LOOKED_AT = 40
"""Lines among which the head stands; it has 17."""
_SCALE = re.compile(r"([\d.]+)\s*\(\s*([A-Za-z]+)\s*\)\s*/\s*([\d.]+)", re.ASCII)


def knet(name: str, lines: list[str]) -> RecordFile | None:
    """None where this is none. Raises SceneError where it is damaged."""
    head = {line[:18].strip(): line[18:].strip() for line in lines[:LOOKED_AT]}
    if "Sampling Freq(Hz)" not in head or "Scale Factor" not in head:
        return None
    rate = _positive(name, "Sampling Freq(Hz)", head["Sampling Freq(Hz)"].rstrip("Hhz"))
    scale = _SCALE.fullmatch(head["Scale Factor"])
    if scale is None:
        raise SceneError(
            f"{name}: 'Scale Factor' is '{visible(head['Scale Factor'][:40])}', and not as 3920(gal)/6182761"
        )
    of, over = (_positive(name, "Scale Factor", digits) for digits in (scale[1], scale[3]))
    count = None
    if "Duration Time(s)" in head:
        count = round(rate * _positive(name, "Duration Time(s)", head["Duration Time(s)"]))
    counts = series_of(name, "a file of K-NET", lines[begins_at(lines) :], count, 1.0 / rate)
    values = counts * (of / over)
    return series_file(name, values - values.mean() if len(values) else values, scale[2], 1.0 / rate)


def _positive(name: str, key: str, digits: str) -> float:
    number = number_of(digits.strip())
    if number is None or number <= 0.0:
        raise SceneError(f"{name}: '{key}' is '{visible(digits[:40])}', which is no number above 0")
    return number
