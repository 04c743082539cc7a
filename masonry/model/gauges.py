"""Gauges: the motion of a place, as a weighted sum of the dofs of the model; read when a row is taken."""

from dataclasses import dataclass

import numpy as np

from masonry.model.kinds import KIND
from masonry.model.layout import KINDS, Layout
from masonry.model.model import Model


@dataclass(frozen=True)
class Place:
    """Where a displacement is taken: the weighted mean over points of blocks and over tet nodes.

    block, point, fraction  (n,), (n, 3) m, (n,): points of rigid and affine blocks
    node, node_fraction     (m,), (m,): tet nodes; both fractions together add up to 1
    """

    block: np.ndarray
    point: np.ndarray
    fraction: np.ndarray
    node: np.ndarray
    node_fraction: np.ndarray


@dataclass(frozen=True)
class Gauge:
    """Name, and per kind of motion the rows, columns and weights of the dofs that add up to the reading.

    row, arm  (n,), (n, 3) m: of points of rigid blocks, the block, and the place from its centroid times its weight
    axis      along which displacements are taken
    quantity  "displacement", "velocity" or "acceleration". Of an acceleration a row reads the displacement, from which
              it follows once there are rows on both sides (masonry/rows/accelerations.py)
    sign, is_relative  of the direction along the axis; whether the motion of another place is taken off
    height    m, by how much it lies above that place; 0 without one
    """

    name: str
    terms: dict[str, tuple[np.ndarray, np.ndarray, np.ndarray]]
    row: np.ndarray
    arm: np.ndarray
    axis: int
    quantity: str = "displacement"
    sign: float = 1.0
    is_relative: bool = False
    height: float = 0.0

    def look(self, model: Model, velocities: dict[str, np.ndarray]) -> float:
        """Reading of a row: m/s of a velocity, else m. velocities: (rows, dofs) by kind of motion, now."""
        if self.quantity == "velocity":
            return self.speed(velocities, getattr(model.bodies.rigid, "frame", None))
        return self.read(model)

    def read(self, model: Model) -> float:
        """m, now."""
        kinds = {kind: model.bodies[KINDS.index(kind)] for kind in self.terms}
        moved = {kind: KIND[kind].displacements(body, model.u) for kind, body in kinds.items()}
        return self.reading(moved, getattr(model.bodies.rigid, "frame", None))

    def reading(self, moved: dict[str, np.ndarray], frame: np.ndarray | None = None) -> float:
        """m, for dofs (rows, n) by kind of motion; frame (B, 3, 3): rotations of rigid blocks, where they are large."""
        if frame is None or not len(self.row):
            return self.along(moved)
        turned = float(np.einsum("nj,nj->", frame[self.row, self.axis] - np.eye(3)[self.axis], self.arm))
        return turned + self.along(moved | {"rigid": np.where(np.arange(6) < 3, moved["rigid"], 0.0)})

    def speed(self, velocities: dict[str, np.ndarray], frame: np.ndarray | None = None) -> float:
        """m/s, for velocities (rows, dofs) by kind of motion; frame (B, 3, 3): rotations of rigid blocks where they
        are large, and turn about x, y, z."""
        if frame is None or not len(self.row):
            return self.along(velocities)
        spin, arm = velocities["rigid"][self.row, 3:], np.einsum("nij,nj->ni", frame[self.row], self.arm)
        turning = float(np.cross(spin, arm)[:, self.axis].sum())
        return turning + self.along(velocities | {"rigid": np.where(np.arange(6) < 3, velocities["rigid"], 0.0)})

    def along(self, moved: dict[str, np.ndarray]) -> float:
        """m, for small changes of the dofs (rows, n) by kind of motion."""
        reading = 0.0
        for kind, (row, column, weight) in self.terms.items():
            reading += float(weight @ moved[kind][row, column])
        return reading


def gauge(
    name: str,
    layout: Layout,
    at: Place,
    relative_to: Place | None,
    axis: int,
    sign: float,
    quantity: str = "displacement",
) -> Gauge:
    """The displacement, velocity or acceleration of `at` along an axis times `sign`, less that of `relative_to`."""
    parts = [(at, sign), *([(relative_to, -sign)] if relative_to is not None else [])]
    terms = {}
    for kind in KINDS:
        of_kind = _node_terms if KIND[kind].nodal else _block_terms
        each = [of_kind(layout, kind, place, axis, factor) for place, factor in parts]
        row, column, weight = (np.concatenate([entry[k] for entry in each]) for k in range(3))
        if len(row):
            terms[kind] = row.astype(np.int64), column.astype(np.int64), weight
    arms = [_arms(layout, "rigid", place, factor) for place, factor in parts]
    block, arm, fraction = (np.concatenate([entry[k] for entry in arms]) for k in range(3))
    row, arm = layout.local[block], fraction[:, None] * arm
    height = 0.0 if relative_to is None else _level(layout, at) - _level(layout, relative_to)
    return Gauge(name, terms, row, arm, axis, quantity, sign, relative_to is not None, height)


def _level(layout: Layout, place: Place) -> float:
    """m, the height of a place before loading."""
    level = float(place.fraction @ place.point[:, 2])
    return level if layout.mesh is None else level + float(place.node_fraction @ layout.mesh.nodes[place.node, 2])


def _arms(layout: Layout, kind: str, place: Place, factor: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Blocks (n,) of one kind, places (n, 3) m from their centroids, and weights (n,) of the points of one place."""
    own = np.flatnonzero(layout.kind[place.block] == KINDS.index(kind))
    block = place.block[own]
    return block, place.point[own] - layout.centroid[block], factor * place.fraction[own]


def _node_terms(layout: Layout, kind: str, place: Place, axis: int, factor: float) -> tuple[np.ndarray, ...]:
    """Rows, columns and weights of the nodes of one place."""
    return place.node, np.full(len(place.node), axis), factor * place.node_fraction


def _block_terms(layout: Layout, kind: str, place: Place, axis: int, factor: float) -> tuple[np.ndarray, ...]:
    """Rows, columns and weights of one place in the dofs of blocks of a kind: u = t + turn x arm, or u = t + H arm."""
    block, arm, fraction = _arms(layout, kind, place, factor)
    first, by_dof = KIND[kind].gauge(layout.axes[block], arm, axis)
    row = np.repeat(layout.local[block], 4)
    column = np.tile([axis, first, first + 1, first + 2], len(block))
    weight = fraction[:, None] * np.column_stack([np.ones(len(block)), by_dof])
    return row, column, weight.ravel()
