"""How far all has moved since the last rest, together and block by block; and what moves on where the sum rests."""

from typing import NamedTuple

import numpy as np

from masonry.loading.moves.moved import blocks_reach, places, reach, relative_travel
from masonry.model.gauges import Gauge
from masonry.model.model import Model
from masonry.monitors.stability import smallest_block
from masonry.monitors.unrest import EachBlock
from masonry.rows.rest_criterion import RestCriterion
from masonry.runtime.state_file import State, attributes, load_attributes

REMEMBERED = ("most", "travelled")

SLIDES, TWICE = 0.1, 2.0
"""Of its size, and times what is usual: motion of a block that moves alone that is a fall in any case."""


class Limits(NamedTuple):
    """Limits of a rest and of a fall (GrowingSettings of collapse/growing_settings.py): the level of a rest, and what a
    gauge may still move over the farthest that it did; motion of a fall over the size of a block, and over the most
    that brought it to rest."""

    rest: RestCriterion
    reading: float
    away: float
    usual: float


class Travels:
    """Of a load that grows: what has moved since it was borne last.

    size       m, of the smallest block: turns count times it     travelled  m, the most that anything has moved
    most       m, the most that anything moved on its way to a rest
    usual      (B, 2) m, the most that each block moved, and turned times its own size, on its way to a rest
    alone      (B,) blocks that were seen to move since the last rest while all together were at rest
    calm, range  (G,), (2, G) m, readings of gauges at the first look of a rest; the least and the greatest so far
    """

    def __init__(self, model: Model, limits: Limits, gauges: tuple[Gauge, ...] = ()) -> None:
        self.model, self.limits, self.gauges = model, limits, gauges
        self.size, self.each = smallest_block(model), EachBlock(model)
        self.places = [np.zeros(place.shape) for place in places(model, self.size)]
        self.most = self.travelled = 0.0
        self.usual, self.alone = np.zeros((model.blocks.count, 2)), np.zeros(model.blocks.count, dtype=bool)
        self.calm, self.range = np.zeros(len(gauges)), np.zeros((2, len(gauges)))

    @property
    def away(self) -> float:
        """m: motion since the last rest that is a fall in itself."""
        return max(self.limits.away * self.size, self.limits.usual * self.most)

    def look(self) -> None:
        """Take in how far anything has moved since the last rest."""
        self.travelled = max(map(reach, self.moved()))

    def rest(self, fell: bool = False) -> None:
        """All rests here: trials begin from here. fell: how far it came is not usual"""
        if not fell:
            self.most = max(self.most, self.travelled)
            self.usual = np.maximum(self.usual, self.by_block())
        self.places = places(self.model, self.size)
        self.begin()

    def begin(self) -> None:
        """A new trial."""
        self.alone[:] = False

    def moved(self) -> list[np.ndarray]:
        """How far all has moved since the last rest, as `places`."""
        return [now - then for now, then in zip(places(self.model, self.size), self.places, strict=True)]

    def sways(self) -> float:
        """m, the most that anything has moved since it was made."""
        return max(map(reach, places(self.model, self.size)))

    def by_block(self) -> np.ndarray:
        """(B, 2) m, how far each block has moved since the last rest, and turned times its own size."""
        moved = blocks_reach(self.model, self.moved())
        return np.column_stack([moved[:, 0], moved[:, 1] * self.each.size / self.size])

    def moves_alone(self, before: list[np.ndarray], calm: int) -> bool:
        """Whether a block, or a gauge, still moves where the sum over all is at rest for the `calm`-th time on end.
        before: energy.velocities a step earlier"""
        alone = self.each.look(before).alone(self.limits.rest)
        self.alone |= alone
        readings = np.array([gauge.read(self.model) for gauge in self.gauges])
        self.range = np.array([np.minimum(self.range[0], readings), np.maximum(self.range[1], readings)])
        if calm == 0:
            self.calm = readings
        least = self.limits.reading * np.maximum(np.ptp(self.range, axis=0), self.limits.reading * self.most)
        return bool(alone.any() or (np.abs(readings - self.calm) > least).any())

    def alone_or_none(self, rests: bool = True) -> np.ndarray | None:
        """(B,) blocks that have moved alone, where the sum over all rests; None where none has."""
        return self.alone if rests and self.alone.any() else None

    def fallen(self, times: float = 1.0) -> bool:
        """Whether a block that moved alone has gone farther than is a fall in itself: so many times as far as from
        where on it is one, but no farther than contacts may slide."""
        size, usual = self.each.size[:, None], self.usual
        away = times * np.maximum(self.limits.away * size, self.limits.usual * usual)
        away = np.minimum(away, np.maximum(SLIDES * size, TWICE * usual))
        return bool((self.by_block() > away)[self.alone].any())

    def first(self) -> int:
        """The block that has moved most since the last rest."""
        return int(self.relative().argmax())

    def relative(self) -> np.ndarray:
        """(B,) how far each block has moved since the last rest, over the one that moved most; zeros where none did."""
        return relative_travel(self.model, self.moved())

    def state(self) -> State:
        """All that it goes by."""
        arrays = {"places": [place.copy() for place in self.places], "usual": self.usual, "alone": self.alone.copy()}
        return {
            **attributes(self, REMEMBERED),
            **arrays,
            "calm": self.calm,
            "range": self.range,
            "bore": self.each.most,
        }

    def restore(self, state: State) -> None:
        """Go on from there."""
        load_attributes(self, REMEMBERED, state)
        self.places, self.usual, self.alone = state["places"], state["usual"], state["alone"]
        self.calm, self.range, self.each.most = state["calm"], state["range"], state["bore"]
