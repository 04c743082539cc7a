"""Elements before a model is made of them: what their ends do to its arrays, and what is asked of them besides."""

from collections.abc import Sequence
from itertools import accumulate
from typing import Any, NamedTuple

import numpy as np

from masonry.model.layout import Layout
from masonry.model.stable_step import Side

Dofs = tuple[np.ndarray | None, ...]
"""By kind of bodies (K, 2) row and number of some dofs, and what else is known of each; None without."""


class Ends(NamedTuple):
    """The E ends of the forces of an element that blocks hold, as sides of contacts of their own.

    side   of all of them
    force  (E,) of which of its `total` forces, and end (E,): whether it acts as it is (0), or against it (1)
    """

    side: Side
    force: np.ndarray
    end: np.ndarray
    total: int

    def code(self, first: int) -> np.ndarray:
        """(E,) twice the number of the contact, and 1 more on its second side; contacts from `first` on."""
        return np.asarray(2 * (first + self.force) + self.end)


class Springs(NamedTuple):
    """Linear springs, each along a line: the ends that blocks hold, the line (E, 3) of each as a unit vector, and the
    root (E,) of its stiffness in N/m, below 0 at ends that shorten it as they move along the line."""

    ends: Ends
    axis: np.ndarray
    root: np.ndarray


class Site(NamedTuple):
    """Where an element stands in a model, which has all but its elements.

    turns  whether blocks turn as they like, in large displacement
    ends   of its forces that blocks hold, None without any; row (E,) of u of each, and `still`, one that never moves
    first  row of the forces of the model at which its own begin
    """

    model: Any
    conditions: Any
    turns: bool
    ends: Ends | None
    row: np.ndarray
    still: int
    first: int


class ElementPlan:
    """What a scene says of elements of one kind, before a model is made of it.

    environment  of what it does to the blocks from outside, among supports; None where it does nothing from there
    """

    environment: str | None = None

    def ends(self, layout: Layout, length: np.ndarray) -> Ends | None:
        """Its ends that blocks hold; length (B, 3) m of all blocks, as of stable_step.lengths."""
        return None

    def add_row_sums(self, sums: dict[str, np.ndarray], ends: Ends, turns: bool) -> None:
        """Add to the row sums that bound the time step; turns: whether blocks turn as they like."""

    def moved(self) -> list[Dofs]:
        """The dofs that it moves from outside, those apart that move otherwise than others."""
        return []

    def links(self) -> np.ndarray:
        """(K, 2) blocks that it ties to each other; -1 for a place that stays in space."""
        return np.zeros((0, 2), dtype=np.int64)

    def restraints(self, member: np.ndarray, centre: np.ndarray, size: float) -> np.ndarray:
        """(n, 6) what six rigid motions of some blocks (B,), turns of 1/size (1/m) about a centre, do against places in
        space that it ties them to."""
        return np.zeros((0, 6))

    def springs(self, layout: Layout) -> Springs | None:
        """As modes take it; None where it adds no stiffness."""
        return None

    def words_on_modes(self) -> str | None:
        """How modes take it, in words; None where there is nothing to say."""
        return None

    def element(self, site: Site) -> Any:
        """The element of a model; None where it does nothing there."""
        raise NotImplementedError


def first_forces(contacts: int, ends: Sequence[Ends | None]) -> list[int]:
    """The row at which the forces of each element begin, behind those of so many contacts; and the one behind all."""
    return list(accumulate((0 if own is None else own.total for own in ends), initial=contacts))


def elements_of(
    model: Any, conditions: Any, ends: list[Ends | None], rows: tuple[np.ndarray, ...], turns: bool
) -> tuple[Any, ...]:
    """The elements of a model; rows of u (E,) of the ends of each. Raises ValueError where two share a name, under
    which checkpoints, the summary and supports keep what they say."""
    of_each = zip(conditions.elements, ends, rows, first_forces(len(model.group), ends), strict=False)
    elements = [
        plan.element(Site(model, conditions, turns, own, row, len(model.u) - 1, first))
        for plan, own, row, first in of_each
    ]
    chosen = tuple(element for element in elements if element is not None)
    outside = [each.plan.environment for each in chosen if each.plan.environment is not None]
    for names in ([each.name for each in chosen], outside):
        for name in names:
            if names.count(name) > 1:
                raise ValueError(f"two elements of a model are named '{name}': each needs a name of its own")
    return chosen
