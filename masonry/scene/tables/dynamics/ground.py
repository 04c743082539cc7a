"""Table of a scene for the ground that moves: a record or a formula, one to three components, scaled, and from when."""

from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Self

import numpy as np
from pydantic import Field, create_model, model_validator

from masonry.errors import SceneError, nearest
from masonry.ground.ground_motion import Motion, from_formula, from_samples
from masonry.ground.records.motion_units import factor_of
from masonry.ground.records.reading import read_record
from masonry.ground.records.record_file import RecordFile
from masonry.scene.tables import expression
from masonry.scene.tables.dynamics.acceleration_in_g import AccelerationInG
from masonry.scene.tables.dynamics.made_record import COMPONENTS, MadeGround
from masonry.scene.tables.gravity_and_floor import with_unit
from masonry.scene.tables.types import Duration, Given, KeyedError, Selector, Table, refuse_both

AXES = "xyz"
STILL, MOST = 1e-9, 1e6
"""m/s2: ground that accelerates by less does not shake, and none accelerates by more."""


class GivenMotion(Table):
    """A motion along x, y, z: columns of a `record`, records `made` by seed, or formulas of t for a `duration`."""

    PLACE: ClassVar[str] = "ground"

    record: Annotated[str, Field(min_length=1)] | None = None
    made: MadeGround | None = None
    quantity: Literal["acceleration", "velocity", "displacement"] = "acceleration"
    unit: Annotated[str, Field(min_length=1, max_length=40)] | None = None
    time: Annotated[str, Field(min_length=1, max_length=200)] | None = None
    step: Duration | None = None
    x: Annotated[str, Field(min_length=1)] | None = None
    y: Annotated[str, Field(min_length=1)] | None = None
    z: Annotated[str, Field(min_length=1)] | None = None
    duration: Duration | None = None
    scale: Annotated[float, Given("number", "[-1e6, 1e6]")] | None = None
    peak: AccelerationInG | None = None
    begin: Annotated[float, Given("time", "[0, 1e6]"), with_unit("time")] = 0.0
    baseline: Literal["none", "linear"] = "none"

    @property
    def components(self) -> dict[str, str]:
        """The axes along which it moves, in the order x, y, z, each with its column or formula."""
        return {axis: word for axis in AXES if (word := getattr(self, axis)) is not None}

    @property
    def motions(self) -> dict[str, Motion]:
        """The motion along each axis, with its baseline and to scale; time 0 is where it begins. Raises SceneError."""
        stamp = None if self.record is None else _stamp(self.record)
        return _motions(self, stamp)

    @property
    def rate(self) -> float:
        """Hz, samples a second of a record; 0 of formulas, which have none."""
        if self.record is None and self.made is None:
            return 0.0
        return float(max(1.0 / np.median(np.diff(motion.time)) for motion in self.motions.values()))

    @property
    def runs_for(self) -> float:
        """s, until the motion ends, the time before it begins included."""
        return self.begin + max(motion.duration for motion in self.motions.values())

    @model_validator(mode="after")
    def _has_one_source(self) -> Self:
        if not self.components:
            raise KeyedError(
                "x",
                "missing; name a column of the record for x, y or z, or 'first' of [ground.made], or give a formula",
            )
        refuse_both(self, "scale", "peak")
        if self.scale == 0.0:
            raise KeyedError("scale", "ground that is scaled by 0 does not move; leave the table out")
        if self.made is not None:
            self._made_is_whole()
        elif self.record is None:
            self._formulas_are_whole()
        elif self.duration is not None:
            raise KeyedError("duration", "a record has its own; leave it out (solver.duration ends a run before)")
        elif self.step is not None and self.time is not None:
            raise KeyedError("step", "the column 'time' says the same; keep one of them")
        elif self.unit is not None:
            _checked("unit", factor_of, self.unit, self.quantity, "unit")
        return self

    def _made_is_whole(self) -> None:
        for key in ("record", "duration", "unit", "time", "step"):
            if getattr(self, key) is not None:
                raise KeyedError(key, "does not go with [ground.made], which says all of the record; keep one of them")
        if self.quantity != "acceleration":
            raise KeyedError("quantity", "records that are made by seed are accelerations; leave it out")
        for axis, word in self.components.items():
            if word not in COMPONENTS:
                raise KeyedError(axis, f"'{word[:60]}' is no component of [ground.made]; {nearest(word, COMPONENTS)}")

    def _formulas_are_whole(self) -> None:
        for axis, text in self.components.items():
            _checked(axis, expression.read, text, self.quantity)
        for key in ("unit", "time", "step"):
            if getattr(self, key) is not None:
                raise KeyedError(key, f"belongs to a record; a formula has units of its own, {axis} = '0.4 g * ...'")
        if self.duration is None:
            raise KeyedError("duration", "missing; a formula needs it, for example '10 s'; or give record, a CSV file")
        for axis, text in self.components.items():
            _checked(axis, expression.require_finite, expression.read(text, self.quantity), self.duration)


