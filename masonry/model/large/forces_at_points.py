"""Loads at points of rigid blocks that may turn: which of them change their moments as blocks move."""

import numpy as np

from masonry.kernels.point_loads import PointLoads
from masonry.model.layout import Layout
from masonry.model.loads import Conditions, PointForce


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
