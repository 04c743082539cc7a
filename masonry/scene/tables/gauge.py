"""What a scene wants to have measured besides the drive, and how its curve is drawn."""

import re
from typing import Annotated, Any, Literal, NamedTuple

from pydantic import AfterValidator, PlainSerializer, PlainValidator, ValidationInfo

from masonry.quantity import convert
from masonry.scene.tables.types import Direction, Table

NAME = re.compile(r"\w[\w .+-]{0,59}")


class Coordinates(NamedTuple):
    """A point, or a line along the axis that has no coordinate: m, or "middle" of the whole specimen."""

    x: float | str | None = None
    y: float | str | None = None
    z: float | str | None = None


def _read(value: Any, info: ValidationInfo) -> str | Coordinates:
    """A selector, or a table of two or three coordinates."""
    if isinstance(value, Coordinates) or (isinstance(value, str) and value):
        return value
    if not isinstance(value, dict) or not set(value) <= set("xyz") or len(value) < 2:
        raise ValueError(
            f"must be a selector such as 'top.z+', or a table of two or three of x, y, z such as "
            f"{{x = 'middle', y = '114 mm'}}; not {value!r:.60}"
        )
    known = {
        axis: "middle" if place == "middle" else convert(place, "length", f"{info.field_name}.{axis}", "[-1e5, 1e5]")
        for axis, place in value.items()
    }
    return Coordinates(**known)


def _named(value: str) -> str:
    """A name that can head a column of a table."""
    if NAME.fullmatch(value):
        return value
    raise ValueError(f"{value[:60]!r} must begin with a letter or digit, and have up to 60 of these, blanks and . + -")


def _write(value: str | Coordinates) -> Any:
    if isinstance(value, str):
        return value
    known = {axis: place for axis, place in value._asdict().items() if place is not None}
    return {axis: place if isinstance(place, str) else f"{place!r} m" for axis, place in known.items()}


Where = Annotated[str | Coordinates, PlainValidator(_read), PlainSerializer(_write)]


Quantity = Literal["displacement", "velocity", "acceleration"]


class GaugeTable(Table):
    """The displacement of a place in one direction, its velocity or its acceleration, less that of another place: a
    column of the results."""

    name: Annotated[str, AfterValidator(_named)]
    at: Where
    direction: Direction
    quantity: Quantity = "displacement"
    relative_to: Where | None = None

    @property
    def sign(self) -> float:
        return -1.0 if self.direction[0] == "-" else 1.0


def _several(value: Any) -> Any:
    """One name, or a list of them."""
    if isinstance(value, (list, tuple)) and value and all(isinstance(name, str) for name in value):
        return tuple(value)
    if isinstance(value, str):
        return value
    raise ValueError(f"must be 'stress', 'force', a gauge's name or a list of them; not {value!r:.60}")


class Curve(Table):
    """What curve.png draws: a gauge, the displacement of the drive or the time across; stress or force, or over the
    time one gauge or several, up."""

    x: str = "displacement"
    y: Annotated[str | tuple[str, ...], PlainValidator(_several)] = "stress"

    @property
    def gauges(self) -> tuple[str, ...]:
        """The gauges that it draws upwards; none where that is the stress or the force."""
        names = (self.y,) if isinstance(self.y, str) else self.y
        return () if names in (("stress",), ("force",)) else names
