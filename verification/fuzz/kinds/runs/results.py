"""Folders of results: history.h5 and summary.json of other shapes and types, damaged, or no files at all."""

import json
from pathlib import Path
from random import Random

from verification.fuzz.inputs import hdf5, made_up, texts, trees
from verification.fuzz.inputs.odd import one_of, paths
from verification.fuzz.kind import Attempt, Kind


def make(draw: Random, folder: Path) -> Attempt:
    """A changed folder of results, to be drawn again."""
    there = folder / "r"
    there.mkdir()
    files = made_up.files()
    for name, content in files.items():
        (there / name).write_bytes(content)
    kind = draw.randrange(10)
    if kind < 5:
        hdf5.change(draw, there / "history.h5")
    elif kind < 6:
        (there / "history.h5").write_bytes(texts.changed_bytes(draw, files["history.h5"]))
    elif kind < 9:
        (there / "summary.json").write_bytes(summary(draw, files["summary.json"]))
    else:
        name = one_of(draw, tuple(files))
        (there / name).unlink()
        odd = one_of(draw, [path for path in paths(folder) if path and "\0" not in path and len(path) < 200])
        (there / name).symlink_to(folder / odd)
    return Attempt(["plot", "r"], ("r/curve.png", "r/cracks.png"))


def summary(draw: Random, content: bytes) -> bytes:
    """A changed summary.json."""
    if draw.random() < 0.7:
        return json.dumps(trees.changed(draw, json.loads(content))).encode()
    if draw.random() < 0.7:
        return texts.changed_text(draw, content)
    return one_of(draw, (b"[", b'{"a":', b"1", b"[1,", b'{"a":"')) * one_of(draw, (1000, 50_000))


KIND = Kind("results", "folders of results: history.h5, summary.json", 0.8, make)
