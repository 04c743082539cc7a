"""What runs and sweeps leave behind, and what they are told: results, checkpoints, records, sweeps."""

import json
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from masonry.runtime.shell import OK, USAGE
from masonry.runtime.state_file import write
from masonry.scene import load, to_toml
from masonry.sweeps.job import Job
from tests.fuzz import sound
from tests.fuzz.attempt import Attempt, kind
from tests.fuzz.changes import changed_bytes, changed_text, changed_tree
from tests.fuzz.hdf5 import changed_hdf5
from tests.fuzz.odd import NO_FILES, TARGETS, Draw, below, chance, pick, toml

DEEP = (b"[", b'{"a":', b"1", b"[1,", b'"', b'{"a":"')
NOT_HELD = 1
"""`masonry verify --compare` ends so where a record is worse."""
RUN = b'{"threads": 1, "checkpoint_every": 300.0}\n'
RECORD = {
    **{"version": "1.0", "source_hash": "a", "chapter": "Cases", "case": "incline", "row": "A12", "status": "PASS"},
    **{"reason": "", "quantity": "peak", "unit": "Pa", "value": 1.0, "reference": 1.0, "tolerance": 0.01},
    **{"scale": 1.0, "seconds": 1.5, "seconds_stepping": 0.5, "knobs": {}, "processor": "x"},
    **{"kind_of_reference": "exact", "holds": True},
}
COHESION, MODE_1 = "contact.unit_unit.cohesion", "contact.unit_unit.fracture_energy_mode_1"
SWEEPS: tuple[dict[str, Any], ...] = (
    {"scene": "couplet", "grid": {COHESION: ["0.6 MPa", "0.8 MPa"], MODE_1: {"times": [0.5, 1, 2]}}},
    {
        "scene": "couplet",
        "list": [{"law": "linear"}, {COHESION: {"times": 2, "of": "contact.unit_unit.tensile_strength"}}],
        "settings": {"drive.steps": 100},
    },
    {
        "scene": "couplet",
        "latin_hypercube": {
            "samples": 4,
            "seed": 7,
            COHESION: {"from": "0.1 MPa", "to": "0.4 MPa"},
            MODE_1: {"times": {"from": 0.5, "to": 2.0, "scale": "log"}},
            "drive.steps": {"from": 10, "to": 99},
            "law": {"values": ["linear", "exponential"]},
        },
    },
)
LARGE: tuple[Any, ...] = (
    *({"from": 1, "to": 10**12}, {"from": 0, "to": 1e300}, {"from": "1e-300 m", "to": "1e300 m", "scale": "log"}),
    *({"times": {"from": 0, "to": 1}}, {"times": {"times": {"times": {"from": 1, "to": 2}}}}, {"values": []}),
    *({"from": float("-inf"), "to": float("inf")}, {"times": [10**400]}, list(range(3000)), 10**12, [[1]], [{}]),
    *([{"times": 2, "of": COHESION}], [{"times": 1, "of": MODE_1}], {"from": "a", "to": "b"}, [float("nan")]),
    *({"from": 1, "to": "2 m"}, {"times": 1, "of": "x.y"}),
)
FINISHED = 'scene = "couplet"\n[grid]\n"contact.unit_unit.cohesion" = ["0.6 MPa", "0.8 MPa"]\n'


def _changed_json(draw: Draw, content: bytes) -> bytes:
    """Other values, other text, or one that is deep."""
    if chance(draw, 60):
        return json.dumps(changed_tree(draw, json.loads(content))).encode()
    return changed_text(draw, content) if chance(draw, 60) else pick(draw, DEEP) * pick(draw, (10, 5000, 300_000))


@kind("records", 8)
def records(draw: Draw) -> Attempt:
    """Two files of records to compare, one of them of other types, deep, huge, or no file."""
    new = json.dumps([RECORD, {**RECORD, "value": 2.0}, {**RECORD, "case": "other"}]).encode()
    files: dict[str, bytes | Path] = {
        "old.json": json.dumps([RECORD]).encode(),
        "new.json": _changed_json(draw, new),
    }
    names = ["old.json", "new.json" if chance(draw, 90) else pick(draw, NO_FILES)]
    words = ["verify", "--format", pick(draw, ("text", "json", "md")), "--compare"]
    return Attempt([*words, *(names if chance(draw, 70) else names[::-1])], files, codes=(OK, NOT_HELD, USAGE))


