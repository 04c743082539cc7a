"""Table of a scene for a vehicle on a road above the structure."""

from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from masonry.scene.tables.gravity_and_floor import Coordinate
from masonry.scene.tables.loads_and_supports import Selector
from masonry.scene.tables.types import Gap, Given, KeyedError, Length, Position, Table

AxleLoad = Annotated[float, Given("force", "[1e-9, 1e15]")]
SpreadAngle = Annotated[float, Given("angle", "[0, 80] deg")]
Way = Literal["x", "-x"]
WHOLE = 1e-6
"""Share of an axle that makes no difference in words."""


class Vehicle(Table):
    """Axles that press down on a road, and spread through what lies between it and the blocks below.

    on         blocks whose free upper faces the road lies on
    level      m, z of the road
    axles      N, of each axle, from the first to the last
    spacings   m, from each axle to the next
    direction  in which the first axle leads; "both": either
    patch      m, along x, that an axle presses on
    spread     rad, from the vertical, by which its load spreads on both sides with the depth
    position   m, x of the middle between the first axle and the last; None: it travels
    between    m, the least and the greatest position where it travels; None: wherever it presses on the blocks
    """

    on: Selector
    level: Position
    axles: Annotated[tuple[AxleLoad, ...], Field(min_length=1, max_length=100)]
    spacings: tuple[Length, ...] = ()
    direction: Literal["x", "-x", "both"] = "both"
    patch: Gap = 0.0
    spread: SpreadAngle = 0.0
    position: Coordinate | None = None
    between: tuple[Coordinate, Coordinate] | None = None

    @property
    def length(self) -> float:
        """m, from the first axle to the last."""
        return sum(self.spacings)

    @property
    def total(self) -> float:
        """N, of all axles."""
        return sum(self.axles)

    @property
    def is_symmetric(self) -> bool:
        """Whether it is the same one in both directions."""
        return self.axles == self.axles[::-1] and self.spacings == self.spacings[::-1]

    @property
    def directions(self) -> tuple[Way, ...]:
        """Those in which it travels that differ."""
        if self.direction == "both":
            return ("x",) if self.is_symmetric else ("x", "-x")
        return (self.direction,)

    @property
    def words(self) -> str:
        """Pressing load in words, and where it stands, if it does."""
        return self.words_with([1.0] * len(self.axles))

    def words_with(self, shares: list[float]) -> str:
        """The same; shares: of the load of each axle, that on the structure."""
        number = len(self.axles)
        axles = "the axle" if number == 1 else f"the {number} axles"
        leads = "" if self.is_symmetric else f", which leads along {self.directions[0]}"
        words = f"{axles} of the vehicle{leads}, {self.total * 1e-3:.6g} kN in all"
        if self.position is None:
            return words
        places = self.places(self.position, self.directions[0]).tolist()
        each = [f"{x:.4f} m{_beside(share)}" for x, share in zip(places, shares, strict=True)]
        if number == 1:
            return f"{words}, at x = {each[0]}"
        middle = f"with its middle at x = {self.position:.4f} m"
        return f"{words}, {middle}, and axles at {', '.join(each[:-1])} and {each[-1]}"

    def places(self, position: float, direction: Way = "x") -> np.ndarray:
        """(n,) m, x of each axle, from the first to the last."""
        behind = np.concatenate([[0.0], np.cumsum(self.spacings)])
        return np.asarray(position + (0.5 * self.length - behind) * (1.0 if direction == "x" else -1.0))

    @model_validator(mode="after")
    def _has_its_spacings(self) -> "Vehicle":
        if len(self.spacings) != len(self.axles) - 1:
            raise KeyedError(
                "spacings",
                f"{len(self.axles)} axles have {len(self.axles) - 1} spacings; here are {len(self.spacings)}",
            )
        return self

    @model_validator(mode="after")
    def _stands_or_travels(self) -> "Vehicle":
        if self.between is not None:
            if self.position is not None:
                raise KeyedError(
                    "between", "position says where it stands, and between where it travels; keep one of them"
                )
            if self.between[0] >= self.between[1]:
                raise KeyedError("between", "must be a lower and a higher position, for example ['-1 m', '6 m']")
        if self.position is not None and len(self.directions) > 1:
            raise KeyedError(
                "direction", "these axles differ by direction: with a position give direction = 'x' or '-x'"
            )
        return self


def _beside(share: float) -> str:
    """Of an axle that is not on the structure as a whole, in words; share: of its load, that on the structure."""
    if share >= 1.0 - WHOLE:
        return ""
    return f" ({100 * share:.3g} % of it on the structure)" if share > WHOLE else " (not on the structure)"
