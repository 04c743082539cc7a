"""The gauge that is led on behind a collapse."""

import numpy as np

from masonry.loading.moves.moved import Arrays, copied_dofs
from masonry.model.gauges import Gauge
from masonry.model.model import Model
from masonry.monitors.stability import smallest_block
from masonry.runtime.state_file import Remembering


class LedGauge(Remembering):
    """A gauge, from where it stood at the last rest to a reading (m).

    start   m, its reading then     sense   1 or -1, where it is led     travel  m, how far it has come
    size    m, of the specimen
    """

    REMEMBERED = ("start", "sense", "travel")

    def __init__(self, model: Model, gauge: Gauge, until: float) -> None:
        """until: the reading (m) to which it is led"""
        self.model, self.gauge, self.until = model, gauge, until
        self.size = max(float(np.ptp(model.layout.centroid, axis=0).max()), smallest_block(model))
        self.start = self.sense = self.travel = 0.0

    @property
    def name(self) -> str:
        return self.gauge.name

    @property
    def far(self) -> float:
        """m, from where the gauge stood at the last rest to where it is led."""
        return abs(self.until - self.start)

    @property
    def span(self) -> float:
        """m, the same, but no more than the specimen is large: what rows and the servo are measured by."""
        return min(self.far, self.size)

    def begin(self, rested: Arrays) -> None:
        """Where it stood at a rest (configuration/model_state.py), and where it is led from there."""
        self.start = self.gauge.reading(copied_dofs(self.model, rested), rested.get("rigid.frame"))
        self.sense = float(np.sign(self.until - self.start))

    def read(self) -> float:
        """m, how far it is from its start now, towards where it is led."""
        return self.sense * (self.gauge.read(self.model) - self.start)

    def speed(self, drifts: float, drift: Arrays) -> float:
        """m/s, towards there, as the specimen drifts so many times in a second by changes of its dofs."""
        return drifts * self.sense * self.gauge.along(drift)
