"""Bars between points of blocks, before and after a model is made: their ends are sides of contacts of their own."""

from dataclasses import dataclass, fields
from typing import NamedTuple

import numpy as np

from masonry.kernels.bars import Bars
from masonry.model.layout import Layout
from masonry.model.stable_step import Side


@dataclass(frozen=True)
class BarPlaces:
    """K bars, each between two points. Forces above 0 pull.

    block          (K, 2) that hold the ends; -1 of an end that stays where it is in space
    point          (K, 2, 3) m
    node, fraction (K, 2, 3) of ends on blocks of tets: nodes of a triangle at the surface, and shape functions; else -1
    stiffness      (K,) N/m
    least, most    (K,) N, at which they yield; a least of 0: they go slack there
    slack          (K,) m          pretension  (K,) N
    columns        names of columns of the results, and the bar of each
    """

    block: np.ndarray
    point: np.ndarray
    node: np.ndarray
    fraction: np.ndarray
    stiffness: np.ndarray
    least: np.ndarray
    most: np.ndarray
    slack: np.ndarray
    pretension: np.ndarray
    columns: dict[str, int]

    @property
    def count(self) -> int:
        return len(self.stiffness)

    @property
    def ends_in_space(self) -> np.ndarray:
        """(K,) whether an end stays where it is in space."""
        return np.asarray((self.block < 0).any(axis=1))

    @property
    def taut(self) -> "BarPlaces":
        """Those that bear as soon as their ends part; the columns are left out."""
        which = self.slack == 0.0
        arrays = {entry.name: getattr(self, entry.name)[which] for entry in fields(self) if entry.name != "columns"}
        return BarPlaces(**arrays, columns={})

    @property
    def apart(self) -> np.ndarray:
        """(K, 3) m, from the first end to the second one."""
        return np.asarray(self.point[:, 1] - self.point[:, 0])

    @property
    def axis(self) -> np.ndarray:
        """(K, 3) unit vectors from the first end to the second one."""
        return np.asarray(self.apart / np.linalg.norm(self.apart, axis=1, keepdims=True))


class BarEnds(NamedTuple):
    """The E ends of bars that blocks hold, as sides of contacts.

    side  of all of them      bar, end  (E,) of which bar, and whether it is its first (0) or second end (1)
    axis  (E, 3) unit vector along it        stiffness  (K,) N/m of the bars
    """

    side: Side
    bar: np.ndarray
    end: np.ndarray
    axis: np.ndarray
    stiffness: np.ndarray

    def code(self, first: int) -> np.ndarray:
        """(E,) twice the number of the contact, and 1 more on its second side; bars are contacts from `first` on."""
        return np.asarray(2 * (first + self.bar) + self.end)


def ends_of(layout: Layout, places: BarPlaces | None, length: np.ndarray) -> BarEnds | None:
    """The ends that blocks hold, None without bars; length (B, 3) m of all blocks, as of stable_step.lengths."""
    if places is None:
        return None
    bar, end = np.nonzero(places.block >= 0)
    block, point = places.block[bar, end], places.point[bar, end]
    axes = layout.axes[block]
    side = Side(
        kind=layout.kind[block],
        row=np.where(layout.meshed[block], places.node[bar, end, 0], layout.local[block]),
        arm=np.einsum("cji,cj->ci", axes, point - layout.centroid[block]),
        axes=axes,
        length=length[block],
        corner=places.node[bar, end],
        fraction=places.fraction[bar, end],
    )
    return BarEnds(side, bar, end, places.axis[bar], places.stiffness)


def bars_of(
    places: BarPlaces | None, ends: BarEnds | None, row: np.ndarray, still: int, force: np.ndarray
) -> Bars | None:
    """What steps take of them; None where there are none.

    row (E,) of u of each end     still  row of u that never moves      force  (C + K, 3) N
    """
    if places is None or ends is None:
        return None
    sides = np.full((places.count, 2), still, dtype=np.int64)
    sides[ends.bar, ends.end] = row
    zero = [np.zeros(places.count) for _ in range(8)]
    return Bars(
        sides,
        places.apart.copy(),
        np.linalg.norm(places.apart, axis=1),
        *(places.stiffness, places.least, places.most, places.slack, places.pretension / places.stiffness),
        len(force) - places.count,
        force,
        *zero,
    )
