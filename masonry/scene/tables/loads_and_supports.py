"""Tables of a scene for its supports, its loading and the explicit solver."""

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, PlainSerializer, ValidationInfo, model_validator

from masonry.quantity import convert
from masonry.scene.tables import load_history as histories
from masonry.scene.tables.load_history import History, Timed, is_timed
from masonry.scene.tables.types import (
    Damping,
    Density,
    Direction,
    Dof,
    Duration,
    Fraction,
    Frames,
    Frequency,
    Given,
    KeyedError,
    Length,
    Position,
    Rows,
    Selector,
    Skin,
    Steps,
    StressVector,
    Table,
    UnitInterval,
    Velocity,
)

BOUNDS = ("gershgorin", "equation-11")


def _freedoms(value: Any) -> Any:
    """ "all", one dof or a list of them."""
    if value == "all":
        return ("x", "y", "z", "rotation")
    return (value,) if isinstance(value, str) else value


def _time_step(value: Any) -> str | float:
    if isinstance(value, str) and (value in BOUNDS or not value[:1].isdigit()):
        if value in BOUNDS:
            return value
        raise ValueError(f"'{value[:40]}' is not allowed; time_step is one of {', '.join(BOUNDS)}, or a time: '1e-6 s'")
    return convert(value, "time", "time_step", "[1e-18, 1e9]")


def accuracy_share(value: Any) -> Any:
    """A share, or a percentage: 0.01 or "1 %"."""
    if not (isinstance(value, str) and value.rstrip().endswith("%")):
        return value if value is None else convert(value, "number", "accuracy", "[1e-4, 0.2]")
    try:
        return convert(value.rstrip()[:-1], "number", "accuracy", "[0.01, 20]") / 100
    except ValueError:
        raise ValueError(f"{value[:40]!r} does not fit; accuracy must be in [0.01, 20] %") from None


Accuracy = Annotated[float, BeforeValidator(accuracy_share)]
"""A share that a file gives as such or in per cent."""


def _rotation(value: Any, info: ValidationInfo) -> float:
    kind, allowed = ("angle", "(0, 90) deg") if isinstance(value, str) else ("number", "(0, 1.6)")
    return convert(value, kind, info.field_name or "", allowed)


def _slip(value: Any) -> float:
    """A share, or a percentage: 0.25 or "25 %"."""
    if isinstance(value, str) and value.rstrip().endswith("%"):
        return convert(value.rstrip()[:-1], "number", "slip_limit", "(0, 100000]") / 100
    return convert(value, "number", "slip_limit", "(0, 1000]")


DriveHistory = Annotated[
    History | None,
    BeforeValidator(lambda value: histories.read(value, "length")),
    PlainSerializer(lambda value: histories.written(value, "length"), when_used="unless-none"),
]
LoadHistory = Annotated[
    History | None,
    BeforeValidator(lambda value: histories.read(value, "number")),
    PlainSerializer(lambda value: histories.written(value, "number"), when_used="unless-none"),
]


class Support(Table):
    """Blocks or an outer face that are held in some directions."""

    on: Selector
    fix: Annotated[tuple[Dof, ...], BeforeValidator(_freedoms), Field(min_length=1)]


