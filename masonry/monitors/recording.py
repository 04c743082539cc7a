"""Quantities recorded of a run, how often, and the actions from outside."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from masonry.ground.uniform_ground import UniformGround
from masonry.model.gauges import Gauge
from masonry.monitors.reactions import Surroundings


@dataclass(frozen=True)
class Recording:
    """How forces become stresses (section, m2; sign of the drive), how often to look, which gauges to read then,
    how many frames to keep, about, the slip that stops a run, the sets of blocks by name, to blame them, what acts
    from outside, the axis (0, 1, 2) of the drive, None without one, and the motion that all supports share, None
    without; where any ground moves the acceleration (m/s2) of the weight, beside which forces of inertia act."""

    section: float
    sign: float = 1.0
    rows: int = 1000
    rotation_limit: float = 0.02
    gauges: tuple[Gauge, ...] = ()
    frames: int = 24
    slip_limit: float = 0.25
    sets: Mapping[str, np.ndarray] = field(default_factory=dict)
    surroundings: Surroundings = field(default_factory=Surroundings)
    axis: int | None = None
    ground: UniformGround | None = None
    weight_when_shaken: tuple[float, float, float] | None = None

    @property
    def is_shaken(self) -> bool:
        """Whether any ground moves."""
        return self.weight_when_shaken is not None

    def along(self, place: float) -> float:
        """A place of the drive (m) along its direction, for one along an axis."""
        return self.sign * place + 0.0
