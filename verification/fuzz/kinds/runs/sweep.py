"""Sweep files: grids, lists and samples with far too many points, odd ranges, keys and scenes."""

from pathlib import Path
from random import Random
from typing import Any

from verification.fuzz.inputs import texts, trees
from verification.fuzz.inputs.odd import one_of, paths
from verification.fuzz.kind import Attempt, Kind

COHESION, MODE_1 = "contact.unit_unit.cohesion", "contact.unit_unit.fracture_energy_mode_1"
SEEDS: tuple[dict[str, Any], ...] = (
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
    {"from": 1, "to": 10**12},
    {"from": 0, "to": 1e300},
    {"from": "1e-300 m", "to": "1e300 m", "scale": "log"},
    {"times": {"from": 0, "to": 1}},
    {"times": {"times": {"times": {"from": 1, "to": 2}}}},
    {"values": []},
    {"from": float("-inf"), "to": float("inf")},
    {"times": [10**400]},
    list(range(3000)),
    [{"times": 2, "of": COHESION}],
    [{"times": 1, "of": MODE_1}],
    10**12,
    {"from": "a", "to": "b"},
    {"from": 1, "to": "2 m"},
    {"times": 1, "of": "x.y"},
    [[1]],
    [{}],
    [float("nan")],
)


def make(draw: Random, folder: Path) -> Attempt:
    """A changed sweep, listed and not run."""
    odd = paths(folder)
    if draw.random() < 0.7:
        tree = trees.changed(draw, one_of(draw, SEEDS), (*odd, *LARGE))
        content = trees.toml(tree).encode("utf-8", "surrogatepass")
    else:
        content = texts.changed_text(draw, trees.toml(one_of(draw, SEEDS)).encode())
    (folder / "s.toml").write_bytes(content)
    name = "s.toml" if draw.random() < 0.95 else one_of(draw, odd)
    return Attempt(["sweep", name, "--list"])


def target(data: bytes) -> None:
    """A sweep file of these bytes, read and its points listed."""
    from masonry.sweep.points import points
    from masonry.sweep.read import read
    from verification.fuzz.target import with_file

    with_file(data, ".toml", lambda path: points(read(path)))


KIND = Kind("sweep", "grids, lists, samples and keys of sweep files", 20, make, target)
