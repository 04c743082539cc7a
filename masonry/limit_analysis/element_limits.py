"""Elements in a limit analysis: forces of any size up to what they bear; bars in both of their ends."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np
from scipy import sparse

from geometry.blocks import Blocks
from masonry.elements.bars.bar_element import BarPlaces
from masonry.errors import SceneError
from masonry.model.element_plan import ElementPlan
from masonry.pictures.camera import Camera
from masonry.pictures.hidden_surfaces import Piece
from masonry.pictures.overlays.bar_lines import Moves, draw_bars
from masonry.scene import Scene
from masonry.statics.crushing import Crushing
from masonry.statics.problem import RigidBodies, RigidContacts

YIELDS = 1.0 - 1e-6
"""Share of what a bar bears from which it counts as yielding."""


class LimitElement(Protocol):
    """What an element of a limit analysis answers.

    force     (K,) N of each of its members
    on_slack  what is assumed, in words, where it bears in its slack
    """

    name: str
    force: np.ndarray
    on_slack: str

    def behind(self, contacts: RigidContacts, bodies: RigidBodies, stiffness: float) -> RigidContacts:
        """The contacts, and behind them its members; stiffness: Pa/m of the joints. Raises SceneError."""

    def bears_in_slack(self, threshold: float) -> bool:
        """Whether members bear more than the least force (N) that have slack to take up first."""

    def as_data(self) -> dict[str, Any]:
        """For JSON, in SI."""

    @property
    def words(self) -> str:
        """What it bears."""

    def draw(
        self, axes: Any, scene: Scene, blocks: Blocks, camera: Camera, moves: Moves | None, seen: list[Piece]
    ) -> None:
        """Over the blocks of a picture."""


@dataclass
class LimitBars:
    """Bars of a limit analysis, and the force (K,) N of each, above 0 where it pulls."""

    places: BarPlaces
    force: np.ndarray
    name = "bars"
    on_slack = "; bars bear at once, whatever their slack"
    """What is assumed where `bears_in_slack`."""

    @property
    def yielding(self) -> np.ndarray:
        """(K,) which bars bear all that they can."""
        return yielding(self.places, self.force)

    def behind(self, contacts: RigidContacts, bodies: RigidBodies, stiffness: float) -> RigidContacts:
        return with_bars(contacts, self.places, bodies, stiffness)

    def bears_in_slack(self, threshold: float) -> bool:
        return bool((np.abs(self.force)[self.places.slack > 0.0] > threshold).any())

    def as_data(self) -> dict[str, Any]:
        return {"force": self.force.tolist(), "unit": "N", "yielding": np.flatnonzero(self.yielding).tolist()}

    @property
    def words(self) -> str:
        """The greatest force of any, and how many yield."""
        bars, strongest = self.places, int(np.argmax(np.abs(self.force)))
        where = ", ".join(f"{x:.4g}" for x in bars.point[strongest, 0])
        count = int(self.yielding.sum())
        yields = "none yields" if not count else f"{count} of {bars.count} yield" if bars.count > 1 else "it yields"
        return (
            f"the greatest force is {self.force[strongest] / 1e3:.4g} kN, of bar {strongest} from ({where}) m; {yields}"
        )

    def draw(
        self, axes: Any, scene: Scene, blocks: Blocks, camera: Camera, moves: Moves | None, seen: list[Piece]
    ) -> None:
        draw_bars(axes, scene.bar, blocks, camera, moves, self.yielding, seen)


def limit_elements(plans: Sequence[ElementPlan]) -> list[LimitElement]:
    """Those of a scene that bear in a limit analysis, without force yet."""
    return [LimitBars(places, np.zeros(places.count)) for places in plans if isinstance(places, BarPlaces)]


def with_elements(
    contacts: RigidContacts, elements: Sequence[LimitElement], bodies: RigidBodies, stiffness: float
) -> RigidContacts:
    """The contacts, and behind them all elements; stiffness: Pa/m of the joints."""
    for element in elements:
        contacts = element.behind(contacts, bodies, stiffness)
    return contacts


def with_bars(contacts: RigidContacts, bars: BarPlaces, bodies: RigidBodies, stiffness: float) -> RigidContacts:
    """The contacts, and behind them bars: a force along a line does the same wherever on it it acts.

    An end that stays in space is taken as one of a block that is held. Raises SceneError where there is none.
    stiffness: Pa/m of the joints; a bar has the area of a joint that is as stiff as it is.
    """
    count, block = bars.count, bars.block.copy()
    if (block < 0).any():
        still = np.flatnonzero(~bodies.free.any(axis=1))
        if not len(still):
            raise SceneError("bar: an end that stays in space needs a block that a support holds, in a limit analysis")
        block[block < 0] = still[0]
    ones, none = np.ones(count), np.zeros(count)
    patch = int(contacts.patch.max(initial=-1)) + 1 + np.arange(count)
    area = bars.stiffness / stiffness
    behind = RigidContacts(
        *(block[:, 0], block[:, 1], bars.point[:, 0], -bars.axis, patch, area, none, none, -bars.least),
        solid=none > 0.0,
    )
    names = ("block_a", "block_b", "point", "normal", "patch", "area", "friction", "cohesion", "tension", "solid")
    both = {name: np.concatenate([getattr(contacts, name), getattr(behind, name)]) for name in names}
    crush = None if contacts.crush is None else _wider(contacts.crush, count)
    link = np.concatenate([contacts.is_link, ones > 0.0])
    limit = np.concatenate([np.full(contacts.count, np.inf), bars.most])
    pretension = np.concatenate([np.zeros(contacts.count), bars.pretension])
    return replace(contacts, **both, crush=crush, link=link, limit=limit, pretension=pretension)


def yielding(bars: BarPlaces, force: np.ndarray) -> np.ndarray:
    """(K,) which bars bear all that they can; forces (K,) N."""
    return np.asarray((force >= YIELDS * bars.most) | ((force <= YIELDS * bars.least) & (bars.least < 0.0)))


def _wider(crush: Crushing, count: int) -> Crushing:
    """With columns for bars, which do not press the polygons."""
    total, first, second = (
        sparse.hstack([rows, sparse.csr_array((rows.shape[0], count))], format="csr")
        for rows in (crush.total, crush.first, crush.second)
    )
    return Crushing(total, first, second, crush.strength)
