"""The table of a specimen of another package, made of the parameters of its function."""

from functools import cache
from typing import Annotated, Any, Literal, get_args, get_origin

from pydantic import (
    SerializeAsAny,
    StrictBool,
    ValidationInfo,
    ValidatorFunctionWrapHandler,
    WrapValidator,
    create_model,
)

from masonry.errors import SceneError
from masonry.scene.tables.specimen import Specimen, SpecimenTable, kinds
from masonry.scene.tables.specimen_plugins import own_specimen
from masonry.scene.tables.types import Area, Count, Given, Length, Position

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


@cache
def specimen_class(kind: str) -> type[SpecimenTable] | None:
    """The table of a specimen of another package, or None. Raises SceneError for one that does not work."""
    own = own_specimen(kind)
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
    own = own_specimen(spec.kind)
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


AnySpecimen = Annotated[SerializeAsAny[Specimen], WrapValidator(_of_its_kind)]
