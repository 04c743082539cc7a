"""Formats of records that are known by their heads, and are not read: where a plain file comes from."""

import re
from pathlib import Path

from masonry.errors import SceneError

PLAIN = (
    "put its acceleration into a file of its own, in this order, below a line "
    "'NPTS= 4000, DT= 0.005 SEC, UNITS OF CM/S2' with its own samples, step and unit"
)
BY_OBSPY = (
    "make a CSV file of it by Python: one = obspy.read(FILE)[0]; numpy.savetxt('record.csv', "
    "numpy.c_[one.times(), one.data], delimiter=',')"
)
LOOKED_AT = 60
"""Lines among which a head is looked for."""
TEXTS = (
    ("COSMOS", r"\(Format v *\d+\.\d+ with +\d+ text lines\)"),
    ("CSMIP (CESMD, .V1 to .V3)", r"points of \w+ data equally spaced"),
    ("GeoNet (.V1A to .V3A)", r"(?:Unc|C)orrected accelerogram .*GNS Science"),
    ("SMC (USGS)", r"^ ?\d (?:UN)?CORRECTED ACCELEROGRAM *$"),
)
_SAC_UNDEFINED = re.compile(r"(?:\s*-12345(?:\.0*)?)+\s*")
SAC_VERSION_AT, SAC_VERSIONS = 304, (6, 7)
"""Byte of the version in the head of SAC, and its values."""


def require_own(name: str, lines: list[str]) -> None:
    """SceneError where a text is of a format that is not read."""
    for what, pattern in TEXTS:
        if any(re.search(pattern, line[:200]) for line in lines[:LOOKED_AT]):
            raise SceneError(f"{name} is a file of {what}, which is not read: {PLAIN}")
    if sum(bool(_SAC_UNDEFINED.fullmatch(line[:200])) for line in lines[:30]) > 2:
        raise SceneError(f"{name} is a file of SAC, which is not read: {BY_OBSPY}")


def native_format(path: Path) -> str | None:
    """Possible format of a file that is no text, as the end of a sentence."""
    with open(path, "rb") as file:
        begin = file.read(1024)
    word = begin[SAC_VERSION_AT : SAC_VERSION_AT + 4]
    if len(begin) >= 632 and any(int.from_bytes(word, order) in SAC_VERSIONS for order in ("little", "big")):
        return f"is a file of SAC, which is not read: {BY_OBSPY}"
    if re.match(rb"\d{6}[DRQM] |MS\x03", begin):
        return f"is a file of miniSEED, which is not read: {BY_OBSPY}"
    if begin.startswith((b"PK\x03\x04", b"\x1f\x8b", b"BZh", b"\xfd7zXZ")):
        return "is packed, or a spreadsheet: unpack it, or save it as CSV (UTF-8)"
    return "is no text, or not UTF-8: save it as a CSV file in UTF-8" if b"\x00" in begin else None
