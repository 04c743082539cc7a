"""Table of a scene for bars: ties, anchors and struts between two points of its blocks."""

from math import dist
from typing import Annotated, Literal

from pydantic import AfterValidator, StrictBool, model_validator

from masonry.scene.tables.gauge import column_name
from masonry.scene.tables.gravity_and_floor import Coordinate
from masonry.scene.tables.types import Area, Count, Gap, Given, KeyedError, Modulus, Table

Point = tuple[Coordinate, Coordinate, Coordinate]
Force = Annotated[float, Given("force", "[0, 1e15]")]
Yield = Annotated[float, Given("stress", "[1, 1e15]")]
SHORTEST = 1e-6
"""m, the least distance of two ends."""


class BarTable(Table):
    """A straight bar between two points `ends` (m), which pulls along itself, and pushes with `compression` only: a tie
    is slender. Elastic (`young_modulus` times `area` over the length) up to `strength` (Pa), and perfectly plastic
    there; without a strength it never yields.

    fixed_end   an end that lies in no block, and stays where it is in space
    pretension  N, to which it is tightened while the dead loads come on, were its ends to stay
    slack       m, by which its ends may part before it bears
    repeat      how many of them there are, each by `spacing` (m) farther on
    name        by which the results have a column of its force; of several bars one of each
    """

    ends: tuple[Point, Point]
    fixed_end: Literal["first", "second"] | None = None
    area: Area
    young_modulus: Modulus
    strength: Yield | None = None
    pretension: Force = 0.0
    slack: Gap = 0.0
    compression: StrictBool = False
    repeat: Count = 1
    spacing: Point | None = None
    name: Annotated[str, AfterValidator(column_name)] | None = None

    @property
    def yield_force(self) -> float | None:
        """N; None where it never yields."""
        return None if self.strength is None else self.strength * self.area

    @property
    def stiffness(self) -> float:
        """N/m, of its length without force."""
        return self.young_modulus * self.area / (dist(*self.ends) + self.slack)

    @property
    def names(self) -> tuple[str, ...]:
        """The columns of its forces, one for each that there is of it; none without a name."""
        if self.name is None:
            return ()
        return (self.name,) if self.repeat == 1 else tuple(f"{self.name} {k + 1}" for k in range(self.repeat))

    @property
    def places(self) -> list[tuple[Point, Point]]:
        """The two ends of each."""
        by = self.spacing or (0.0, 0.0, 0.0)
        return [tuple(tuple(x + k * d for x, d in zip(end, by, strict=True)) for end in self.ends)  # type: ignore[misc]
                for k in range(self.repeat)]  # fmt: skip

    @model_validator(mode="after")
    def _is_one_bar(self) -> "BarTable":
        if dist(*self.ends) < SHORTEST:
            raise KeyedError("ends", "are one and the same point: a bar has a length, and a direction")
        if self.pretension and self.slack:
            raise KeyedError("slack", "a bar is slack or pretensioned; keep one of slack and pretension")
        if self.compression and self.slack:
            raise KeyedError("slack", "a bar is slack or pushes; leave out slack, or leave out compression")
        if self.yield_force is not None and self.pretension > self.yield_force:
            raise KeyedError(
                "pretension", f"is more than the bar bears: strength times area is {self.yield_force:.6g} N"
            )
        if self.repeat > 1 and (self.spacing is None or not any(self.spacing)):
            raise KeyedError("spacing", "missing; how far the next bar lies from one, such as ['0 m', '1.2 m', '0 m']")
        if self.repeat == 1 and self.spacing is not None:
            raise KeyedError("spacing", "belongs to repeat, how many bars there are, which is missing")
        return self
