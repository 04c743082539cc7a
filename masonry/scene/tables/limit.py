"""Table of a scene for the load that `masonry limit` multiplies by a factor."""

from typing import Annotated, Any, Literal, NamedTuple

from pydantic import BeforeValidator, Field, PlainSerializer, model_validator

from masonry.scene.tables.gravity_and_floor import Coordinate
from masonry.scene.tables.load_history import read_factors
from masonry.scene.tables.loads_and_supports import accuracy_share
from masonry.scene.tables.types import Direction, Gap, Given, KeyedError, Selector, StressVector, Table

Force = Annotated[float, Given("force", "[-1e15, 1e15]")]
KEYS = {
    "weight": ("direction",),
    "tilt": ("about",),
    "force": ("on", "force", "at"),
    "traction": ("on", "stress"),
    "drive": (),
    "vehicle": (),
}
"""Keys of each pattern."""
OPTIONAL = ("at",)
LEFT_OUT = "none"
"""The accuracy of a load that runs leave out on purpose."""
OF_RUNS = ("accuracy", "up_to", "travel", "control", "until", "history")
"""Keys of runs that drive the load to collapse, and beyond it, or to and fro, with any pattern but "drive"."""
EXAMPLES = {
    "direction": 'direction = "x"',
    "about": 'about = "y"',
    "on": 'on = "top"',
    "force": 'force = {z = "-1 kN"}',
    "stress": 'stress = {x = "1 kPa"}',
}


class ForceTable(NamedTuple):
    """N, by direction; what a file leaves out is 0."""

    x: Force = 0.0
    y: Force = 0.0
    z: Force = 0.0


def _accuracy(value: Any) -> Any:
    """A share, a percentage, or the word by which runs leave the load out."""
    if value == LEFT_OUT:
        return value
    if isinstance(value, str) and value.strip().lower() == LEFT_OUT:
        raise ValueError(
            f"{value[:40]!r} is not allowed; did you mean '{LEFT_OUT}', by which runs leave this load out?"
        )
    try:
        return accuracy_share(value)
    except ValueError as error:
        raise ValueError(f"{error}; or '{LEFT_OUT}', by which runs leave this load out") from None


def _directions(value: Any) -> Any:
    if isinstance(value, ForceTable):
        return value
    if not isinstance(value, dict) or not value:
        raise ValueError("must be a table by direction, with one or more of x, y, z")
    return value


def _written(value: ForceTable) -> dict[str, str]:
    return {axis: f"{x!r} N" for axis, x in value._asdict().items() if x != 0.0}


ForceVector = Annotated[ForceTable, BeforeValidator(_directions), PlainSerializer(_written)]


class LimitLoad(Table):
    """The load that the factor multiplies, by its pattern: the weight in another direction, gravity turned about an
    axis, a force on blocks, a traction on a face, what the drive pushes with, or the axles of a vehicle. With an
    accuracy a run lets it grow until nothing balances it, up to a factor at most: what moves and rests again within a
    travel has not fallen. A gauge to control is then led on until it reads so much. Or the load goes to and fro,
    through the factors of a history. With the accuracy "none" runs leave it out on purpose."""

    pattern: Literal["weight", "tilt", "force", "traction", "drive", "vehicle"]
    direction: Direction | None = None
    about: Direction | None = None
    on: Selector | None = None
    force: ForceVector | None = None
    at: tuple[Coordinate, Coordinate, Coordinate] | None = None
    stress: StressVector | None = None
    accuracy: Annotated[float | Literal["none"] | None, BeforeValidator(_accuracy)] = None
    up_to: Annotated[float, Given("number", "[1e-6, 1e6]")] | None = None
    travel: Gap | None = None
    control: Annotated[str, Field(max_length=60)] | None = None
    until: Annotated[float, Given("length", "[-1e5, 1e5]")] | None = None
    history: Annotated[tuple[float, ...] | None, BeforeValidator(read_factors)] = None

    @property
    def run_accuracy(self) -> float | None:
        """To which a run encloses the factor; None where a run leaves the load out."""
        return self.accuracy if isinstance(self.accuracy, float) else None

    @property
    def words(self) -> str:
        """Load that the factor multiplies; of a drive and of a vehicle their own tables say it."""
        return {
            "weight": f"the weight along {self.direction}",
            "tilt": f"gravity turned about {self.about}: the factor is the tangent of the angle",
            "traction": f"the traction on '{self.on}'",
            "force": f"the force on '{self.on}'",
            "drive": "the force of the drive",
            "vehicle": "the axles of the vehicle",
        }[self.pattern]

    @model_validator(mode="after")
    def _has_its_keys(self) -> "LimitLoad":
        mine = KEYS[self.pattern]
        for key in type(self).model_fields:
            is_there = getattr(self, key) is not None
            if key in OF_RUNS:
                continue
            if key != "pattern" and is_there and key not in mine:
                others = [name for name, keys in KEYS.items() if key in keys]
                raise KeyedError(key, f"belongs to pattern = {' or '.join(map(repr, others))}; leave it out")
            if key in mine and not is_there and key not in OPTIONAL:
                raise KeyedError(key, f"missing; pattern = '{self.pattern}' needs it, for example {EXAMPLES[key]}")
        if self.accuracy is not None and self.pattern == "drive":
            raise KeyedError("accuracy", "a run moves the drive by [drive] itself, which has an accuracy; leave it out")
        self._can_end()
        self._can_be_led()
        self._can_turn_back()
        for key in ("force", "stress"):
            if getattr(self, key) is not None and not any(getattr(self, key)):
                raise KeyedError(key, "is 0 in all directions; give one that is not")
        return self

    def _can_end(self) -> None:
        if self.run_accuracy is None and self.up_to is not None:
            raise KeyedError("up_to", "a run whose load grows ends there: that needs accuracy = '1 %'")
        if self.run_accuracy is None and self.travel is not None:
            raise KeyedError(
                "travel", "a run whose load grows takes what moves farther for a fall: that needs accuracy = '1 %'"
            )

    def _can_be_led(self) -> None:
        if (self.control is None) != (self.until is None):
            missing, other = ("until", "control") if self.until is None else ("control", "until")
            raise KeyedError(missing, f"missing; {other} needs it: control = a gauge's name, until = '80 mm'")
        if self.control is not None and self.run_accuracy is None:
            raise KeyedError("control", "a run leads this gauge on after the collapse: that needs accuracy = '1 %'")
        if self.until == 0.0:
            raise KeyedError("until", "is 0; give the reading of the gauge at which the run ends")

    def _can_turn_back(self) -> None:
        if self.history is None:
            return
        if self.run_accuracy is None:
            raise KeyedError(
                "history", "a run follows this history: that needs accuracy = '1 %', and a table [[gauge]]"
            )
        for key in ("up_to", "control", "until"):
            if getattr(self, key) is not None:
                raise KeyedError(
                    key, "belongs to a load that grows, and the history says where this one goes; leave it out"
                )
