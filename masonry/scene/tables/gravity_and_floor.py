"""Tables of a scene for weight that varies or turns, for blocks that start in motion, and for a floor below them."""

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, model_validator

from masonry.quantity import KINDS
from masonry.scene.tables import load_history as histories
from masonry.scene.tables.load_history import Timed
from masonry.scene.tables.loads_and_supports import LoadHistory
from masonry.scene.tables.types import (
    Acceleration,
    Duration,
    Given,
    KeyedError,
    Length,
    Position,
    Selector,
    SignedAngle,
    Steps,
    Table,
    refuse_both,
)

NO_ROTATION = 1e-9
"""rad: a tilt by less is none."""
Axis = Literal["x", "y", "z"]


def with_unit(kind: str) -> BeforeValidator:
    """A plain 0 needs no unit."""
    return BeforeValidator(lambda x: f"0 {KINDS[kind].unit}" if x == 0 and not isinstance(x, bool | str) else x)


Speed = Annotated[float, Given("velocity", "[-1e6, 1e6]"), with_unit("velocity")]
Spin = Annotated[float, Given("angular velocity", "[-1e6, 1e6]"), with_unit("angular velocity")]
Coordinate = Annotated[Position, with_unit("length")]


class Tilt(Table):
    """Gravity turned slowly about an axis by an angle (rad, right-hand rule), in so much time or so many steps."""

    about: Axis
    angle: SignedAngle
    duration: Duration | None = None
    steps: Steps | None = None

    @model_validator(mode="after")
    def _has_one_pace(self) -> "Tilt":
        if abs(self.angle) < NO_ROTATION:
            raise KeyedError("angle", "a tilt by 0 turns nothing; leave the table out, or give an angle")
        if (self.duration is None) == (self.steps is None):
            how = "missing; give duration or steps" if self.steps is None else "duration and steps exclude each other"
            raise KeyedError("steps", how)
        return self


class Gravity(Table):
    """An acceleration (m/s2, by direction): constant, times the shares of a `history`, or turned by a `tilt`.

    layers  so many slices of the specimen, of equal height, get their weight one after the other, the lowest first
    """

    x: Acceleration = 0.0
    y: Acceleration = 0.0
    z: Acceleration = 0.0
    history: LoadHistory = None
    duration: Duration | None = None
    tilt: Tilt | None = None
    layers: Annotated[int, Given("integer", "[1, 1000]")] = 1

    @property
    def vector(self) -> tuple[float, float, float]:
        """m/s2, as it is without a history, and before a tilt."""
        return self.x, self.y, self.z

    @property
    def parts(self) -> dict[str, tuple[np.ndarray, Timed | None]]:
        """By name, accelerations (3,) m/s2 that add up to gravity, each with its share over time, None where it is 1.

        What is turned about an axis a by an angle t is a (a.g) + cos(t) (g - a (a.g)) + sin(t) a x g.
        """
        whole = np.array(self.vector)
        if self.tilt is None:
            return {"gravity": (whole, histories.checked(self.history, self.duration, "number"))}
        axis, angle = np.eye(3)["xyz".index(self.tilt.about)], self.tilt.angle
        time = 1.0 if self.tilt.duration is None else self.tilt.duration
        along = axis * (axis @ whole)
        rotated: dict[str, tuple[np.ndarray, Timed | None]] = {
            "gravity cos": (whole - along, Timed(time, lambda t: np.cos(angle * (t / time)))),
            "gravity sin": (np.cross(axis, whole), Timed(time, lambda t: np.sin(angle * (t / time)))),
        }
        return rotated | ({"gravity": (along, None)} if along.any() else {})

    @property
    def paths(self) -> list[Timed]:
        """The shares of the parts that vary, in the order of `parts`."""
        return [path for _, path in self.parts.values() if path is not None]

    @model_validator(mode="before")
    @classmethod
    def _has_a_direction(cls, data: Any) -> Any:
        if not isinstance(data, dict) or not set(data) & set("xyz"):
            raise ValueError("must be a table by direction, with one or more of x, y, z")
        return data

    @model_validator(mode="after")
    def _varies_by_one_key(self) -> "Gravity":
        histories.checked(self.history, self.duration, "number")
        if self.layers > 1 and (self.history is not None or self.tilt is not None):
            raise KeyedError("layers", "a weight that comes on in layers stays as it is; leave out history and tilt")
        refuse_both(self, "history", "tilt")
        if self.tilt is None:
            return self
        if not any(g for axis, g in zip("xyz", self.vector, strict=True) if axis != self.tilt.about):
            raise KeyedError("tilt.about", f"gravity acts along {self.tilt.about} alone: turning it changes nothing")
        return self


class InitialMotion(Table):
    """Blocks that move as soon as the dead loads have settled: velocity (m/s) of a point, and spin (rad/s) about axes
    through it; the point is the centre of mass of these blocks unless `about` names it."""

    on: Selector
    velocity: tuple[Speed, Speed, Speed] = (0.0, 0.0, 0.0)
    spin: tuple[Spin, Spin, Spin] = (0.0, 0.0, 0.0)
    about: tuple[Coordinate, Coordinate, Coordinate] | None = None

    @model_validator(mode="after")
    def _moves(self) -> "InitialMotion":
        if not any((*self.velocity, *self.spin)):
            raise KeyedError("velocity", "missing; give a velocity, a spin or both, other than 0")
        return self


class Floor(Table):
    """A fixed block below the specimen: its upper face at `level`, the specimen's lowest point unless it says so."""

    level: Position | None = None
    size: tuple[Length, Length] | None = None
    thickness: Length | None = None
