"""What is compared of a scene as it is, and as it is turned, mirrored or numbered anew."""

import re
from functools import cache
from typing import Any

import numpy as np

from masonry.judgement.sentence import trust
from masonry.laboratory import laboratory
from masonry.scene import Scene
from verification import scene_runs
from verification.checks.turned import Turn, about, turned

OBLIQUE = "turned by 45 degrees about (1, 2, 3)"
ABOUT_X = "turned by 45 degrees about x"
ABOUT_BEDS = "turned by 45 degrees about the normal of a bed"
CYCLIC = "x for y, y for z, z for x"
MIRRORED, NUMBERED = "mirrored", "numbered anew"
TURNS = {
    turn.name: turn
    for turn in (
        Turn(ABOUT_X, about((1.0, 0.0, 0.0), 45.0)),
        Turn(ABOUT_BEDS, about((0.0, 0.0, 1.0), 45.0)),
        Turn(OBLIQUE, about((1.0, 2.0, 3.0), 45.0)),
        Turn(CYCLIC, about((1.0, 1.0, 1.0), 120.0)),
        Turn(MIRRORED, np.diag([-1.0, 1.0, 1.0])),
        Turn(NUMBERED, np.eye(3), seed=1),
    )
}
DRY = (
    *("arch", "arch-own-weight", "arch-spread", "arch-spreading", "arch-tilted", "block-rocking", "column-pushed"),
    *("house-tilted", "wall-tied"),
    *("dome-own-weight", "facade-tilted", "rubble-pile", "triplet-dry", "vault-spreading", "wall-out-of-plane"),
    *("wall-three-leaf", "wall-three-leaf-out-of-plane", "wall-tilted", "wall-to-and-fro", "wall-with-window"),
)
"""All packaged scenes whose joints are dry, without vehicles that travel, which no run loads."""
CASES = ("arch-of-oppenheim", "arch-of-voussoirs", "dry-block", "dry-rocking", "dry-wall", "dry-wall-let-go", "incline")
"""Scenes of cases whose joints are dry."""


def run(name: str, turn: str = "", **knobs: Any) -> dict[str, Any]:
    """The summary of a scene, as it is or turned."""
    return _run(name, turn, tuple((key.replace("__", "."), value) for key, value in knobs.items()))


@cache
def _run(name: str, turn: str, knobs: tuple[tuple[str, Any], ...]) -> dict[str, Any]:
    scene = scene_runs.load(name, dict(knobs))
    if not turn:
        return laboratory.run(scene).summary
    with turned(scene, TURNS[turn]) as other:
        return laboratory.run(other).summary


def asked(scene: Scene) -> float:
    """The accuracy that a scene asks for; 1 % where it gives its steps."""
    controls = (scene.limit, scene.drive)
    return min((one.accuracy for one in controls if one is not None and one.accuracy is not None), default=0.01)


def numbers(summary: dict[str, Any]) -> dict[str, tuple[float, float]]:
    """By name: a number that does not depend on axes and numbering, and the size against which a difference counts."""
    energy, fell, load = summary["energy_j"], summary.get("collapse"), summary.get("collapse_load")
    peak, lowest, final = (summary[f"{key}_stress_pa"] or 0.0 for key in ("peak", "lowest", "final"))
    force = max(abs(peak), abs(lowest))  # nothing without a drive
    value = {
        "peak": (peak, force),
        "lowest": (lowest, force),
        "blocks": (summary["blocks"], 1.0),
        "contacts": (summary["contacts"], 1.0),
    }
    if fell is not None:
        value["time of the fall"] = (fell["time_s"], fell["time_s"])
    if load is not None:
        value["factor"] = (load["borne"], load["borne"])
        value["moving"] = (load["moving"], 1.0)
    if fell is None and (load is None or load["falls"] is None):  # else they hang on how it falls
        work = abs(energy["external_work"])
        value["final"] = (final, force)
        value["elastic energy"] = (energy["elastic_contacts"], energy["elastic_contacts"])
        value["friction"] = (energy["friction"], work)
        value["overlap"] = (summary["overlap_max"], summary["overlap_max"])
    return value


def apart(one: dict[str, Any], other: dict[str, Any]) -> dict[str, float]:
    """By how much each number differs, over its size."""
    first, second = numbers(one), numbers(other)
    assert first.keys() == second.keys()
    return {name: abs(value - second[name][0]) / (size or 1.0) for name, (value, size) in first.items()}


def words(summary: dict[str, Any]) -> str:
    """The sentence of trust without its numbers, and without what axes and blocks are called."""
    return re.sub(r"-?\d[\d.e+-]*|across [xyz]", "#", trust(summary))
