"""Files of records: other types, deep, huge, no files at all."""

import json
from pathlib import Path
from random import Random

from verification.fuzz.inputs import texts, trees
from verification.fuzz.inputs.odd import one_of, paths
from verification.fuzz.kind import Attempt, Kind

RECORD = {
    "version": "1.0",
    "source_hash": "a",
    "chapter": "Cases",
    "case": "incline",
    "row": "A12",
    "status": "PASS",
    "reason": "",
    "quantity": "peak",
    "unit": "Pa",
    "value": 1.0,
    "reference": 1.0,
    "tolerance": 0.01,
    "scale": 1.0,
    "seconds": 1.5,
    "seconds_stepping": 0.5,
    "knobs": {},
    "processor": "x",
    "kind_of_reference": "exact",
    "holds": True,
}


def make(draw: Random, folder: Path) -> Attempt:
    """Two files of records, one of them changed, to be compared."""
    (folder / "old.json").write_text(json.dumps([RECORD]), encoding="utf-8")
    tree = [dict(RECORD), {**RECORD, "value": 2.0}, {**RECORD, "case": "other"}]
    kind = draw.randrange(5)
    if kind < 3:
        content = json.dumps(trees.changed(draw, tree)).encode()
    elif kind == 3:
        content = texts.changed_text(draw, json.dumps(tree).encode())
    else:
        content = one_of(draw, (b"[", b'{"a":', b"1", b"[1,", b'"')) * one_of(draw, (10, 5000, 300_000))
    (folder / "new.json").write_bytes(content)
    names = ["old.json", "new.json" if draw.random() < 0.9 else one_of(draw, paths(folder))]
    form = one_of(draw, ("text", "json", "md"))
    return Attempt(["verify", "--format", form, "--compare", *(names if draw.random() < 0.7 else names[::-1])])


KIND = Kind("records", "records.json to compare: types, depth, size, no files", 8, make)
