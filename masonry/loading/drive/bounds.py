"""Bounds on an increment of a drive once something has broken, and the speed that follows from them."""

from typing import NamedTuple

import numpy as np

from masonry.loading.drive.adaptive_settings import AdaptiveSettings
from masonry.loading.drive.increments import DriveRow, Increments
from masonry.model.model import Model
from masonry.monitors.events import PARTED
from masonry.runtime.state_file import State


class DragLook(NamedTuple):
    """Of one increment: the energy by which the drive ran ahead, over its work; m that it made; the force that damping
    took, over the largest; N, of the drive, signed, as it is borne."""

    lag: float
    made: float
    drag: float
    force: float


class Bounds:
    """The bounds of AdaptiveSettings on what an increment may bring.

    accuracy  that was asked for     unit  that is aimed at: the bounds are multiples of it
    looks     at each increment since the first damage
    """

    def __init__(self, model: Model, accuracy: float, settings: AdaptiveSettings) -> None:
        self.model, self.accuracy, self.settings = model, accuracy, settings
        self.unit = min(accuracy, settings.fine * (accuracy / settings.fine) ** settings.blunt)
        if len(model.layout.members["affine"]) or len(model.layout.members["tets"]):
            self.unit *= settings.deformable
        self.looks: list[DragLook] = []

    def factor(self, row: DriveRow, last: Increments, expected: float, damped: float, takes_few_steps: bool) -> float:
        """Of the speed, by what the last increment brought. expected: J, of the motion that was; damped: J, see Dry

        The drive runs ahead of the specimen by about v / w, where w is the frequency of the expected motion, so the
        force of the drive does work too early: F v / w = 2 sqrt(K W) of kinetic energy K (expected) and stored W, as
        far as the drive has brought it.
        """
        settings, stored = self.settings, row.stored
        change = abs(stored - last.stored) / last.most_stored
        fracture = (row.broken - last.broken) / last.most_stored
        lag = 2.0 * np.sqrt(expected * min(abs(stored), last.work)) / max(last.work, 1e-300)
        least = max(PARTED * last.most_stored, last.work if self.model.dry else 0.0)
        sway = np.sqrt(abs(row.kinetic) / max(abs(stored), least))
        curve = settings.curve * min(self.accuracy / settings.fine, 1.0)
        unit = max(self.unit, curve) if takes_few_steps else self.unit
        brought = max(change / settings.stored, fracture / settings.fracture, 1e-12) / unit
        ends = abs(row.force - row.support) / last.most_force
        taken, most_work = abs(damped - last.damped), last.most_force * last.made
        drag = taken / most_work
        freed = max(last.stored - stored - (row.broken - last.broken), 0.0)  # by a sudden crack: its damping is no drag
        self.looks.append(
            DragLook(float(lag), last.made, float(max(taken - freed, 0.0) / most_work), row.force - row.excess)
        )
        ratios = lag / settings.lag, sway / settings.sway, ends / settings.ends, drag / settings.drag
        excess = max(np.sqrt(brought), *(ratio / self.unit for ratio in ratios))
        return float(min(max(1.0 / excess, settings.slower), settings.faster))

    def state(self) -> State:
        """State that is reported at the end."""
        return {"looks": np.array(self.looks).reshape(-1, 4)}

    def restore(self, state: State) -> None:
        """Go on from there."""
        self.looks = [DragLook(*look) for look in state["looks"].tolist()]
