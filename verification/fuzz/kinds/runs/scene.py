"""Scenes: every packaged one with keys, values and text changed."""

import tomllib
from pathlib import Path
from random import Random

from verification.fuzz.inputs import seeds, texts, trees
from verification.fuzz.inputs.odd import one_of
from verification.fuzz.kind import Attempt, Kind


def make(draw: Random, folder: Path) -> Attempt:
    """A changed scene, looked at by `check`; now and then exported or drawn."""
    text = one_of(draw, list(seeds.scenes().values()))
    if draw.random() < 0.6:
        text = trees.toml(trees.changed(draw, tomllib.loads(text)))
        content = text.encode("utf-8", "surrogatepass")
    else:
        content = texts.changed_text(draw, text.encode())
    (folder / "a.toml").write_bytes(content)
    kind = draw.random()
    if kind < 0.04:
        return Attempt(["export", "a.toml", "--to", "out.step"], ("out.step",))
    if kind < 0.06:
        return Attempt(["picture", "a.toml", "--geometry", "--out", "out.png"], ("out.png",))
    return Attempt(["check", "a.toml"])


def target(data: bytes) -> None:
    """A scene file of these bytes, loaded."""
    from masonry.scene import load
    from verification.fuzz.target import with_file

    with_file(data, ".toml", load)


KIND = Kind("scene", "keys, values, units, names and text of scenes", 34, make, target)