@kind("results", 0.8, 3)
def results(draw: Draw) -> Attempt:
    """A folder of results to draw: history.h5 and summary.json of other shapes and types, or no files at all."""
    files: dict[str, bytes | Path] = {f"r/{name}": content for name, content in sound.results().items()}
    way = below(draw, 10)
    if way < 6:
        change = changed_hdf5 if way < 5 else changed_bytes
        files["r/history.h5"] = change(draw, sound.results()["history.h5"])
    elif way < 9:
        files["r/summary.json"] = _changed_json(draw, sound.results()["summary.json"])
    else:
        files[pick(draw, list(files))] = Path(pick(draw, TARGETS))
    return Attempt(["plot", "r"], files, ("r/curve.png", "r/cracks.png"))


@kind("checkpoints", 1)
def checkpoints(draw: Draw) -> Attempt:
    """Checkpoints of a run that died; no state is whole, so that nothing is computed, and scene and settings differ."""
    scene, state = _dead_run()
    files: dict[str, bytes | Path] = {
        f"r/checkpoint/state-{number:06d}.npz": _damaged(draw, state) for number in range(1, 2 + below(draw, 2))
    }
    files["r/checkpoint/scene.toml"] = changed_text(draw, scene) if chance(draw, 50) else scene
    files["r/checkpoint/run.json"] = changed_text(draw, RUN) if chance(draw, 50) else RUN
    return Attempt(["resume", "r"], files)


@cache
def _dead_run() -> tuple[bytes, bytes]:
    """A scene, and a state such as runs keep: numbers, words, tables and arrays."""
    tree = {"origin": {"its scene": "0"}, "model": "0", "arrays": {"u": np.zeros((8, 3))}, "run": {"rows": np.eye(4)}}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "state.npz"
        write(path, tree)
        return to_toml(load("couplet")).encode(), path.read_bytes()


def _damaged(draw: Draw, state: bytes) -> bytes:
    """Other bytes, the checksum's among them."""
    changed = changed_bytes(draw, state)
    return changed if changed != state and chance(draw, 90) else pick(draw, (b"", b"PK\3\4", b"\0" * 100))


@kind("sweep", 20)
def sweep(draw: Draw) -> Attempt:
    """Sweep files, listed and not run: far too many points, odd ranges, keys and scenes."""
    if chance(draw, 70):
        content = toml(changed_tree(draw, pick(draw, SWEEPS), (*NO_FILES, *LARGE))).encode("utf-8", "surrogatepass")
    else:
        content = changed_text(draw, toml(pick(draw, SWEEPS)).encode())
    name = "s.toml" if chance(draw, 95) else pick(draw, NO_FILES)
    return Attempt(["sweep", name, "--list"], {"s.toml": content})


@kind("sweep-folders", 0.5, 3)
def sweep_folders(draw: Draw) -> Attempt:
    """A folder of a sweep to finish whose runs are done: summaries, curves and copies of the sweep are damaged."""
    done, keys = sound.results(), _keys()
    files: dict[str, bytes | Path] = {f"out/runs/{key}/{name}": done[name] for key in keys for name in done}
    run = f"out/runs/{keys[0]}"
    files |= {"s.toml": FINISHED.encode(), "out/sweep.toml": FINISHED.encode()}
    way = below(draw, 6)
    if way < 2:
        files[f"{run}/summary.json"] = _changed_json(draw, done["summary.json"])
    elif way == 2:
        files[f"{run}/curve.csv"] = changed_text(draw, done["curve.csv"])
    elif way == 3:
        files[f"{run}/failure.json"] = _changed_json(draw, b'{"status": "STOPPED", "reason": "x", "seconds": 1.0}')
    elif way == 4:
        files["out/sweep.toml"] = changed_text(draw, FINISHED.encode())
    else:
        summary, curve, failure = (f"{run}/{name}" for name in ("summary.json", "curve.csv", "failure.json"))
        names = (summary, curve, failure, "out/sweep.toml", "out/.masonry-lock")
        files[pick(draw, names)] = Path(pick(draw, TARGETS))
    return Attempt(["sweep", "s.toml", "--out", "out"], files, ("out",), ("out/.masonry-lock", "out/sweep.toml"))


@cache
def _keys() -> list[str]:
    return [Job("couplet", {COHESION: value}).key() for value in ("0.6 MPa", "0.8 MPa")]
