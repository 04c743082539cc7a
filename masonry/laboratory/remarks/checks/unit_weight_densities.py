"""Densities that were given as unit weights: what they come to."""

from typing import Any

from masonry.assembly.assemble import Assembly
from masonry.scene import Scene
from masonry.scene.unit_weights import DIVIDED


def remarks(assembly: Assembly) -> list[str]:
    """As `unit_weights`."""
    return unit_weights(assembly.scene)


def unit_weights(scene: Scene) -> list[str]:
    """A line for each density that was given as a unit weight."""
    keys = [key for key, why in scene.assumptions.items() if why.endswith(DIVIDED)]
    return [f"{key}: {scene.assumptions[key]}; this is {_at(scene, key):.4g} kg/m3" for key in keys]


def _at(scene: Scene, key: str) -> Any:
    """The value of a dotted key that ends in a table of the scene by name or number."""
    table, name, last = key.split(".", 1)[0], key.split(".", 1)[1].rpartition(".")[0], key.rpartition(".")[2]
    tables = getattr(scene, table)
    return getattr(tables[int(name)] if isinstance(tables, tuple) else tables[name], last)
