"""Additions of other installed packages to the program, by entry points; looked for only where a name is not ours.

Entry points are what somebody has installed, as the program itself: a scene can name one, and cannot bring one.
"""

import importlib
import traceback
from collections.abc import Mapping
from functools import cache
from typing import Any, NamedTuple

from masonry.errors import SceneError


class Plugin(NamedTuple):
    """One entry point: its name, what it stands for ("package.module" or "package.module:function"), who brings it."""

    name: str
    target: str
    origin: str


@cache
def plugins(group: str) -> Mapping[str, tuple[Plugin, ...]]:
    """All entry points of a group by name, more than one where packages disagree. Reads what is installed: slow."""
    from importlib.metadata import entry_points

    by_name: dict[str, tuple[Plugin, ...]] = {}
    for entry in sorted(entry_points(group=group), key=lambda entry: (entry.name, entry.value)):
        here = Plugin(entry.name, entry.value, _origin(entry))
        by_name[entry.name] = (*by_name.get(entry.name, ()), here)
    return by_name


def plugin(group: str, name: str, what: str) -> Plugin | None:
    """The entry point of that name, or None; SceneError where two packages bring one. `what` it is: "law"."""
    entries = plugins(group).get(name, ())
    if len(entries) > 1:
        who = " and ".join(entry.origin for entry in entries)
        raise SceneError(f"{what} '{name}' is brought by {who}: uninstall one of them")
    return entries[0] if entries else None


def load(entry: Plugin, what: str) -> Any:
    """The module or function that an entry point stands for. Raises SceneError with one message for whatever fails."""
    module, _, attribute = (part.strip() for part in entry.target.partition(":"))
    try:
        loaded = importlib.import_module(module)
        return getattr(loaded, attribute) if attribute else loaded
    except (Exception, SystemExit) as error:  # a package may trip over anything
        place = traceback.extract_tb(error.__traceback__)[-1]
        where = (
            ""
            if "importlib" in place.filename or place.filename == __file__
            else f" ({place.filename}, line {place.lineno})"
        )
        raise SceneError(
            f"{what} '{entry.name}' of {entry.origin} cannot be loaded: {type(error).__name__}: {error}{where}"
        ) from None


def _origin(entry: Any) -> str:
    """Name and version of the package that an entry point belongs to."""
    known = {} if entry.dist is None or entry.dist.metadata is None else entry.dist.metadata
    name, version = (known["Name"], known["Version"]) if "Name" in known else (None, None)
    return f"{name} {version}".removesuffix(" None") if name else f"the module {entry.value}"
