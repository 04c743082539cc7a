"""Checkpoints of a run that died: states whose bytes were changed, beside a scene and settings that were, too."""

import tempfile
from functools import cache
from pathlib import Path
from random import Random

import numpy as np

from masonry.runtime.state import write
from masonry.scene import load, to_toml
from verification.fuzz.inputs.odd import one_of
from verification.fuzz.inputs.texts import changed_bytes, changed_text
from verification.fuzz.kind import Attempt, Kind

RUN = b'{"threads": 1, "checkpoint_every": 300.0}\n'


def make(draw: Random, folder: Path) -> Attempt:
    """A folder to go on in; no state in it is whole, so that nothing is computed."""
    there = folder / "r" / "checkpoint"
    there.mkdir(parents=True)
    scene, state = sound()
    for number in range(1, draw.randrange(2, 4)):
        (there / f"state-{number:06d}.npz").write_bytes(damaged(draw, state))
    (there / "scene.toml").write_bytes(changed_text(draw, scene) if draw.random() < 0.5 else scene)
    (there / "run.json").write_bytes(changed_text(draw, RUN) if draw.random() < 0.5 else RUN)
    return Attempt(["resume", "r"])


@cache
def sound() -> tuple[bytes, bytes]:
    """A scene, and a state such as runs keep: numbers, words, tables and arrays."""
    tree = {"origin": {"its scene": "0"}, "model": "0", "arrays": {"u": np.zeros((8, 3))}, "run": {"rows": np.eye(4)}}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "state.npz"
        write(path, tree)
        return to_toml(load("couplet")).encode(), path.read_bytes()


def damaged(draw: Random, state: bytes) -> bytes:
    """Other bytes, the checksum's among them."""
    changed = changed_bytes(draw, state)
    cut = one_of(draw, (b"", b"PK\3\4", b"\0" * 100))
    return changed if changed != state and draw.random() < 0.9 else cut


KIND = Kind("checkpoints", "checkpoints of a run that died", 1, make)
