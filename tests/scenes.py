"""Scenes as a user writes them: TOML text of boxes, elastic or softening, loaded through the public door."""

import tempfile
from pathlib import Path

from masonry import scene
from masonry.scene import Scene

ELASTIC = 'law = "elastic"\nnormal_stiffness = "200 GPa/m"\nshear_stiffness = "80 GPa/m"'
SLIPPERY = 'law = "elastic"\nnormal_stiffness = "200 GPa/m"\nshear_stiffness = "0 GPa/m"'
MATERIAL = 'density = "1900 kg/m^3"\nyoung_modulus = "5 GPa"\npoisson_ratio = 0.2'


def load(text: str, **overrides) -> Scene:
    """The scene of a TOML text; overrides as `drive__steps=10`."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "made-up.toml"
        path.write_text(text, encoding="utf-8")
        return scene.load(path, {key.replace("__", "."): value for key, value in overrides.items()})


def box(name: str, low, size, group: str, unit: int, divisions=(1, 1, 1)) -> str:
    origin, extent = ([f"{x!r} m" for x in map(float, values)] for values in (low, size))
    return (
        f'{{name = "{name}", origin = {origin}, size = {extent}, group = "{group}", unit = {unit}, '
        f"divisions = {list(divisions)}}}"
    ).replace("'", '"')


def specimen(boxes: list[str], section: float, mesh_size: str = "60 mm", more: str = "") -> str:
    listed = ",\n  ".join(boxes)
    return (
        f'[specimen]\nkind = "boxes"\nsection = "{section!r} m^2"\nmesh_size = "{mesh_size}"\n{more}\n'
        f"box = [\n  {listed}\n]\n"
    )


def tables(name: str, entries: dict[str, str]) -> str:
    """[name.key] tables."""
    return "\n".join(f"[{name}.{key}]\n{body}\n" for key, body in entries.items())


def listed(name: str, entries: list[str]) -> str:
    """[[name]] tables."""
    return "\n".join(f"[[{name}]]\n{body}\n" for body in entries)
