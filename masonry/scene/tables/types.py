"""The types of a scene's values: what may stand in a file, what is kept (SI floats), how it is written out again."""

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Literal, NamedTuple, NoReturn

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    GetCoreSchemaHandler,
    PlainSerializer,
    SerializationInfo,
    ValidationInfo,
)
from pydantic_core import CoreSchema, PydanticKnownError, core_schema

from masonry.errors import SceneError
from masonry.laws import law_names
from masonry.laws.building.plugins import all_law_names, plugin_law
from masonry.quantity import KINDS, convert


def _law(value: Any) -> Any:
    """The name of a law, of ours or of another package; these are looked for where it is not ours."""
    if isinstance(value, str):
        if value in law_names():
            return value
        if plugin_law(value) is not None:
            return value
    raise PydanticKnownError("literal_error", {"expected": " or ".join(map(repr, all_law_names()))})


Law = Annotated[str, BeforeValidator(_law)]
Motion = Literal["rigid", "affine", "tets"]
Dof = Literal["x", "y", "z", "rotation", "rotation x", "rotation y", "rotation z"]
Direction = Literal["x", "y", "z", "-x", "-y", "-z"]
SOFTEST = 1e-6
"""Pa/m, the least stiffness of a joint that is not 0."""
CONFINEMENT = {"confinement": 1.0, "-confinement": -1.0}
ALSO = " + "
"""Between the sets of a selector that names several."""
PLANE = re.compile(r"\s*(blocks at\s+)?([xyz])\s*=\s*(\S.*)")
"""A selector of faces in a plane, or of blocks at one."""


class KeyedError(ValueError):
    """Error in one key of the table that is being checked."""

    def __init__(self, key: str, message: str) -> None:
        super().__init__(message)
        self.key = key


class Table(BaseModel):
    """A table of the scene: no key but the ones named here, and no change after loading."""

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)  # the scene's own is built at first use

    if not TYPE_CHECKING:

        def __setattr__(self, name: str, value: object) -> None:
            raise unchanged(name)

        def __delattr__(self, name: str) -> None:
            raise unchanged(name)


def refuse_both(table: Table, first: str, second: str) -> None:
    """KeyedError where a table has two keys that exclude each other."""
    if getattr(table, first) is not None and getattr(table, second) is not None:
        raise KeyedError(second, f"{first} and {second} exclude each other; keep one of them")


def unchanged(name: object) -> SceneError:
    """Error where somebody tries to change a scene."""
    return SceneError(
        f"{name} cannot be changed: a scene stays as it is. scene.with_({{'contact.unit_unit.cohesion': '0.6 MPa'}}) "
        "gives another one, with other values of these keys"
    )


class ReadOnly(dict[str, Any]):
    """A table of tables by name that stays as it is."""

    def _refuse(self, *arguments: Any, **more: Any) -> NoReturn:
        raise unchanged(str(arguments[0])[:80] if arguments else "this table")

    __setitem__ = __delitem__ = pop = popitem = update = setdefault = clear = __ior__ = _refuse

    def __reduce__(self) -> tuple[type, tuple[dict[str, Any]]]:
        return ReadOnly, (dict(self),)


@dataclass(frozen=True)
class Given:
    """Marks a float or int that a file gives as a quantity of `kind` within the interval `allowed`."""

    kind: str
    allowed: str = "(-inf, inf)"

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        written = core_schema.plain_serializer_function_ser_schema(self.write)
        return core_schema.with_info_before_validator_function(self.read, handler(source), serialization=written)

    def read(self, value: Any, info: core_schema.ValidationInfo[Any]) -> float:
        if self.kind == "stress" and isinstance(value, str) and value in CONFINEMENT:
            value = f"{CONFINEMENT[value] * confinement_of(info, repr(value))!r} Pa"
        return convert(value, self.kind, info.field_name or "this", self.allowed)

    def write(self, value: float) -> Any:
        return f"{value!r} {KINDS[self.kind].unit}" if KINDS[self.kind].unit else value


def confinement_of(info: core_schema.ValidationInfo[Any], what: str) -> float:
    """The scene's top-level confinement in Pa; an error where `what` asks for one and there is none."""
    confinement = (info.context or {}).get("confinement")
    if confinement is None:
        raise ValueError(f"{what} needs the top-level key confinement, for example confinement = '0.5 MPa'")
    return float(confinement)


def _halves(value: Any, info: ValidationInfo) -> float:
    """A whole number, or one and a half."""
    number = convert(value, "number", info.field_name or "", "[1, 1000]")
    if not (2 * number).is_integer():
        raise ValueError(f"{number:g} is neither a whole number nor one and a half; nearest: {round(2 * number) / 2:g}")
    return int(number) if number.is_integer() else number


