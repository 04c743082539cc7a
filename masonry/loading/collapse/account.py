"""Part of the work of the load that the motion of a led specimen takes."""

import numpy as np

from masonry.configuration import energy
from masonry.configuration.parts.parts import parts_of
from masonry.loading.moves.moved import dofs
from masonry.loading.varying_loads import works_of
from masonry.model.model import Model
from masonry.runtime.state_file import Remembering


class Account(Remembering):
    """How far rows are from equilibrium.

    row, due  number of the last row, from the start of the branch; whether one is due now
    works     (H,) J, of the loads that vary so far, at a factor of 1     work  J, of the factor's change since the row
    lost      J, what damping and inertia had taken at the row
    off       fraction of the collapse factor that they took since the row before; worst  the most so far
    near      m, the gauge's reading up to which all rows were as near as the accuracy asks
    """

    REMEMBERED = ("row", "due", "works", "work", "lost", "off", "worst", "near")

    def __init__(self, model: Model) -> None:
        self.model, self.row, self.due, self.works = model, 0, False, np.zeros(0)
        self.work = self.lost = self.off = self.worst = self.near = 0.0

    def look(self, before: list[np.ndarray], slope: np.ndarray, row: int, scale: float) -> bool:
        """Whether a row is due, of this number. before: velocities a step earlier; slope: (H,) of the load factors;
        scale: the collapse factor"""
        works = works_of(self.model, dofs(self.model))
        lost = energy.kinetic(self.model, before)
        lost -= sum(float(part.body.work[:, 1].sum()) for part in parts_of(self.model))
        if not len(self.works):
            self.works, self.lost = works, lost
        self.work += float(slope @ (works - self.works)[-len(slope) :])
        self.works = works
        self.due = row > self.row
        if self.due:
            self.off = (lost - self.lost) / max(abs(self.work) * scale, 1e-300)
            self.row, self.lost, self.work = row, lost, 0.0
            self.worst = max(self.worst, abs(self.off))
        return self.due
