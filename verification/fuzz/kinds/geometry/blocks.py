"""Files of blocks (.blocks.h5): other arrays, links, packed and virtual data, damaged bytes."""

from functools import cache
from pathlib import Path
from random import Random

from geometry.joints.find import find_joints
from masonry.importing.scene_file import scene_text
from verification.fuzz.inputs import hdf5, seeds, texts
from verification.fuzz.inputs.odd import one_of
from verification.fuzz.kind import Attempt, Kind


def make(draw: Random, folder: Path) -> Attempt:
    """A scene on a changed file of blocks."""
    path = folder / "a.blocks.h5"
    content = one_of(draw, seeds.blocks())
    path.write_bytes(content)
    if draw.random() < 0.6:
        hdf5.change(draw, path)
    else:
        path.write_bytes(texts.changed_bytes(draw, content))
    (folder / "a.toml").write_text(_scene(), encoding="utf-8")
    return Attempt(["check", "a.toml"])


@cache
def _scene() -> str:
    return scene_text(seeds.small(), find_joints(seeds.small().blocks), "blocks", "a.blocks.h5", False)


KIND = Kind("blocks", ".blocks.h5: arrays, links, packed data, bytes", 5, make)