def _of_several(value: Any) -> Any:
    """One selector; of a list of them one text, such as "left plate + right plate"."""
    if not isinstance(value, list | tuple):
        return value
    if not value or not all(isinstance(word, str) and word.strip() for word in value):
        raise ValueError("must be the name of a set, or a list of names such as ['left plate', 'right plate']")
    return ALSO.join(value)


def _set_name(value: str) -> str:
    """A name of a set that no selector reads otherwise."""
    is_face = "." in value and value[-1:] in "+-"
    if value == "all" or ALSO in value or is_face or PLANE.fullmatch(value):
        raise ValueError(f"{value[:60]!r} reads as a selector of other blocks or of faces; give it another name")
    return value


SetName = Annotated[str, Field(min_length=1), AfterValidator(_set_name)]
Selector = Annotated[str, BeforeValidator(_of_several), Field(min_length=1)]
Length = Annotated[float, Given("length", "[1e-9, 1e5]")]
Gap = Annotated[float, Given("length", "[0, 1e5]")]
Position = Annotated[float, Given("length", "[-1e5, 1e5]")]
Area = Annotated[float, Given("area", "[1e-12, 1e8]")]
Duration = Annotated[float, Given("time", "[1e-18, 1e9]")]
Velocity = Annotated[float, Given("velocity", "[1e-15, 1e6]")]
Acceleration = Annotated[float, Given("acceleration", "[-1e9, 1e9]")]
Angle = Annotated[float, Given("angle", "[0, 90) deg")]
SignedAngle = Annotated[float, Given("angle", "[-180, 180] deg")]
Embrace = Annotated[float, Given("angle", "(0, 180] deg")]
Density = Annotated[float, Given("density", "[1e-9, 1e15]")]
Stress = Annotated[float, Given("stress", "[-1e15, 1e15]")]
Strength = Annotated[float, Given("stress", "[0, 1e15]")]
CrushingStrength = Annotated[float, Given("stress", "[1, 1e15]")]
Modulus = Annotated[float, Given("stress", "[1e-3, 1e18]")]
Stiffness = Annotated[float, Given("stiffness", "[1e-6, 1e22]")]
ShearStiffness = Annotated[float, Given("stiffness", "[0, 1e22]")]
Energy = Annotated[float, Given("energy", "[1e-15, 1e15]")]
EnergySlope = Annotated[float, Given("energy per stress", "[0, 1e6]")]
Poisson = Annotated[float, Given("number", "[0, 0.5)")]
Tangent = Annotated[float, Given("number", "[0, 1e6]")]
Exponent = Annotated[float, Given("number", "(1, 1000]")]
UnitInterval = Annotated[float, Given("number", "[0, 1]")]
Dashpot = Annotated[float, Given("number", "(0, 100]")]
Damping = Annotated[float, Given("number", "[0, 1)")]
Fraction = Annotated[float, Given("number", "[1e-6, 10]")]
Skin = Annotated[float, Given("number", "[1e-4, 0.5]")]
Count = Annotated[int, Given("integer", "[1, 1000]")]
Voussoirs = Annotated[int, Given("integer", "[2, 1000]")]
Sides = Annotated[int, Given("integer", "[3, 1000]")]
Halves = Annotated[int | float, BeforeValidator(_halves)]
Steps = Annotated[int, Given("integer", "[1, 1e8]")]
Frequency = Annotated[float, Given("frequency", "[1e-9, 1e12]")]
Rows = Annotated[int, Given("integer", "[2, 1e6]")]
Frames = Annotated[int, Given("integer", "[1, 1000]")]
Number = Annotated[int, Given("integer", "[0, 1e9]")]
CellCount = Annotated[int, Given("integer", "[1, 2e5]")]
RelativeSize = Annotated[float, Given("number", "(0, 1e6]")]
Spread = Annotated[float, Given("number", "[0, 2]")]
Variation = Annotated[float, Given("number", "[0, 2]")]


class Stresses(NamedTuple):
    """Pa, by direction; what a file leaves out is 0."""

    x: Stress = 0.0
    y: Stress = 0.0
    z: Stress = 0.0


def _directions(value: Any) -> Any:
    if not isinstance(value, dict) or not value:
        raise ValueError("must be a table by direction, with one or more of x, y, z")
    return value


def _write_stresses(value: Stresses, info: SerializationInfo[Any]) -> dict[str, str]:
    """By direction; a component that is the scene's confinement keeps saying so."""
    confinement = (info.context or {}).get("confinement")
    linked = {sign * confinement: word for word, sign in CONFINEMENT.items()} if confinement else {}
    return {axis: linked.get(x, f"{x!r} Pa") for axis, x in value._asdict().items() if x != 0.0 or not any(value)}


StressVector = Annotated[Stresses, BeforeValidator(_directions), PlainSerializer(_write_stresses)]
