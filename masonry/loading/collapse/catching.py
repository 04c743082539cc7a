"""Obstacles that may catch a falling specimen: bars that hang slack, contacts that stand open, blocks that come nearer.

A fall along a mechanism closes gaps: what has come so far since the last rest comes as much farther for as much more
travel. By that it is told whether anything can bear before the travel ends after which a fall counts as such.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from geometry.blocks import Blocks
from geometry.polyhedra.box_pairs import overlapping_boxes
from geometry.polyhedra.measures import bounds
from geometry.polyhedra.overlaps import widest_gaps
from masonry.configuration import model_state
from masonry.configuration.configuration import configuration_of
from masonry.loading.moves.moved import Arrays
from masonry.model.model import Model
from masonry.monitors.collisions.collision import joined_pairs
from masonry.monitors.frames import Frames
from masonry.monitors.stability import smallest_block
from masonry.runtime.state_file import Remembering

WORTH_A_LOOK = 10.0
"""Times the travel up to which it is told that a slack bar would bear."""

APART = 1e-3
"""Of the smallest block: what is less apart touches."""


class CaughtFall(NamedTuple):
    """A fall that came to rest: from the factor that was borne before, under the least that was not, by a travel (m),
    of the block that moved most."""

    borne: float
    falls: float
    travel_m: float
    block: int


class Clearances(NamedTuple):
    """What is apart, in m, below 0 where it bears: elements, and contacts of small displacement; all blocks, as they
    stand."""

    elements: np.ndarray
    contacts: np.ndarray
    blocks: Blocks


class Catching(Remembering):
    """The falls that came to rest, and what may catch another one.

    travel  m, that ends a fall     caught  so far, as CaughtFall     bore  what bore at the last rest, by numbers
    later   m, the travel of the last fall after which a slack bar would have borne; 0 where none would
    """

    REMEMBERED = ("caught", "bore", "later")

    def __init__(self, model: Model, travel: float) -> None:
        self.size = smallest_block(model)
        self.model, self.travel, self.configuration = model, travel, configuration_of(model)
        self.caught: list[list[float]] = []
        self.bore, self.later = np.zeros(0, dtype=np.int64), 0.0

    @property
    def falls(self) -> tuple[CaughtFall, ...]:
        """All that came to rest."""
        return tuple(CaughtFall(borne, falls, travel, int(block)) for borne, falls, travel, block in self.caught)

    def rest(self) -> None:
        """The specimen rests here."""
        self.bore = self.bearing()

    def bearing(self) -> np.ndarray:
        """(K,) sorted numbers of all that bears: of two blocks, and of taut bars, below 0."""
        pairs, force = self.configuration.forces_of_pairs()
        pairs = np.sort(pairs[np.any(force != 0.0, axis=1)], axis=1)
        bears = [element.bears() for element in self.model.elements]
        taut = -1 - np.flatnonzero(np.concatenate([np.zeros(0, dtype=bool), *bears]))
        return np.union1d(taut, pairs @ [self.model.blocks.count, 1])

    def bears_anew(self) -> bool:
        """Whether something bears that did not at the last rest."""
        return not bool(np.isin(self.bearing(), self.bore).all())

    def later_within(self, limit: float | None) -> float | None:
        """m, the travel after which a slack bar bears that was not waited for; None without one, and where that is more
        than a limit."""
        return self.later if self.later > 0.0 and (limit is None or self.later <= limit) else None

    def may_come(self, rested: Arrays, travelled: float) -> bool:
        """Whether anything closes before the travel ends, or has closed. rested: the model at the last rest; travelled:
        m, since then"""
        times = (self.travel - travelled) / max(travelled, 1e-300)
        now = self.clearances()
        copies = model_state.state(self.model)
        model_state.restore(self.model, rested)
        then = self.clearances()
        model_state.restore(self.model, copies)
        elements, least = closings(then.elements, now.elements), APART * self.size
        first = (1.0 + float(elements[now.elements > 0.0].min(initial=np.inf))) * travelled
        self.later = first if first <= WORTH_A_LOOK * self.travel else 0.0
        contacts = closings(then.contacts, now.contacts)[then.contacts > least]
        blocks = self.blocks_meet(then.blocks, now.blocks, times, least)
        return bool((elements <= times).any() or (contacts <= times).any() or blocks)

    def clearances(self) -> Clearances:
        """Present clearances."""
        model, contacts = self.model, np.zeros(0)
        apart = np.concatenate([np.zeros(0), *(element.clearance() for element in model.elements)])
        if not self.configuration.any_size:
            seen = np.zeros((4, len(model.group)))
            self.configuration.look_at_contacts(seen)
            contacts = -self.configuration.crushing.closed(seen[0])
        corners = model.blocks.points + Frames(model).corners()
        return Clearances(apart, contacts, replace(model.blocks, points=corners))

    def blocks_meet(self, then: Blocks, now: Blocks, times: float, least: float) -> bool:
        """Whether two blocks meet in so many times as much motion that were apart at the last rest by more than the
        least (m), and have no joint in small displacement."""
        low, high = bounds(now)
        ahead = bounds(replace(now, points=now.points + max(times, 0.0) * (now.points - then.points)))
        pairs = overlapping_boxes(np.minimum(low, ahead[0]), np.maximum(high, ahead[1]))
        known = self.bore if self.configuration.any_size else joined_pairs(self.model)
        pairs = pairs[~np.isin(pairs @ [now.count, 1], known)]
        before, after = (widest_gaps(blocks, pairs)[0] for blocks in (then, now))
        return bool((closings(before, after)[before > least] <= times).any())


def closings(then: np.ndarray, now: np.ndarray) -> np.ndarray:
    """Times the motion so far after which each of some gaps closes, by how wide (m) it was and is: 0 where it has, and
    infinite where it does not become narrower."""
    times = np.full(len(now), np.inf)
    closes, narrows = (now <= 0.0) & (then > 0.0), (now > 0.0) & (then > now)
    times[closes] = 0.0
    times[narrows] = now[narrows] / (then - now)[narrows]
    return times
