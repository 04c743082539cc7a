"""Supports and floor that move with the ground: which of their dofs, and by which of its components."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from masonry.elements.element import Element, ElementCalls
from masonry.kernels.shaking import ROOM, MovedSupports, shaking
from masonry.model.element_plan import Dofs, ElementPlan, Site
from masonry.model.layout import KINDS


@dataclass(frozen=True)
class MovedDofs(ElementPlan):
    """Per kind, (K, 3) row and number of the dofs that the ground moves, and which of so many components does."""

    dofs: dict[str, np.ndarray]
    components: int

    def moved(self) -> list[Dofs]:
        each = [self.dofs.get(kind) for kind in KINDS]
        return [tuple(None if own is None else own[own[:, 2] == k] for own in each) for k in range(self.components)]

    def element(self, site: Site) -> "MovedSupportElement":
        dofs = tuple(self.dofs.get(kind) for kind in KINDS)
        velocity = np.zeros((ROOM, self.components))
        return MovedSupportElement(self, MovedSupports(dofs, velocity, np.zeros(1, dtype=np.int64)))


class MovedSupportElement(Element):
    """Supports of a model that move."""

    name = "moved_supports"

    def __init__(self, plan: MovedDofs, supports: MovedSupports) -> None:
        super().__init__(plan)
        self.supports = supports

    def calls(self, model: Any, shared: np.ndarray) -> ElementCalls:
        return ElementCalls(ends=shaking(self.supports, model.bodies))

    def begin(self, steps: int, base: np.ndarray | None, step: int) -> None:
        """They rest in a chunk that has no velocities for them."""
        self.supports.begin(self.supports.at_rest(steps) if base is None else base, step)
