"""The standard by which a scene tests: what its results are made of."""

from typing import Literal

from pydantic import model_validator

from masonry.scene.tables.types import Area, KeyedError, Length, Table

TESTS = {"EN 1052-1": "compression", "ASTM E519": "diagonal compression"}


class Standard(Table):
    """A test, the area (m2) that its stress is a mean of, and the gauges of its strains, over a length (m)."""

    test: Literal["EN 1052-1", "ASTM E519"]
    area: Area | None = None
    gauge_length: Length
    shortening: str = "displacement"
    extension: str | None = None

    @model_validator(mode="after")
    def _has_what_it_needs(self) -> "Standard":
        if self.test == "ASTM E519":
            if self.area is None:
                raise KeyedError("area", "missing; the net area (w + h)/2 t of the specimen, such as '0.3 m^2'")
            if self.extension is None:
                raise KeyedError("extension", "missing; the gauge across the diagonal that is pressed")
        elif self.extension is not None:
            raise KeyedError("extension", "belongs to ASTM E519; leave it out")
        return self
