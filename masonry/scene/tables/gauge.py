"""Measurements that a scene asks for besides the drive, and the axes of its curve."""

import re
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple

import numpy as np
from pydantic import AfterValidator, Field, PlainSerializer, PlainValidator, ValidationInfo, model_validator

from masonry.errors import SceneError, visible
from masonry.ground.records.reading import read_columns
from masonry.quantity import convert
from masonry.rows.measured_curve import ForcePath
from masonry.scene.tables.types import Direction, KeyedError, Table

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


def column_name(value: str) -> str:
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

    name: Annotated[str, AfterValidator(column_name)]
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
    """Content of curve.png: a gauge, the displacement of the drive or the time across; stress or force, or over the
    time one gauge or several, up."""

    x: str = "displacement"
    y: Annotated[str | tuple[str, ...], PlainValidator(_several)] = "stress"
    measured: Annotated[str, Field(min_length=1, max_length=4000)] | None = None
    measured_columns: tuple[str, str] | None = None
    measured_units: tuple[str, str] | None = None

    @property
    def gauges(self) -> tuple[str, ...]:
        """The gauges that it draws upwards; none where that is the stress or the force."""
        names = (self.y,) if isinstance(self.y, str) else self.y
        return () if names in (("stress",), ("force",)) else names

    def measurement(self, section: float) -> ForcePath | None:
        """The measured curve: m, and N over a section (m2) where it is a stress. Raises SceneError."""
        return None if self.measured is None else _measurement(self, Path(self.measured), section)

    @model_validator(mode="after")
    def _measures_what_it_draws(self) -> "Curve":
        if self.measured is None:
            for key in ("measured_columns", "measured_units"):
                if getattr(self, key) is not None:
                    raise KeyedError(key, "belongs to measured, the file of a measured curve, which is missing")
            return self
        if self.gauges or self.x == "time":
            raise KeyedError("measured", "is a force or stress over a displacement: leave curve.x = 'time' out")
        try:
            self.measurement(1.0)
        except SceneError as error:
            raise KeyedError("measured", str(error)) from None
        return self


def _measurement(curve: Curve, path: Path, section: float) -> ForcePath:
    record = read_columns(path)
    if record.values.shape[1] < 2:
        raise SceneError(f"{record.name} has one column: a curve has two, displacement and force")
    columns = [record.column(word) for word in curve.measured_columns or ("1", "2")]
    units = curve.measured_units or [record.unit_of(column) for column in columns]
    scaled = []
    for k, (column, unit, allowed) in enumerate(zip(columns, units, (("length",), ("force", "stress")), strict=True)):
        name = visible(record.columns[column][:60])
        if unit is None:
            raise SceneError(f"measured_units: missing; {record.name} has no unit behind '{name}': ['mm', 'kN']")
        kind = next((one for one in allowed if _fits(unit, one)), None)
        if kind is None:
            what = "a length, such as mm" if k == 0 else "a force or a stress, such as kN or MPa"
            raise SceneError(f"{record.name}, column '{name}': '{visible(unit[:40])}' is not the unit of {what}")
        factor = convert(f"1 {unit}", kind, "measured_units") * (section if kind == "stress" else 1.0)
        scaled.append(factor * record.values[:, column])
    if not np.ptp(scaled[0]) > 0.0:
        raise SceneError(f"{record.name}: its displacement does not change; is it the right column?")
    return ForcePath(*scaled)


def _fits(unit: str, kind: str) -> bool:
    try:
        convert(f"1 {unit}", kind, "unit")
    except ValueError:
        return False
    return True
