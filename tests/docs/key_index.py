"""The index of docs/scene.md: each table of a scene with its keys, as the schema has them (masonry/scene/schema.py)."""

from collections.abc import Iterator
from typing import Any, get_args, get_origin

from pydantic import BaseModel

from masonry.scene import Scene
from masonry.scene.tables.specimens.common import Divided, SpecimenTable

HEAD = "| table | its keys |\n|---|---|\n"
PLACES = {
    **{"": "Top of the file", "specimen.turned": "`[specimen]`", "gravity.tilt": "`[gravity]`"},
    **dict.fromkeys(("damping.rayleigh", "damping.maxwell"), "`[damping]`"),
    **{"quiet.wave": "`[ground]`", "quiet.wave.made": "`[ground.made]`"},
    **dict.fromkeys(("specimen.cells", "specimen.mortar.cells", "specimen.core"), "Cells in place of a grid"),
    **{"specimen.mortar": 'kind = "couplet"', "specimen.opening": 'kind = "wall"', "specimen.box": 'kind = "boxes"'},
    **{"specimen.arch": 'kind = "bridge"', "specimen.pier": 'kind = "bridge"', "specimen.slab": "Slabs"},
    **{"contact": "Keys", "scatter.GROUP": "`[scatter]`"},
}
"""Heading of the page below which a table stands, where that is not the name of the table."""
BY_GROUP = ("material", "contact")
"""Tables of tables whose names are groups."""
NO_KEY = "exponent_shear_table"
"""What the program remembers of `exponent_shear`; no scene writes it."""


def keys_of(table: type[BaseModel]) -> list[str]:
    """The keys of a table; how its units are divided comes last, as on the page."""
    last = [key for key in Divided.model_fields if key in table.model_fields]
    return [key for key in table.model_fields if key not in (*last, NO_KEY)] + last


def tables_within(kind: Any, many: bool = False) -> Iterator[tuple[type[BaseModel], bool]]:
    """The tables that a type of the schema holds, each with whether a file lists it as [[table]]."""
    if isinstance(kind, type) and issubclass(kind, BaseModel):
        yield kind, many
    for part in get_args(kind):
        yield from tables_within(part, many or get_origin(kind) is tuple)


def rows(table: type[BaseModel], path: str = "", many: bool = False) -> Iterator[tuple[str, str, list[str]]]:
    """(path, the table as a file writes it, its keys) of a table and all below it; some paths come several times."""
    keys, named = keys_of(table), f"{path}.GROUP" if path in BY_GROUP else path
    if issubclass(table, SpecimenTable):
        common = SpecimenTable.model_fields
        yield path, f"[{named}]", list(common)
        kind = f'kind = "{get_args(table.model_fields["kind"].annotation)[0]}"'
        yield kind, kind, [key for key in keys if key not in common or (key, kind) == ("section", 'kind = "boxes"')]
    elif path:
        yield path, f"[[{named}]]" if many else f"[{named}]", keys
    else:
        tables = {key for key, field in table.model_fields.items() if [*tables_within(field.annotation)]}
        yield path, "top of the file", [key for key in keys if key not in tables and key != "assumptions"]
    for key, field in table.model_fields.items():
        for below, is_list in tables_within(field.annotation):
            yield from rows(below, f"{path}.{key}".lstrip("."), is_list)
    if (by_group := getattr(table, "ANY", None)) is not None:
        yield from rows(by_group, f"{path}.GROUP")


def anchor(heading: str) -> str:
    """What a link to a heading says after its #."""
    return "".join(letter for letter in heading.lower().replace(" ", "-") if letter.isalnum() or letter in "-_")


def index() -> str:
    """The index as the page should have it: a line for each table, with a link to its place; like tables share one."""
    table_at: dict[str, tuple[str, list[str]]] = {}
    for path, name, keys in rows(Scene):
        table_at.setdefault(path, (name, keys))
    links: dict[tuple[str, ...], list[str]] = {}
    for path in sorted(table_at, key=_order):
        name, keys = table_at[path]
        heading = PLACES.get(path, path if path.startswith("kind") else f"`{name}`")
        link = f"[{f'`{name}`' if path else name}](#{anchor(heading)})"
        links.setdefault(tuple(keys), []).append(link)
    lines = [f"| {', '.join(same)} | {', '.join(f'`{key}`' for key in keys)} |\n" for keys, same in links.items()]
    return "".join(
        [HEAD, *lines, "| [`[assumptions]`](#assumptions) | any key of the scene, with its tables and dots |\n"]
    )


def _order(path: str) -> int:
    """The top of the file, then the specimen with its kinds and tables, then all others as they come."""
    if path in ("", "specimen"):
        return 0
    return 1 if path.startswith("kind") else 2 if path.startswith("specimen.") else 3
