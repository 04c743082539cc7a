"""Patches by which blocks meet in large displacement: how deep, how hard, and what they store and took. In small
displacement there are none, and the same questions are answered with nothing."""

from math import inf

import numpy as np

from masonry.elements.element import Element
from masonry.jit.compiled_parts import Call, RepeatedCall
from masonry.model.element_plan import ElementPlan
from masonry.model.large.meeting import Large
from masonry.model.model import Model
from masonry.patches.arrays import BORN, DASHPOT, FRICTION, NORMAL_GAINED, SHEAR_LOST
from masonry.patches.measures import compressions, deepest, stored_energy


class NoPatches(Element):
    """Blocks that meet by their contacts alone."""

    name = "patches"

    def __init__(self) -> None:
        super().__init__(ElementPlan())

    @property
    def skin(self) -> float:
        """m, by which blocks may come nearer, or slide on, before contacts are found anew; infinite where none are."""
        return inf

    def let_fade(self, model: Model, acts: bool) -> None:
        """Let act what damps beside their springs, or not."""

    def deepest(self, width: np.ndarray) -> tuple[float, tuple[int, int]]:
        """The deepest overlap of two blocks, over the widths (B,) m of the thinner one, and which they are."""
        return 0.0, (0, 0)

    def compressions(self) -> np.ndarray:
        """(R,) Pa, the largest compression of a point now, by which contact table serves it."""
        return np.zeros(0)


class Patches(NoPatches):
    """Those of a model of large displacement; `bearing`, the call that looks for their points."""

    def __init__(self, large: Large) -> None:
        super().__init__()
        self.parts = large
        self._energy, self._overlap, self._pressure = (
            RepeatedCall(part) for part in (stored_energy, deepest, compressions)
        )
        self.energy, self.overlap, self.pair = np.zeros(1), np.zeros(1), np.zeros(1, dtype=np.int64)
        self.compression = np.zeros(len(large.near.rules.normal_stiffness))

    def calls_of_rows(self) -> tuple[Call, Call, Call]:
        """Those that rows make, of the arrays that there are now: energy, overlap, compression."""
        return self._call_energy(), self._call_overlap(np.zeros(0)), self._call_pressure()

    def _call_energy(self) -> Call:
        return self._energy.of(self.parts.near, self.energy)

    def _call_overlap(self, width: np.ndarray) -> Call:
        return self._overlap.of(self.parts.near, width, self.overlap, self.pair)

    def _call_pressure(self) -> Call:
        return self._pressure.of(self.parts.near, self.compression)

    @property
    def skin(self) -> float:
        return float(self.parts.near.search.skin[0])

    def let_fade(self, model: Model, acts: bool) -> None:
        dashpots, rules = model.dashpots, self.parts.near.rules
        if dashpots is not None and rules.keep is not None and rules.gain is not None:
            rules.keep[:], rules.gain[:] = (acts * numbers for numbers in (dashpots.keep, dashpots.gain))

    def deepest(self, width: np.ndarray) -> tuple[float, tuple[int, int]]:
        near = self.parts.near
        self._call_overlap(width)()
        a, b = near.pieces.block[near.pairs.body[self.pair[0]]]
        return float(self.overlap[0]), (int(a), int(b))

    def compressions(self) -> np.ndarray:
        self.compression[:] = 0.0
        self._call_pressure()()
        return self.compression.copy()

    def elastic(self) -> float:
        """J that they store."""
        self._call_energy()()
        return float(self.energy[0])

    def taken(self) -> dict[str, float]:
        account = self.parts.near.account
        return {
            "friction": float(account[FRICTION]),
            "dashpot": float(account[DASHPOT]),
            "redetection": float(account[SHEAR_LOST]),
            "area": -float(account[NORMAL_GAINED] + account[BORN]),
        }
