"""Specimens of other packages, by entry points of the group `geometry.specimens`: functions, found by name.

Such a function has parameters annotated with the kinds of `geometry`, and returns a `geometry.Specimen`.
"""

import inspect
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, NamedTuple, get_type_hints

from geometry.blocks import GeometryError, Specimen
from masonry.errors import SceneError
from masonry.plugins import load, plugin, plugins

GROUP = "geometry.specimens"
NAMED = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)


class OwnSpecimen(NamedTuple):
    """A specimen of another package: its function, and annotation and default (`...` if none) of each parameter."""

    name: str
    origin: str
    function: Callable[..., Specimen]
    parameters: Mapping[str, tuple[Any, Any]]


def own_specimen_names() -> tuple[str, ...]:
    """The specimens that other packages bring, whether they work or not; slow."""
    return tuple(plugins(GROUP))


@cache
def own_specimen(name: str) -> OwnSpecimen | None:
    """The specimen of another package, or None. Raises SceneError, naming the package, for one that does not work."""
    found = plugin(GROUP, name, "specimen")
    if found is None:
        return None
    function = load(found, "specimen")
    where = f"specimen '{name}' of {found.origin}"
    if not inspect.isfunction(function):
        raise SceneError(f"{where}: its entry point must name a function, package.module:function, not {found.target}")
    try:
        hints = get_type_hints(function, include_extras=True)
    except NameError as error:
        raise SceneError(f"{where}: {error}") from None
    parameters: dict[str, tuple[Any, Any]] = {}
    for word, parameter in inspect.signature(function).parameters.items():
        if parameter.kind not in NAMED or word not in hints:
            raise SceneError(f"{where}: parameter '{word}' needs a kind of geometry, for example {word}: Length")
        default = ... if parameter.default is inspect.Parameter.empty else parameter.default
        parameters[word] = hints[word], default
    return OwnSpecimen(name, found.origin, function, parameters)


def built(name: str, values: Mapping[str, Any]) -> Specimen:
    """What the function of a specimen returns, looked over. Raises GeometryError with one message, whatever fails."""
    from geometry.polyhedra.validate import require_sound

    own = own_specimen(name)
    assert own is not None
    where = f"specimen '{name}' of {own.origin}"
    try:
        found = own.function(**values)
        if not isinstance(found, Specimen):
            raise GeometryError(f"its function returned {type(found).__name__}, not a geometry.blocks.Specimen")
        require_sound(found.blocks)
        _require_sets(found)
    except Exception as error:  # a package may trip over anything
        what = "" if isinstance(error, GeometryError) else f"{type(error).__name__}: "
        raise GeometryError(f"{where}: {what}{error}") from None
    return found


def _require_sets(found: Specimen) -> None:
    for name, members in found.sets.items():
        if members.ndim != 1 or members.dtype.kind not in "iu" or len(members) == 0:
            raise GeometryError(f"set '{name}' must be an array of block numbers")
        if members.min() < 0 or members.max() >= found.blocks.count:
            raise GeometryError(f"set '{name}' names blocks that do not exist")
    if not found.section > 0:
        raise GeometryError(f"the section is {found.section!r}, it must be an area above 0 m2")
    if len(found.blocks.unit) != found.blocks.count:
        raise GeometryError("unit needs a number for each block")