if TYPE_CHECKING:
    _HasAs = GivenMotion
else:  # "as" is a word of Python's own
    _HasAs = create_model("_HasAs", __base__=GivenMotion, **{"as": (Literal["inertia", "base"], "inertia")})


class Ground(_HasAs):
    """A motion that supports and floor share.

    as  "inertia": the frame of the ground, in which forces of inertia act; "base": supports and floor are moved
    on  selector of the support (or "floor") that moves so, where several move apart
    """

    on: Selector | None = None

    @property
    def moves_supports(self) -> bool:
        """Whether supports and floor are moved; else forces of inertia act in the frame of the ground."""
        return bool(getattr(self, "as") == "base")


def as_tables(value: Any) -> Any:
    """One table, or several in double brackets."""
    return (value,) if isinstance(value, dict | Ground) else value


def as_written(value: tuple[Ground, ...], handler: Any) -> Any:
    """One alone is a table."""
    tables = handler(value)
    return tables[0] if len(tables) == 1 and "on" not in tables[0] else tables


def _checked(key: str, read: Any, *arguments: Any) -> None:
    """KeyedError where what a key holds cannot be read."""
    try:
        read(*arguments)
    except ValueError as error:
        raise KeyedError(key, str(error).removeprefix(f"{key}: ")) from None


def _stamp(record: str) -> int | None:
    """When a file was changed last."""
    try:
        return Path(record).stat().st_mtime_ns
    except (OSError, ValueError):
        return None


@lru_cache(maxsize=16)
def _record(record: str, stamp: int | None) -> RecordFile:
    return read_record(Path(record))


@lru_cache(maxsize=16)
def _motions(ground: GivenMotion, stamp: int | None) -> dict[str, Motion]:
    """See Ground.motions."""
    motions = {axis: _component(ground, axis, word, stamp) for axis, word in ground.components.items()}
    peaks = [motion.peak_acceleration for motion in motions.values()]
    most = max(peaks) if np.isfinite(peaks).all() else np.inf
    if most < STILL:
        raise SceneError(f"{ground.PLACE}: it never accelerates; is this the right column?")
    scale = ground.peak / most if ground.peak is not None else 1.0 if ground.scale is None else ground.scale
    if not abs(scale) * most <= MOST:
        raise SceneError(
            f"{ground.PLACE}: it accelerates by {abs(scale) * most:.3g} m/s^2; at most {MOST:g} are allowed"
        )
    return {axis: motion.scaled(scale) for axis, motion in motions.items()}


def _component(ground: GivenMotion, axis: str, word: str, stamp: int | None) -> Motion:
    """One component as it is given, with its baseline."""
    try:
        if ground.made is not None:
            made = ground.made.record(word)
            return from_samples("acceleration", made.time, made.acceleration, ground.baseline)
        if ground.record is not None:
            file = _record(ground.record, stamp)
            if file.times_in(ground.time, ground.step) == file.column(word):
                raise SceneError(f"{axis} = '{word[:60]}' is the column of the times: name one of a motion")
            with np.errstate(over="ignore"):  # what is not finite is told below
                values = file.samples(word, ground.quantity, ground.unit)
            return from_samples(ground.quantity, file.time(ground.time, ground.step), values, ground.baseline)
        assert ground.duration is not None
        motion = from_formula(ground.quantity, expression.read(word, ground.quantity), ground.duration)
        if ground.baseline == "linear" and ground.quantity == "acceleration":
            return motion.with_linear_baseline()
        return motion
    except SceneError as error:
        if str(error).startswith("unit: "):
            raise SceneError(f"{ground.PLACE}.{error}") from None
        if ground.made is not None:
            raise SceneError(str(error).replace("ground", ground.PLACE, 1)) from None
        raise error.within(f"{ground.PLACE}.record") from None
    except ValueError as error:
        raise SceneError(f"{ground.PLACE}.{axis}: {error}") from None
