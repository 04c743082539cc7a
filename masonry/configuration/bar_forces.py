"""What bars do to the blocks that hold them."""

from typing import NamedTuple

import numpy as np

from masonry.model.model import Model


class BarForces(NamedTuple):
    """The block (E,) of each end that a block holds, the force (E, 3) N on it, and the place (E, 3) m of the end."""

    block: np.ndarray
    force: np.ndarray
    place: np.ndarray


def forces_of_bars(model: Model, turns: bool) -> BarForces | None:
    """Of all bars now; turns: whether their ends are where they have moved to. None where there are no bars."""
    bars, places = model.bars, model.bar_places
    if bars is None or places is None:
        return None
    bar, end = np.nonzero(places.block >= 0)
    force = np.where(end == 0, 1.0, -1.0)[:, None] * bars.force[bars.first + bar]
    place = places.point[bar, end]
    return BarForces(places.block[bar, end], force, place + model.u[bars.sides[bar, end]] if turns else place)


def forces_of_fixed_ends(model: Model, turns: bool) -> np.ndarray:
    """(6,) N and N m about the origin of the scene, what bars whose other ends stay in space do to the blocks."""
    acting, places = forces_of_bars(model, turns), model.bar_places
    assert acting is not None and places is not None
    alone = places.ends_in_space[np.nonzero(places.block >= 0)[0]]
    force, moment = acting.force[alone], np.cross(acting.place[alone], acting.force[alone])
    return np.concatenate([force.sum(axis=0), moment.sum(axis=0)])


def with_bars(model: Model, pressed: np.ndarray) -> np.ndarray:
    """(B,) N, sums of all components of the forces at the contacts of each block, and of the bars that end in it."""
    if (acting := forces_of_bars(model, turns=False)) is None:
        return pressed
    return pressed + np.bincount(acting.block, np.abs(acting.force).sum(axis=1), model.blocks.count)


def stiffened(model: Model, stiffness: np.ndarray) -> np.ndarray:
    """(B,) N/m, of all contacts of each block, and of the bars that end in it."""
    if (places := model.bar_places) is None:
        return stiffness
    bar, end = np.nonzero(places.block >= 0)
    return stiffness + np.bincount(places.block[bar, end], places.stiffness[bar], model.blocks.count)
