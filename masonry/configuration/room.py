"""Room for what blocks meet: where a step lacks it, it gets more and goes on."""

import numpy as np

from masonry.detection.broad import cells_for
from masonry.errors import Stopped
from masonry.model.large.meeting import Large
from masonry.model.model import Model
from masonry.patches.arrays import NEED_PAIRS, PAIR, REASON, ROOM, TOO_DEEP, Near, PatchPoints, no_points
from masonry.patches.pairs import PatchPairs, copy_pairs, no_pairs


def make_room(model: Model, large: Large) -> None:
    """Twice the room for pairs, or for the points of those that touch."""
    near, refusal = large.near, large.near.search.refusal
    if refusal[REASON] == TOO_DEEP:
        both = model.two_blocks(*near.pieces.block[near.pairs.body[refusal[PAIR]]])
        raise Stopped(
            f"{both} overlap at once by more than a hundredth of a block: they overlapped from the start, "
            'turned about contact points inside of their joint (contact_points = "gauss"), or are too fast for the '
            "time step"
        )
    if refusal[REASON] == NEED_PAIRS:
        near = _with_pairs(near, 2 * int(max(refusal[ROOM], len(near.pairs.slot))))
        near.search.built[:] = -np.inf  # the search that found no room begins again
    else:
        near = _with_points(near, 2 * len(near.points.number))
    large.near = near


def make_room_for(large: Large, saved: dict[str, np.ndarray]) -> None:
    """As much room for pairs and points as a run had that was kept (model_state.state): more than there is, or less
    where a run goes back. What they hold is to be restored."""
    if not {"pairs.slot", "points.number"} <= saved.keys():
        return
    near, pairs, points = large.near, len(saved["pairs.slot"]), len(saved["points.number"])
    if pairs != len(near.pairs.slot):
        near = _holding(near, no_pairs(pairs))
    if points != len(near.points.number):
        near = near._replace(points=no_points_like(near, points))
    large.near = near


def _with_pairs(near: Near, room: int) -> Near:
    pairs = no_pairs(room)
    copy_pairs(near.pairs, pairs)
    return _holding(near, pairs)


def _holding(near: Near, pairs: PatchPairs) -> Near:
    """With other arrays of pairs, and as much room for a search."""
    room = len(pairs.slot)
    return near._replace(
        pairs=pairs,
        before=no_pairs(room),
        cells=cells_for(near.pieces, room),
        search=near.search._replace(
            candidates=np.zeros((room, 2), dtype=np.int64),
            losers=np.zeros(room, dtype=np.int64),
            next_pair=np.zeros((room, 2), dtype=np.int64),
        ),
    )


def no_points_like(near: Near, room: int) -> PatchPoints:
    """Room for the points of so many pairs that hold as much as those that there are."""
    keep, crushed = near.rules.keep, near.points.crushed
    branches, rows = 0 if keep is None else len(keep), 0 if crushed is None else crushed.shape[2]
    return no_points(room, near.points.feature.shape[1], branches, rows)


def _with_points(near: Near, room: int) -> Near:
    """All slots that there were are taken, or are filled later."""
    had = len(near.points.feature)
    points = no_points_like(near, room)
    for name, old in near.points._asdict().items():
        new = getattr(points, name)
        if name in ("quads", "damper"):
            new[:, :had] = old
        elif name != "free" and old is not None:
            new[:had] = old
    points.free[: room - had] = np.arange(had, room)[::-1]
    points.free[-1] = room - had
    return near._replace(points=points)
