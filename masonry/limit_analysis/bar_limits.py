"""Bars in a limit analysis: forces of any size up to what they bear, in both of their ends."""

from dataclasses import replace

import numpy as np
from scipy import sparse

from masonry.elements.bars.bar_element import BarPlaces
from masonry.errors import SceneError
from masonry.statics.crushing import Crushing
from masonry.statics.problem import RigidBodies, RigidContacts

YIELDS = 1.0 - 1e-6
"""Share of what a bar bears from which it counts as yielding."""


def with_bars(contacts: RigidContacts, bars: BarPlaces | None, bodies: RigidBodies, stiffness: float) -> RigidContacts:
    """The contacts, and behind them bars: a force along a line does the same wherever on it it acts.

    An end that stays in space is taken as one of a block that is held. Raises SceneError where there is none.
    stiffness: Pa/m of the joints; a bar has the area of a joint that is as stiff as it is.
    """
    if bars is None:
        return contacts
    count, block = bars.count, bars.block.copy()
    if (block < 0).any():
        still = np.flatnonzero(~bodies.free.any(axis=1))
        if not len(still):
            raise SceneError("bar: an end that stays in space needs a block that a support holds, in a limit analysis")
        block[block < 0] = still[0]
    one, none = np.ones(count), np.zeros(count)
    patch = int(contacts.patch.max(initial=-1)) + 1 + np.arange(count)
    area = bars.stiffness / stiffness
    behind = RigidContacts(
        *(block[:, 0], block[:, 1], bars.point[:, 0], -bars.axis, patch, area, none, none, -bars.least),
        solid=none > 0.0,
    )
    names = ("block_a", "block_b", "point", "normal", "patch", "area", "friction", "cohesion", "tension", "solid")
    both = {name: np.concatenate([getattr(contacts, name), getattr(behind, name)]) for name in names}
    crush = None if contacts.crush is None else _wider(contacts.crush, count)
    bar = np.concatenate([np.zeros(contacts.count, dtype=bool), one > 0.0])
    most = np.concatenate([np.full(contacts.count, np.inf), bars.most])
    pretension = np.concatenate([np.zeros(contacts.count), bars.pretension])
    return replace(contacts, **both, crush=crush, bar=bar, most=most, pretension=pretension)


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
