"""Bars between points of blocks, before and after a model is made: their ends are sides of contacts of their own."""

from collections.abc import Iterable
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from masonry.elements.bars.bar_row_sums import bar_row_sums
from masonry.elements.element import Acting, Element, ElementCalls
from masonry.kernels.bars import Bars, pulling
from masonry.model.element_plan import ElementPlan, Ends, Site, Springs
from masonry.model.layout import Layout
from masonry.model.stable_step import Side
from masonry.rows.columns import ELASTIC_BARS, PLASTIC_BARS

WRITTEN = Bars._fields[Bars._fields.index("force") :]
"""Of Bars, the fields that steps write."""


@dataclass(frozen=True)
class BarPlaces(ElementPlan):
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
    def ends_on_blocks(self) -> tuple[np.ndarray, np.ndarray]:
        """Bar (E,) and number (E,), 0 or 1, of each end that a block holds."""
        bar, end = np.nonzero(self.block >= 0)
        return bar, end

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

    def ends(self, layout: Layout, length: np.ndarray) -> Ends:
        """The ends that blocks hold; length (B, 3) m of all blocks, as of stable_step.lengths."""
        bar, end = self.ends_on_blocks
        block, point = self.block[bar, end], self.point[bar, end]
        axes = layout.axes[block]
        side = Side(
            kind=layout.kind[block],
            row=np.where(layout.meshed[block], self.node[bar, end, 0], layout.local[block]),
            arm=np.einsum("cji,cj->ci", axes, point - layout.centroid[block]),
            axes=axes,
            length=length[block],
            corner=self.node[bar, end],
            fraction=self.fraction[bar, end],
        )
        return Ends(side, bar, end, self.count)

    def add_row_sums(self, sums: dict[str, np.ndarray], ends: Ends, turns: bool) -> None:
        bar_row_sums(sums, ends, self.axis, self.stiffness, turns)

    @property
    def environment(self) -> str | None:  # type: ignore[override]
        return "bars" if self.ends_in_space.any() else None

    def links(self) -> np.ndarray:
        return self.block

    def restraints(self, member: np.ndarray, centre: np.ndarray, size: float) -> np.ndarray:
        """(n, 6) what the motions do to the lengths of bars that end in space."""
        bar, end = np.nonzero((self.block >= 0) & self.ends_in_space[:, None])
        own = np.flatnonzero(member[self.block[bar, end]])
        axis, point = self.axis[bar[own]], self.point[bar[own], end[own]]
        return np.concatenate([axis, np.cross(point - centre, axis) / size], axis=1)

    def springs(self, layout: Layout) -> Springs:
        """Of those that do not hang slack."""
        taut = self.taut
        ends = taut.ends(layout, np.ones((len(layout.kind), 3)))
        root = np.where(ends.end == 0, -1.0, 1.0) * np.sqrt(taut.stiffness[ends.force])
        return Springs(ends, taut.axis[ends.force], root)

    def words_on_modes(self) -> str:
        slack = int((self.slack > 0.0).sum())
        without = f", {slack} that hang slack left out" if slack else ""
        return f"bars are taken as taut, whatever they bear{without}: a pretension keeps them so"

    def element(self, site: Site) -> "BarElement":
        return BarElement(self, site)


class BarElement(Element):
    """The bars of a model."""

    name, on, is_support = "bars", "fixed ends", True

    def __init__(self, places: BarPlaces, site: Site) -> None:
        super().__init__(places)
        self.places, self.turns, self.u = places, site.turns, site.model.u
        self.slack, self.stiffest = float(places.slack.max(initial=0.0)), float(places.stiffness.max())
        sides = np.full((places.count, 2), site.still, dtype=np.int64)
        assert site.ends is not None
        sides[site.ends.force, site.ends.end] = site.row
        zero = [np.zeros(places.count) for _ in range(8)]
        self.bars = Bars(
            sides,
            places.apart.copy(),
            np.linalg.norm(places.apart, axis=1),
            *(places.stiffness, places.least, places.most, places.slack, places.pretension / places.stiffness),
            site.first,
            site.model.force,
            *zero,
        )

    def calls(self, model: Any, shared: np.ndarray) -> ElementCalls:
        return ElementCalls(forces=(pulling(self.bars, self.turns, self.u, shared),))

    def acting(self) -> Acting:
        places, bars = self.places, self.bars
        bar, end = places.ends_on_blocks
        force = np.where(end == 0, 1.0, -1.0)[:, None] * bars.force[bars.first + bar]
        place = places.point[bar, end]
        return Acting(places.block[bar, end], force, place + self.u[bars.sides[bar, end]] if self.turns else place)

    def of_environment(self, parts: Iterable[Any]) -> np.ndarray:
        """(6,) N and N m, of bars whose other ends stay in space."""
        acting, places = self.acting(), self.places
        alone = places.ends_in_space[places.ends_on_blocks[0]]
        force, moment = acting.force[alone], np.cross(acting.place[alone], acting.force[alone])
        return np.concatenate([force.sum(axis=0), moment.sum(axis=0)])

    def stiffness(self) -> tuple[np.ndarray, np.ndarray]:
        bar, end = self.places.ends_on_blocks
        return self.places.block[bar, end], self.places.stiffness[bar]

    def stored(self) -> dict[str, float]:
        return {ELASTIC_BARS: float(np.sum(0.5 * self.bars.tension**2 / self.bars.stiffness))}

    def taken(self) -> dict[str, float]:
        """What yielding took."""
        return {PLASTIC_BARS: float(self.bars.plastic_work.sum())}

    def work_from_outside(self) -> float:
        """What tightens bars acts from outside, and goes into them."""
        return float(self.bars.tightening.sum())

    def readings(self) -> dict[str, float]:
        """N of those that have a name."""
        return {name: float(self.bars.tension[bar]) for name, bar in self.places.columns.items()}

    def bears(self) -> np.ndarray:
        return np.asarray(self.bars.tension != 0.0)

    def clearance(self) -> np.ndarray:
        bars = self.bars
        return np.where(bars.minimum < 0.0, -1.0, bars.slack + bars.plastic - bars.elongation - bars.tightened)

    def record(self) -> dict[str, Any]:
        """At any step of a run, and at its end."""
        bars = self.bars
        most, least = int(np.argmax(bars.peak)), int(np.argmin(bars.trough))
        return {
            "count": len(bars.length),
            "largest_force_n": float(bars.peak[most]),
            "largest_of": most,
            "least_force_n": float(bars.trough[least]),
            "least_of": least,
            "yielded": int((bars.plastic_work > 0.0).sum()),
            "longest_plastic_m": float(np.abs(bars.plastic).max()),
            "plastic_m": bars.plastic.tolist(),
        }

    def written(self) -> dict[str, np.ndarray]:
        return {field: getattr(self.bars, field) for field in WRITTEN}

    def constants(self) -> tuple[Any, ...]:
        return self.bars
