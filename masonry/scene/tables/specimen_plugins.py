"""Specimens of other packages, by entry points of the group `geometry.specimens`: functions, found by name.

Such a function has parameters annotated with the kinds of `geometry`, of which the table of the scene is made, and
returns a `geometry.Specimen`.
"""

import inspect
from collections.abc import Callable, Mapping
from functools import cache
from typing import Annotated, Any, Literal, NamedTuple, get_args, get_origin, get_type_hints

from pydantic import (
    SerializeAsAny,
    StrictBool,
    ValidationInfo,
    ValidatorFunctionWrapHandler,
    WrapValidator,
    create_model,
)

from geometry.blocks import GeometryError, Specimen
from masonry.errors import SceneError
from masonry.plugins import load, plugin, plugins
from masonry.scene.tables.specimen import Specimen as OurTable
from masonry.scene.tables.specimen import kinds
from masonry.scene.tables.specimens.common import SpecimenTable
from masonry.scene.tables.types import Area, Count, Given, Length, Position

GROUP = "geometry.specimens"
NAMED = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
ANNOTATED: dict[str, Any] = {
    "length": Length,
    "position": Position,
    "area": Area,
    "angle": Annotated[float, Given("angle", "[-360, 360] deg")],
    "count": Count,
    "number": Annotated[float, Given("number")],
}
"""What a scene holds for the kinds of `geometry.specimens.kinds`."""
PLAIN: dict[Any, Any] = {
    float: ANNOTATED["number"],
    int: Annotated[int, Given("integer", "[-1e9, 1e9]")],
    bool: StrictBool,
    str: str,
}


class PluginSpecimen(NamedTuple):
    """A specimen of another package: its function, and annotation and default (`...` if none) of each parameter."""

    name: str
    origin: str
    function: Callable[..., Specimen]
    parameters: Mapping[str, tuple[Any, Any]]


def plugin_specimen_names() -> tuple[str, ...]:
    """The specimens that other packages bring, whether they work or not; slow."""
    return tuple(plugins(GROUP))


@cache
def plugin_specimen(name: str) -> PluginSpecimen | None:
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
    return PluginSpecimen(name, found.origin, function, parameters)


def built(name: str, values: Mapping[str, Any]) -> Specimen:
    """What the function of a specimen returns, looked over. Raises GeometryError with one message, whatever fails."""
    from geometry.polyhedra.validate import require_sound

    own = plugin_specimen(name)
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


@cache
def specimen_class(kind: str) -> type[SpecimenTable] | None:
    """The table of a specimen of another package, or None. Raises SceneError for one that does not work."""
    own = plugin_specimen(kind)
    if own is None:
        return None
    where = f"specimen '{kind}' of {own.origin}"
    fields: dict[str, Any] = {"kind": (Literal[kind], ...)}
    for word, (annotation, default) in own.parameters.items():
        if word in SpecimenTable.model_fields:
            raise SceneError(f"{where}: parameter '{word}' is a key of every specimen; take another name")
        fields[word] = (_held(where, word, annotation), default)
    made: type[SpecimenTable] = create_model(f"{kind}_specimen", __base__=SpecimenTable, **fields)
    return made


def parameters_of(spec: SpecimenTable) -> dict[str, Any]:
    """What the function of a specimen of another package is called with."""
    own = plugin_specimen(spec.kind)
    assert own is not None
    return {word: getattr(spec, word) for word in own.parameters}


def _held(where: str, word: str, annotation: Any) -> Any:
    kind = next((mark for mark in get_args(annotation)[1:] if isinstance(mark, str)), None)
    if get_origin(annotation) is Literal:
        return annotation
    if kind in ANNOTATED:
        return ANNOTATED[kind]
    if kind is None and annotation in PLAIN:
        return PLAIN[annotation]
    raise SceneError(
        f"{where}: parameter '{word}': {annotation!r} is no kind of parameter; take Length, Position, Area, Angle, "
        "Count or Number of geometry, bool, str, or a Literal of words"
    )


def _of_its_kind(data: Any, handler: ValidatorFunctionWrapHandler, info: ValidationInfo) -> Any:
    """The table of another package's specimen, where the kind is not one of ours."""
    kind = data.get("kind") if isinstance(data, dict) else None
    if isinstance(kind, str) and kind not in kinds() and (table := specimen_class(kind)) is not None:
        return table.model_validate(data, context=info.context)
    return handler(data)


AnySpecimen = Annotated[SerializeAsAny[OurTable], WrapValidator(_of_its_kind)]