class Drive(Table):
    """Blocks moved in one direction by `displacement` (m), or along a `history`: to an accuracy, at `rate` (m/s), in so
    many `steps`, or in the time that the history takes."""

    on: Selector
    direction: Direction
    displacement: Length | None = None
    history: DriveHistory = None
    duration: Duration | None = None
    accuracy: Accuracy | None = None
    rate: Velocity | None = None
    steps: Steps | None = None
    ramp: UnitInterval = 0.3

    @property
    def axis(self) -> int:
        return "xyz".index(self.direction[-1])

    @property
    def sign(self) -> float:
        return -1.0 if self.direction[0] == "-" else 1.0

    @property
    def path(self) -> Timed | None:
        """The displacement (m) over time, where the history has times."""
        return histories.checked(self.history, self.duration, "length")

    @property
    def reversals(self) -> tuple[float, ...]:
        """The places (m, along the direction) that the drive visits one after the other."""
        if self.history is None:
            return (self.displacement or 0.0,)
        path = self.path
        return self.history if path is None else path.turning_points()  # type: ignore[return-value]

    @property
    def farthest(self) -> float:
        """m, how far from its start the drive comes."""
        return max(map(abs, self.reversals))

    @model_validator(mode="after")
    def _is_given_once(self) -> "Drive":
        if self.history is None and self.displacement is None:
            raise KeyedError("displacement", "missing; give it, for example '20 mm', or a history that turns back")
        if self.history is not None and self.displacement is not None:
            raise KeyedError("displacement", "displacement and history exclude each other; keep one of them")
        path = histories.checked(self.history, self.duration, "length")
        if path is not None:
            histories.require_a_start_at_0(path)
        if path is not None and self.rate is not None:
            raise KeyedError("rate", "a history with times has its own; leave it out, or give accuracy or steps")
        return self

    @model_validator(mode="after")
    def _has_one_pace(self) -> "Drive":
        paces = [key for key in ("accuracy", "rate", "steps") if getattr(self, key) is not None]
        if len(paces) > 1:
            raise KeyedError(paces[-1], f"{' and '.join(paces)} exclude each other; keep one of them")
        own_time = self.history is not None and is_timed(self.history)
        return self if paces or own_time else self.model_copy(update={"accuracy": 0.01})


class Traction(Table):
    """A force per area (Pa, by direction) on an outer face: constant, or times the shares of a `history`."""

    on: Selector
    stress: StressVector
    line_of_action: Literal["moving", "fixed"] = "moving"
    history: LoadHistory = None
    duration: Duration | None = None

    @property
    def stays_in_space(self) -> bool:
        """Whether its line of action stays where it is as the block below moves; else it goes with the face."""
        return self.line_of_action == "fixed"

    @property
    def path(self) -> Timed | None:
        """The share of the stress over time, where it varies."""
        return histories.checked(self.history, self.duration, "number")

    @property
    def paths(self) -> list[Timed]:
        """The same as a list: empty where it does not vary."""
        return [path] if (path := self.path) is not None else []

    @model_validator(mode="after")
    def _has_a_time(self) -> "Traction":
        histories.checked(self.history, self.duration, "number")
        return self


class Fill(Table):
    """Loose earth on blocks up to a level (m, along z): its weight presses down on the faces that look up to it."""

    on: Selector
    level: Position
    density: Density


class Settle(Table):
    """Steps in which the dead loads rise and come to rest before the drive starts, 0 where they act at once; without
    the table the run finds how many they need."""

    steps: Annotated[int, Given("integer", "[0, 1e8]")]


class Solver(Table):
    """The explicit step. time_step: the name of a bound, or seconds; step_fraction: of that bound."""

    masses: Literal["scaled", "real"] = "scaled"
    time_step: Annotated[
        str | float,
        BeforeValidator(_time_step),
        PlainSerializer(lambda value: value if isinstance(value, str) else f"{value!r} s"),
    ] = "gershgorin"
    step_fraction: Fraction = 0.9
    damping: Damping = 0.8
    rotation_limit: Annotated[float, BeforeValidator(_rotation)] = 0.02
    slip_limit: Annotated[float, BeforeValidator(_slip)] = 0.25
    duration: Duration | None = None
    until: Literal["rest"] | None = None
    skin: Skin | None = None
    rows: Rows = 1000
    sampling: Frequency | None = None
    frames: Frames = 24

    @model_validator(mode="before")
    @classmethod
    def _paper_fraction(cls, data: Any) -> Any:
        """Eq. (11) has its own default, frac = 0.1."""
        if isinstance(data, dict) and data.get("time_step") == "equation-11":
            return {"step_fraction": 0.1, **data}
        return data
