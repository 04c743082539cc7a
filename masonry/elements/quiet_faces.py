"""Faces at which waves leave: dashpots on the dofs of tet nodes and affine blocks, and the stress of a wave that comes.

A face answers a velocity v with the traction -rho c_p v_n - rho c_s v_t (Lysmer and Kuhlemeyer, 1969, J. Eng. Mech.
Div. 95(4), 859-877); a wave of velocity v that comes through it brings twice that, with the other sign.

The time step is that without: with the dashpots C, symmetric and not negative, at the middle of the step, the energy of
the leapfrog, v'(M - dt^2 K/4) v/2 + u' K u/2 with u between two steps, changes by -dt v' C v <= 0 with the mean of both
velocities. It is positive where dt^2 K < 4 M, so nothing grows within the bound of the step without dashpots.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from geometry.blocks import Blocks
from geometry.joints.boundary import surface_nodes
from geometry.polyhedra.measures import face_areas_normals_centroids
from masonry.elements.element import Element, ElementCalls
from masonry.kernels.quiet import QuietRows, absorbing, remembering
from masonry.model.element_plan import ElementPlan, Site
from masonry.model.kinds import KIND
from masonry.model.layout import DOFS, KINDS, Layout


@dataclass
class Drag(ElementPlan):
    """By kind, and by row of dofs, dashpots (n, n)."""

    environment = "quiet boundaries"

    matrices: dict[str, dict[int, np.ndarray]] = field(default_factory=lambda: {kind: {} for kind in KINDS})

    def add(self, kind: str, row: int, matrix: np.ndarray) -> None:
        rows = self.matrices[kind]
        rows[row] = rows.get(row, 0.0) + matrix

    def element(self, site: Site) -> "QuietElement":
        model = site.model
        return QuietElement(self, quiet_rows(self, model.layout, model.masses, site.conditions.prescribed, model.dt))


class QuietElement(Element):
    """Dashpots on faces of a model; rows of them by kind, None without."""

    name, on = "quiet", "their faces"

    def __init__(self, plan: Drag, rows: tuple[QuietRows | None, ...]) -> None:
        super().__init__(plan)
        self.rows = rows

    def calls(self, model: Any, shared: np.ndarray) -> ElementCalls:
        bodies = model.bodies
        return ElementCalls(remembering(self.rows, bodies), (), absorbing(self.rows, bodies, model.dt))

    def of_environment(self, parts: Iterable[Any]) -> np.ndarray:
        """(6,) of the dashpots, on all dofs that are free."""
        quiet, total = dict(zip(KINDS, self.rows, strict=True)), np.zeros(6)
        for part in parts:
            if (rows := quiet.get(part.name)) is not None:
                total += part.resultant(rows.row, np.where(part.free[rows.row], rows.force, 0.0))
        return total

    def written(self) -> dict[str, np.ndarray]:
        return {kind: rows.force for kind, rows in zip(KINDS, self.rows, strict=True) if rows is not None}


def add_face(
    drag: Drag, push: dict[str, np.ndarray], blocks: Blocks, layout: Layout, face: int, impedance: tuple[float, float]
) -> None:
    """Add the dashpots of a face of a block that deforms, and to push, by kind (rows, dofs, 3), the force of a wave of
    velocity 1 along x, y and z.

    impedance  Pa s/m, of waves along the normal and across it
    """
    block = int(blocks.face_block()[face])
    normal = face_areas_normals_centroids(blocks)[1][face]
    dashpot = impedance[1] * np.eye(3) + (impedance[0] - impedance[1]) * np.outer(normal, normal)
    if layout.meshed[block]:
        assert layout.mesh is not None
        for node, area in zip(*surface_nodes(layout.mesh, blocks, np.array([face])), strict=True):
            drag.add("tets", int(node), area * dashpot)
            push["tets"][node] += 2.0 * area * dashpot
        return
    row, points, areas = int(layout.local[block]), *_midpoints(blocks.face(face))
    for point, area in zip(points, areas, strict=True):
        moves = _moves(layout, block, point)
        drag.add("affine", row, area * moves.T @ dashpot @ moves)
        push["affine"][row] += 2.0 * area * moves.T @ dashpot


def quiet_rows(
    drag: Drag, layout: Layout, masses: dict[str, np.ndarray], prescribed: dict[str, np.ndarray], dt: float
) -> tuple[QuietRows | None, ...]:
    """What a step takes of the dashpots, by kind; None of kinds without any. masses (rows, dofs) kg of motion."""
    parts: list[QuietRows | None] = []
    for kind in KINDS:
        if not (rows := drag.matrices[kind]):
            parts.append(None)
            continue
        row = np.array(sorted(rows), dtype=np.int64)
        matrices = np.array([rows[r] for r in row.tolist()])
        answer = np.zeros_like(matrices)
        for k, r in enumerate(row.tolist()):
            free = np.flatnonzero(~prescribed[kind][r])
            own = matrices[k][np.ix_(free, free)]
            half = 0.5 * matrices[k][free]
            answer[k][free] = np.linalg.solve(np.diag(masses[kind][r, free] / dt) + 0.5 * own, half)
        block = np.searchsorted(layout.members[kind], layout.owner[kind][row])
        room = [np.zeros((len(row), DOFS[kind])) for _ in range(3)]
        parts.append(QuietRows(row, block, matrices, answer, *room))
    return tuple(parts)


def _midpoints(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points (n, 3) of a flat convex face and their areas (n,): the middles of the edges of its triangles, which add up
    squares of places exactly."""
    first, second = corners[1:-1], corners[2:]
    own = np.broadcast_to(corners[0], first.shape)
    area = 0.5 * np.linalg.norm(np.cross(first - own, second - own), axis=1)
    points = [0.5 * (a + b) for a, b in ((own, first), (first, second), (second, own))]
    return np.concatenate(points), np.tile(area / 3.0, 3)


def _moves(layout: Layout, block: int, point: np.ndarray) -> np.ndarray:
    """(3, n) displacement of a point of a block for a unit of each of its dofs."""
    axes, kind = layout.axes[block][None], KIND[KINDS[layout.kind[block]]]
    arm, one = (point - layout.centroid[block])[None] @ layout.axes[block], np.ones((1, 3))
    return np.concatenate([np.eye(3), kind.columns(arm, axes, one)[0] * kind.lengths(one)], axis=1)
