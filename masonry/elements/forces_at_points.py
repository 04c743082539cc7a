"""Loads at points of rigid blocks that may turn: which of them change their moments as blocks move."""

from typing import Any

import numpy as np

from masonry.elements.element import Element, ElementCalls
from masonry.kernels.point_loads import PointLoads, shifting
from masonry.model.body_arrays import in_rows
from masonry.model.element_plan import ElementPlan, Site
from masonry.model.layout import Layout
from masonry.model.loads import Conditions, PointForce


class ForcesAtPoints(ElementPlan):
    """The forces at points of rigid blocks among the loads of the conditions."""

    def element(self, site: Site) -> "PointLoadElement | None":
        """Where moments of loads change as blocks of it move; the rigid bodies get room for them."""
        model = site.model
        points, varying = point_loads_of(model.layout, site.conditions) if site.turns else (None, np.zeros(0))
        if points is None:
            return None
        rigid = model.bodies.rigid._replace(shifted=in_rows(np.zeros(model.bodies.rigid.q.shape)))
        model.bodies = model.bodies._replace(rigid=rigid)
        return PointLoadElement(self, points, varying)


class PointLoadElement(Element):
    """Forces at points whose moments change as blocks move; of_each (H, K, 3) N those of each load that varies, at a
    factor of 1."""

    name, shifts_moments = "point_loads", True

    def __init__(self, plan: ForcesAtPoints, points: PointLoads, of_each: np.ndarray) -> None:
        super().__init__(plan)
        self.points, self.of_each = points, of_each

    def calls(self, model: Any, shared: np.ndarray) -> ElementCalls:
        return ElementCalls(forces=(shifting(self.points, model.bodies.rigid, shared),))

    def varying(self) -> list[tuple[Any, np.ndarray]]:
        return [(self.points, self.of_each)]

    def written(self) -> dict[str, np.ndarray]:
        """Forces, which may vary."""
        return {"load": self.points.load, "change": self.points.change}


def matters(point: PointForce, layout: Layout, conditions: Conditions) -> bool:
    """Whether the moment of a force changes: where its line stays in space, and else if its block can turn."""
    prescribed = conditions.prescribed["rigid"][layout.local[point.block]]
    return not prescribed.all() if point.fixed else not prescribed[3:].all()


def point_loads_of(layout: Layout, conditions: Conditions) -> tuple[PointLoads | None, np.ndarray]:
    """The forces that matter, those of dead loads acting, and (H, K, 3) N those of each load that varies, at a factor
    of 1. None where there are none."""
    points = [
        (point, [varying is conditions.each_load[name] for varying in conditions.varying])
        for name, points in conditions.at_points.items()
        for point in points
        if matters(point, layout, conditions)
    ]
    if not points:
        return None, np.zeros((len(conditions.varying), 0, 3))
    force = np.array([point.force for point, _ in points])
    varies = np.array([own for _, own in points], dtype=bool).reshape(len(points), -1).T
    loads = PointLoads(
        row=np.array([layout.local[point.block] for point, _ in points], dtype=np.int64),
        arm=np.array([point.arm for point, _ in points]),
        fixed=np.array([point.fixed for point, _ in points], dtype=np.int64),
        load=np.where(np.any(varies, axis=0, keepdims=True).T, 0.0, force),
        change=np.zeros(force.shape),
    )
    return loads, varies[:, :, None] * force
