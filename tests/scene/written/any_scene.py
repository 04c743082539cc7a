"""Scenes made by chance: a scene that is shipped, with keys of the schema put in whose values are drawn from what each
may be."""

import tomllib
from functools import cache
from pathlib import Path
from random import Random
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel

from masonry.errors import SceneError
from masonry.quantity import KINDS
from masonry.scene import Scene, load, packaged, to_toml
from masonry.scene.tables.types import Given

VERIFICATION = Path(__file__).resolve().parents[3] / "verification" / "scenes"
ALIKE = {"length": ("m", "mm", "in"), "stress": ("Pa", "MPa", "psi"), "angle": ("rad", "deg"), "time": ("s", "ms")}
"""Units besides those of SI in which a value is given."""
FORMULA = "0.3 m/s^2 * sin(2 pi t / 0.7 s)"
MADE = [
    {"spectrum": "eurocode-8-1", "soil": "C", "a_g": "0.21 g", "duration": "7.1 s", "strong": "2.3 s"},
    {"spectrum": "table", "table": [["0.11 s", "0.37 g"], ["0.9 s", "1.3 m/s^2"]], "damping": 0.03, "duration": "5 s"},
    {"spectrum": "clough-penzien", "peak": "0.17 g", "filter_damping": 0.7, "seed": 7, "duration": "6 s"},
]
MOTIONS = [
    {"x": FORMULA, "duration": "0.7 s", "begin": "0.13 s", "scale": -1.7, "baseline": "linear"},
    {"y": "0.1 mm * (1 - cos(2 pi t / 0.3 s))", "quantity": "displacement", "duration": "0.6 s", "peak": "0.3 g"},
    {"x": "first", "z": "third", "made": MADE[0]},
    {"z": "second", "made": MADE[1], "peak": "0.123 g"},
    {"y": "first", "made": MADE[2], "begin": "0.1 s"},
]
HISTORY = ["0.2 + 0.1 * sin(2 pi t / 0.3 s)", [["0 s", 0.1], ["0.7 s", 1], ["1.1 s", -0.3]]]
BAND = {"ratio": "4.7 %", "between": ["1.3 Hz", "17 Hz"]}
OWN: dict[str, list[Any]] = {
    "ground": [*MOTIONS, MOTIONS[0] | {"as": "base"}],
    "quiet": [
        [{"on": "top.z+", "p_speed": "1234.5 m/s", "density": "17 kN/m^3", "wave": wave}, {"on": "bottom.x-"}]
        for wave in MOTIONS
    ],
    "damping": [
        {"mass": {"ratio": "3 %", "at": "2.7 Hz"}, "stiffness": "1.7e-5 s"},
        {"rayleigh": BAND},
        {"maxwell": BAND, "local": 0.13},
    ],
    "history": [*HISTORY, ["0.3 mm", "-0.07 mm"]],
    "gravity.tilt": [{"about": "x", "angle": "3.3 deg", "steps": 700}],
    "specimen.cells": [
        {"per_unit": 3, "spread": 0.37, "seed": 11, "form": "space", "regularise": False},
        {"total": 2, "kind": "voronoi", "sites": [["3 mm", "0.1 in", "0 m"], ["2 cm", "1 m", "-7 mm"]]},
        {"per_unit": 2, "sizes": [1.5, 0.7]},
    ],
    "specimen.points_per_edge": [3, {"x": 3, "y": 2, "z": 7}],
    "specimen.slab": [
        [{"name": "lintel", "origin": ["1 m", "0 m", "7 in"], "size": ["1 m", "2 m", "3 mm"], "group": "floors"}]
    ],
    "limit": [
        {"pattern": "tilt", "about": "-y", "accuracy": "2 %", "up_to": 0.7},
        {"pattern": "force", "on": "top", "force": ["1 kN", "-3.3 N", 0], "at": ["1 in", "2 m", "0 m"]},
        {"pattern": "traction", "on": "top.z+", "stress": {"x": "0.37 psi", "z": "1 Pa"}},
    ],
    "mass": [[{"on": "top", "mass": "317 kg", "at": ["0.1 m", "3 in", "1 m"]}]],
    "fill": [[{"on": "all", "level": "3 m", "density": "18.3 kN/m^3"}]],
    "motion": [
        [{"on": "top", "velocity": ["1 mm/s", 0, "-2 in/s"], "spin": [0, "3 rad/s", 0], "about": [0, 0, "1 m"]}]
    ],
    "gauge": [
        [
            {"name": "a b", "at": {"x": "1 in", "z": "middle"}, "direction": "-y", "relative_to": "bottom"},
            {"name": "c", "at": "top.x+", "direction": "z", "quantity": "acceleration"},
        ]
    ],
    "assumptions": [{"law": "a \u00e9 'quoted' word"}],
    "title": ["a \u00b5 title"],
    "law": ["friction", "brittle", "polynomial"],
    "solver.time_step": ["1.7 us", "equation-11"],
    "solver.rotation_limit": ["1.3 deg"],
    "kinematics": ["affine", {"default": "tets"}],
    "confinement": ["0.37 psi"],
    "specimen.content": [],
    "specimen.path": [],
}
"""Values of tables and keys whose type alone does not say what they may be; those that name a file have none."""


