"""Contribution of bars to the row sums that bound the time step: stable_step.py and large/row_sums.py have the proofs.

In small displacement the stiffness of a bar is k g g', with g what its length changes by for a unit of each dof: its
row i adds up to k |g_i| times the sum of all |g_j|. Where it turns it has the stiffness N/l across itself besides, less
than k as it is stretched by less than its length: then k counts in all directions, and dofs by their lengths.
"""

import numpy as np

from masonry.model.element_plan import Ends
from masonry.model.kinds import KIND
from masonry.model.large.row_sums import levers
from masonry.model.layout import KINDS
from masonry.model.stable_step import BETWEEN


def bar_row_sums(sums: dict[str, np.ndarray], ends: Ends, axis: np.ndarray, stiffness: np.ndarray, turns: bool) -> None:
    """Add the share of bars; axis (K, 3) along them, stiffness (K,) N/m; turns: whether they turn with their ends, in
    large displacement."""
    along = axis[ends.force]
    each = [(form, which, _changes(ends, along, form, which, turns)) for form, which in by_form(ends)]
    of_bar = np.zeros(ends.total)
    for form, which, change in each:
        np.add.at(of_bar, ends.force[which], _whole(change, form, turns))
    of_bar *= stiffness
    for form, which, change in each:
        rows = change * of_bar[ends.force[which], None]
        if form == BETWEEN:
            assert ends.side.corner is not None
            np.add.at(sums["tets"], ends.side.corner[which], rows.reshape(-1, 3, 3))
        else:
            np.add.at(sums[KINDS[form]], ends.side.row[which], rows)


def by_form(ends: Ends) -> list[tuple[int, np.ndarray]]:
    """Forms of sides, and the ends of each."""
    return [(int(form), np.flatnonzero(ends.side.form == form)) for form in np.unique(ends.side.form)]


def _changes(ends: Ends, axis: np.ndarray, form: int, which: np.ndarray, turns: bool) -> np.ndarray:
    """(n, dofs) m of the length of the bar for a unit of each dof of an end, or no less, turns and strains over the
    length of the dof; axis (E, 3)."""
    if not turns:
        return np.asarray(np.abs(np.einsum("ni,nij->nj", axis[which], ends.side.columns(form, which))))
    if form == BETWEEN:
        assert ends.side.fraction is not None
        return np.repeat(ends.side.fraction[which], 3, axis=1)
    lever = levers(ends.side)[which]
    beyond = {"rigid": lever, "affine": np.tile(lever, 3), "tets": lever[:, :0]}[KINDS[form]]
    return np.concatenate([np.ones((len(which), 3)), beyond], axis=1)


def _whole(change: np.ndarray, form: int, turns: bool) -> np.ndarray:
    """(n,) m, of all dofs of an end together: where dofs count by their lengths, three of them are one."""
    if not turns:
        return np.asarray(change.sum(axis=1))
    if form == BETWEEN or KIND[KINDS[form]].nodal:
        return np.asarray(change[:, ::3].sum(axis=1))
    return np.asarray(1.0 + change[:, 3:6].sum(axis=1))
