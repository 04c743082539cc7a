"""Table of a scene, or of the command `masonry record`, for a record that is made by seed."""

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, PlainSerializer, model_validator

from masonry.errors import SceneError
from masonry.ground.made import MadeRecord, Recipe, make_record
from masonry.ground.target_spectrum import Eurocode8, FilteredNoise, TableSpectrum
from masonry.quantity import convert
from masonry.scene.tables.dynamics.acceleration_in_g import AccelerationInG, in_m_s2
from masonry.scene.tables.types import Damping, Given, KeyedError, Number, Table

COMPONENTS = ("first", "second", "third")
"""Names of records of one seed that are independent of each other, for x, y and z."""
KEYS_OF = {
    "eurocode-8-1": ("soil", "a_g", "damping"),
    "eurocode-8-2": ("soil", "a_g", "damping"),
    "table": ("table", "damping"),
    "kanai-tajimi": ("peak", "soil_period", "soil_damping"),
    "clough-penzien": ("peak", "soil_period", "soil_damping", "filter_period", "filter_damping"),
}
"""Keys that belong to a spectrum."""
NEEDED = {"a_g": "'0.2 g'", "table": "[['0.1 s', '0.5 g'], ['1 s', '0.2 g']]", "peak": "'0.3 g'"}
MOST_SAMPLES = 200_000


def _pairs(value: Any) -> Any:
    """Rows of a period and an acceleration, in SI."""
    if not isinstance(value, list | tuple) or not 2 <= len(value) <= 1000:
        raise ValueError("a spectrum is a list of two rows or more: [['0.1 s', '0.5 g'], ['1 s', '0.2 g']]")
    rows = []
    for row in value:
        if not isinstance(row, list | tuple) or len(row) != 2:
            raise ValueError(f"{row!r:.60} is no row of a period and an acceleration: ['0.1 s', '0.5 g']")
        rows.append((convert(row[0], "time", "period", "[1e-4, 1000]"), in_m_s2(row[1], "acceleration", "(0, 1e6]")))
    if any(a[0] >= b[0] for a, b in zip(rows, rows[1:], strict=False)):
        raise ValueError("the periods of a spectrum must grow from row to row")
    return tuple(rows)


def _written(rows: tuple[tuple[float, float], ...]) -> list[list[str]]:
    return [[f"{period!r} s", f"{acceleration!r} m/s^2"] for period, acceleration in rows]


Rows = Annotated[tuple[tuple[float, float], ...], BeforeValidator(_pairs), PlainSerializer(_written)]
Period = Annotated[float, Given("time", "[1e-3, 100]")]
Share = Annotated[float, Given("number", "[0.01, 1]")]
WholeRecord = Annotated[float, Given("time", "[0.1, 3600]")]


class MadeGround(Table):
    """A record of a response spectrum (Eurocode 8, a table) or of a power spectrum (Kanai-Tajimi, Clough-Penzien).

    What is left out: rise 0.15 and strong 0.4 of the duration; longest 4 s, or a fifth of the duration if that is less;
    the soil of the power spectra 0.4 s and 0.6, their filter ten times the period of the soil and 0.6.
    """

    spectrum: Literal["eurocode-8-1", "eurocode-8-2", "table", "kanai-tajimi", "clough-penzien"]
    seed: Number = 1
    duration: WholeRecord
    step: Annotated[float, Given("time", "[1e-4, 0.1]")] = 0.01
    soil: Literal["A", "B", "C", "D", "E"] | None = None
    a_g: AccelerationInG | None = None
    table: Rows | None = None
    damping: Damping | None = None
    peak: AccelerationInG | None = None
    soil_period: Period | None = None
    soil_damping: Share | None = None
    filter_period: Period | None = None
    filter_damping: Share | None = None
    rise: Annotated[float, Given("time", "[0, 3600]")] | None = None
    strong: Annotated[float, Given("time", "[0, 3600]")] | None = None
    shortest: Period = 0.05
    longest: Period | None = None
    tolerance: Share = 0.1

    @model_validator(mode="after")
    def _fits_its_spectrum(self) -> "MadeGround":
        own = KEYS_OF[self.spectrum]
        for key in dict.fromkeys(key for keys in KEYS_OF.values() for key in keys):
            if key not in own and getattr(self, key) is not None:
                raise KeyedError(key, f"does not belong to spectrum = '{self.spectrum}', which has {', '.join(own)}")
        for key, example in NEEDED.items():
            if key in own and getattr(self, key) is None:
                raise KeyedError(key, f"missing; spectrum = '{self.spectrum}' needs it: {key} = {example}")
        if self.duration / self.step > MOST_SAMPLES:
            raise KeyedError("step", f"{self.duration / self.step:.3g} samples; {MOST_SAMPLES} are allowed")
        try:
            self.recipe.require()
        except ValueError as error:
            key, _, words = str(error).partition(": ")
            raise KeyedError(key, words) from None
        return self

    @property
    def recipe(self) -> Recipe:
        """Parameters from which the record is made, in SI."""
        rise = 0.15 * self.duration if self.rise is None else self.rise
        strong = 0.4 * self.duration if self.strong is None else self.strong
        longest = min(4.0, 0.2 * self.duration) if self.longest is None else self.longest
        of = (self.duration, self.step, rise, strong, self.peak, self.shortest, longest, self.tolerance)
        return Recipe(self._target(), *of)

    def _target(self) -> Eurocode8 | TableSpectrum | FilteredNoise:
        damping = 0.05 if self.damping is None else self.damping
        if self.a_g is not None:
            return Eurocode8(int(self.spectrum[-1]), self.soil or "A", self.a_g, damping)
        if self.table is not None:
            periods, accelerations = zip(*self.table, strict=True)
            return TableSpectrum(periods, accelerations, damping)
        period = self.soil_period or 0.4
        soil = (2.0 * np.pi / period, self.soil_damping or 0.6)
        if self.spectrum == "kanai-tajimi":
            return FilteredNoise(soil)
        return FilteredNoise(soil, (2.0 * np.pi / (self.filter_period or 10.0 * period), self.filter_damping or 0.6))

    def record(self, component: str = COMPONENTS[0]) -> MadeRecord:
        """The record of a component, one of COMPONENTS. Raises SceneError where it cannot be matched."""
        try:
            return make_record(self.recipe, self.seed, COMPONENTS.index(component))
        except ValueError as error:
            raise SceneError(f"ground.made.{error}") from None