AXLES = {"on": "all", "level": "3.3 m", "axles": ["70 kN", "101 kN"], "spacings": ["1.7 m"], "spread": "31 deg"}
WEIGHT = {"x": "0.3 m/s^2", "z": "-9.7 m/s^2"}
TOGETHER: list[dict[str, Any]] = [
    {"vehicle": AXLES, "limit": {"pattern": "vehicle"}},
    {"vehicle": AXLES | {"position": "1.3 m", "direction": "-x"}, "limit": {"pattern": "vehicle", "accuracy": "none"}},
    {"gravity": WEIGHT | {"history": HISTORY[0], "duration": "0.7 s"}},
    {"gravity": WEIGHT | {"history": HISTORY[1]}},
    {"traction": [{"on": "top.z+", "stress": {"x": "1 psi", "z": "-0.1 MPa"}, "history": HISTORY[1]}]},
    {"traction": [{"on": "top.z+", "stress": {"y": "1 Pa"}}, {"on": "top.x-", "stress": {"z": "-3.3 kPa"}}]},
    {"gauge": [{"name": "g", "at": "top", "direction": "x"}], "curve": {"x": "time", "y": ["g"]}},
]
"""Tables that make sense together."""


def sources() -> dict[str, str | Path]:
    """What to load of each scene that comes with the program and its verification, by name."""
    return {name: name for name in packaged()} | {file.stem: file for file in sorted(VERIFICATION.glob("*.toml"))}


@cache
def _shipped() -> dict[str, dict[str, Any]]:
    """The tables of all of them, by name."""
    return {name: tomllib.loads(to_toml(load(source))) for name, source in sources().items()}


def scenes(number: int, seed: int = 1) -> list[tuple[str, Scene, set[str]]]:
    """So many scenes: what each is made of, the scene, and the dotted keys that were put in, lists without numbers."""
    draw, made = Random(seed), []
    for _ in range(number):
        name = draw.choice(sorted(_shipped()))
        scene, keys = load(_shipped()[name]), set()
        for _ in range(7):
            change = _change(draw, scene)
            try:
                scene = scene.with_(change)
            except SceneError:
                continue
            keys |= {*change, *(key for name, value in change.items() for key in _dotted(value, name))}
        made.append((f"{name}: {', '.join(sorted(keys))}", scene, {_without_numbers(key) for key in keys}))
    return made


def _change(draw: Random, scene: Scene) -> dict[str, Any]:
    """Dotted keys and values that they may have: of a table that the scene has, or tables that are new."""
    if draw.random() < 0.2:
        return draw.choice(TOGETHER)
    if draw.random() < 0.4:
        key = draw.choice(sorted(key for key in OWN if "." not in key and key != "history"))
        return {key: draw.choice(OWN[key])}
    table: Any = scene
    path: list[str] = []
    while True:
        fields = type(table).model_fields
        name = draw.choice(sorted(fields))
        below = getattr(table, name)
        path.append(name)
        if isinstance(below, tuple) and below and isinstance(below[0], BaseModel):
            if name != "ground" or len(below) > 1:
                path.append(str(draw.randrange(len(below))))
            below = below[int(path[-1]) if path[-1].isdecimal() else 0]
        elif isinstance(below, dict) and below and isinstance(next(iter(below.values())), BaseModel):
            path.append(draw.choice(sorted(below)))
            below = below[path[-1]]
        if not isinstance(below, BaseModel):
            key = ".".join(path)
            return {key: value_of(draw, fields[name].annotation, fields[name].metadata, key)}
        table = below


def value_of(draw: Random, kind: Any, metadata: Any, key: str) -> Any:
    """A value as a file has it of a type of the schema; None where the type does not say what it may be."""
    own = OWN.get(key, OWN.get(key.rpartition(".")[2]) if "." in key else None)
    if own is not None:
        return draw.choice(own) if own else None
    if given := next((mark for mark in metadata if isinstance(mark, Given)), None):
        return _quantity(draw, given)
    if get_origin(kind) is Annotated:
        return value_of(draw, get_args(kind)[0], kind.__metadata__, key)
    if get_origin(kind) in (Union, UnionType):
        return value_of(draw, draw.choice([one for one in get_args(kind) if one is not type(None)]), (), key)
    if get_origin(kind) is Literal:
        return draw.choice(get_args(kind))
    if get_origin(kind) is tuple:
        parts = [part for part in get_args(kind) if part is not ...]
        return [value_of(draw, part, (), key) for part in (parts * 2 if ... in get_args(kind) else parts)]
    if kind in (bool, int, float, str):
        return {bool: draw.random() < 0.5, int: draw.randrange(1, 9), float: draw.uniform(0.1, 2.0), str: "top"}[kind]
    return None


def _quantity(draw: Random, given: Given) -> Any:
    """A quantity of a kind, of a size that walls have, in one of its units."""
    size = {"stiffness": 1e10, "stress": 1e6, "density": 2e3, "force": 1e3, "energy": 50.0}.get(given.kind, 1.0)
    unit = draw.choice(ALIKE.get(given.kind, (KINDS[given.kind].unit,)))
    if given.kind == "integer":
        return draw.randrange(1, 9)
    number = size * draw.lognormvariate(-0.7, 1.0)
    return f"{number!r} {unit}" if unit else number


def _dotted(value: Any, path: str) -> list[str]:
    """Every dotted key of a value."""
    if isinstance(value, dict):
        return [key for name, below in value.items() for key in (f"{path}.{name}", *_dotted(below, f"{path}.{name}"))]
    return [key for below in value for key in _dotted(below, path)] if isinstance(value, list) else []


def _without_numbers(key: str) -> str:
    return ".".join(part for part in key.split(".") if not part.isdecimal())
