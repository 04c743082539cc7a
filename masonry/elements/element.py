"""What an element of a model answers, and what is asked of all of them. A new kind of elements overrides what it has to
say; steps, the ledger, rows and the summary ask all elements in turn, and know none of them by name."""

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np

from masonry.jit.compiled_parts import Call
from masonry.model.element_plan import ElementPlan

Elements = Sequence["Element"]


class ElementCalls(NamedTuple):
    """What an element adds to a step: calls with which it begins, forces before bodies take them, calls at its end."""

    begins: Sequence[Call] = ()
    forces: Sequence[Call] = ()
    ends: Sequence[Call] = ()


class Acting(NamedTuple):
    """The block (E,) of each place where an element acts, the force (E, 3) N on it, and the place (E, 3) m."""

    block: np.ndarray
    force: np.ndarray
    place: np.ndarray


class Element:
    """An element that is there and does nothing.

    name            of its arrays in a checkpoint, and of its numbers in the summary: no other element of a model has it
    plan            what the scene says of it: what it ties, and what it does to the blocks from outside
    on              where it acts from outside, in words
    is_support      whether that counts with the support of a drive
    shifts_moments  whether it changes the moments of loads as blocks move
    slack           m, the most by which it has to be stretched before it bears
    stiffest        N/m, the largest stiffness against ends that part
    """

    name: str
    on = ""
    is_support, shifts_moments = False, False
    slack, stiffest = 0.0, 0.0

    def __init__(self, plan: ElementPlan) -> None:
        self.plan = plan

    def calls(self, model: Any, shared: np.ndarray) -> ElementCalls:
        """Its part of a step of a model; `shared` as of kinematics/shared.py."""
        return ElementCalls()

    def begin(self, steps: int, base: np.ndarray | None, step: int) -> None:
        """A chunk of so many steps, of which a step is next; base (n + 1, C) m/s as of Chunk."""

    def acting(self) -> Acting | None:
        """What it does to the blocks now."""
        return None

    def of_environment(self, parts: Iterable[Any]) -> np.ndarray:
        """(6,) N and N m about the origin of the scene, what it does from outside; parts as of parts_of."""
        return np.zeros(6)

    def stiffness(self) -> tuple[np.ndarray, np.ndarray] | None:
        """Blocks (E,), and the stiffness (E,) N/m that it has there."""
        return None

    def stored(self) -> dict[str, float]:
        """J that it stores, by column of the ledger."""
        return {}

    def taken(self) -> dict[str, float]:
        """J that it took for good, by column of the ledger."""
        return {}

    def work_from_outside(self) -> float | None:
        """J that it got from outside, besides what works on the blocks; None where it gets none."""
        return None

    def readings(self) -> dict[str, float]:
        """N, by column of the results."""
        return {}

    def bears(self) -> np.ndarray:
        """(K,) whether each of its members bears anything."""
        return np.zeros(0, dtype=bool)

    def clearance(self) -> np.ndarray:
        """(K,) m, by which its members have to be stretched before they bear; below 0 where they do."""
        return np.zeros(0)

    def varying(self) -> list[tuple[Any, np.ndarray]]:
        """What has a `load` and a `change` that loads with a history set, and (H, ...) N those of each at a factor of
        1."""
        return []

    def record(self) -> dict[str, Any] | None:
        """Its part of the summary, under its name there: numbers of the record in `masonry/results/records/`."""
        return None

    def written(self) -> dict[str, np.ndarray]:
        """By name, what steps write."""
        return {}

    def constants(self) -> tuple[Any, ...]:
        """What no step changes, for the fingerprint of a model; what is `written` may be among it."""
        return ()


def acting_on_blocks(elements: Elements) -> Acting | None:
    """What all elements do to the blocks now; None where none acts on them."""
    each = [acting for element in elements if (acting := element.acting()) is not None]
    return Acting(*(np.concatenate(parts) for parts in zip(*each, strict=True))) if each else None


def with_elements(pressed: np.ndarray, elements: Elements) -> np.ndarray:
    """(B,) N, sums of all components of the forces at the contacts of each block, and of elements that act on it."""
    if (acting := acting_on_blocks(elements)) is None:
        return pressed
    return pressed + np.bincount(acting.block, np.abs(acting.force).sum(axis=1), len(pressed))


def stiffened(stiffness: np.ndarray, elements: Elements) -> np.ndarray:
    """(B,) N/m, of all contacts of each block, and of the elements that act on it."""
    for element in elements:
        if (own := element.stiffness()) is not None:
            stiffness = stiffness + np.bincount(*own, len(stiffness))
    return stiffness


def energies_of(elements: Elements) -> dict[str, float]:
    """J that elements store and took, by column of the ledger."""
    total: dict[str, float] = {}
    for element in elements:
        for energies in (element.stored(), element.taken()):
            for column, energy in energies.items():
                total[column] = total[column] + energy if column in total else energy
    return total


def those_that_take(elements: Elements) -> Elements:
    """Those for which there is a column of what they take for good: rows ask no others."""
    return tuple(element for element in elements if element.taken())


def stored_by(elements: Elements) -> float:
    """J that elements store."""
    return sum((energy for element in elements for energy in element.stored().values()), start=0.0)


def readings_of(elements: Elements) -> dict[str, float]:
    """N, by column of the results."""
    return {column: force for element in elements for column, force in element.readings().items()}
