"""Drive, tractions and gravity on the dofs of the bodies; what is absent stays None."""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from geometry.blocks import Blocks
from geometry.joints.boundary import surface_nodes
from geometry.polyhedra import measures
from masonry.model.element_plan import ElementPlan
from masonry.model.kinds import KIND
from masonry.model.layout import DOFS, KINDS, Layout, node_masses

Load = dict[str, np.ndarray | None]
"""Forces on the dofs of each kind (rows, dofs); None where there are none."""


@dataclass(frozen=True)
class Push:
    """Uniform traction (3,) Pa on faces."""

    faces: np.ndarray
    stress: np.ndarray


class PointForce(NamedTuple):
    """Force (3,) N at a factor of 1 on a rigid block, at an arm (3,) m from its centroid at the start; `fixed`: its
    line of action stays where it is in space, else its point is one of the block's."""

    block: int
    arm: np.ndarray
    force: np.ndarray
    fixed: bool


@dataclass
class Conditions:
    """Per kind: masks of what supports and drive prescribe, dead loads (None where there are none); flat indices of the
    driven dofs and of those that support against the drive; masks of what supports alone hold; loads of tractions
    that vary, one entry each, by kind, at a share of 1. And by name: masks of what each support and the drive hold, and
    each dead load at a share of 1, those that vary included.

    motion  per kind, velocities (rows, dofs) that bodies start with, in the dofs that v has; None without any
    spin    (B, 3) rad/s along x, y, z, with which each block starts; None without any
    at_points  by load, its forces at points of rigid blocks, whose moments change as blocks move in large displacement
    elements  between points of blocks, or beside them
    """

    prescribed: dict[str, np.ndarray]
    load: Load
    driven: dict[str, np.ndarray | None] = field(default_factory=dict)
    support: dict[str, np.ndarray | None] = field(default_factory=dict)
    supported: dict[str, np.ndarray] = field(default_factory=dict)
    varying: list[Load] = field(default_factory=list)
    held_by: dict[str, dict[str, np.ndarray]] = field(default_factory=dict)
    each_load: dict[str, Load] = field(default_factory=dict)
    elements: list[ElementPlan] = field(default_factory=list)
    motion: dict[str, np.ndarray] | None = None
    spin: np.ndarray | None = None
    at_points: dict[str, list[PointForce]] = field(default_factory=dict)


def no_conditions(layout: Layout) -> Conditions:
    """Nothing held, nothing loaded."""
    shapes = {kind: (layout.rows(kind), DOFS[kind]) for kind in KINDS}
    masks = [{k: np.zeros(s, dtype=bool) for k, s in shapes.items()} for _ in range(2)]
    return Conditions(masks[0], dict.fromkeys(KINDS), supported=masks[1])


def add_gravity(layout: Layout, load: dict, density: np.ndarray, gravity: np.ndarray) -> None:
    """Add the weight; gravity (3,) m/s2. Real masses, also where the masses of motion are scaled."""
    for kind in ("rigid", "affine"):
        which = layout.members[kind]
        _of(load, kind, layout)[:, :3] += (density[which] * layout.volume[which])[:, None] * gravity
    if layout.mesh is not None:
        _of(load, "tets", layout)[:] += node_masses(layout.mesh, density)[:, None] * gravity


def add_traction(blocks: Blocks, layout: Layout, load: dict, push: Push) -> None:
    """Add a uniform traction on faces: exact resultant and moment; tets share it by a third of each triangle."""
    area, _, centre = measures.face_areas_normals_centroids(blocks)
    owner = blocks.face_block()
    for f in push.faces:
        b = int(owner[f])
        if not layout.meshed[b]:
            add_force(layout, load, b, push.stress * area[f], centre[f] - layout.centroid[b])
    meshed = push.faces[layout.meshed[owner[push.faces]]]
    if layout.mesh is not None and len(meshed):
        nodes, tributary = surface_nodes(layout.mesh, blocks, meshed)
        np.add.at(_of(load, "tets", layout), nodes, tributary[:, None] * push.stress)


def points_of(blocks: Blocks, layout: Layout, push: Push, fixed: bool = False) -> list[PointForce]:
    """The forces of a traction on rigid blocks, one a face."""
    area, _, centre = measures.face_areas_normals_centroids(blocks)
    owner = blocks.face_block()
    return [
        PointForce(int(owner[f]), centre[f] - layout.centroid[owner[f]], push.stress * area[f], fixed)
        for f in push.faces
        if not layout.deforms[owner[f]]
    ]


def add_force(layout: Layout, load: dict, b: int, force: np.ndarray, arm: np.ndarray) -> None:
    """Add a force (3,) N on a rigid or affine block, at an arm (3,) m from its centroid."""
    kind, row = KINDS[layout.kind[b]], layout.local[b]
    _of(load, kind, layout)[row] += np.concatenate([force, KIND[kind].moment(layout.axes[b], arm, force)])


def _of(load: dict, kind: str, layout: Layout) -> np.ndarray:
    """The dead loads of a kind, made on first use; a kind without rows gets none."""
    if layout.rows(kind) == 0:
        return np.zeros((0, DOFS[kind]))
    if load[kind] is None:
        load[kind] = np.zeros((layout.rows(kind), DOFS[kind]))
    return load[kind]


def add_load(layout: Layout, total: dict, more: dict) -> None:
    """Add one dead load to the sum of them."""
    for kind in KINDS:
        if more[kind] is not None:
            _of(total, kind, layout)[:] += more[kind]


def drive_dofs(mask: dict[str, np.ndarray], axis: int) -> dict[str, np.ndarray | None]:
    """Flat indices, per kind, of the dofs of a mask that move along an axis; None where there are none."""
    indices: dict[str, np.ndarray | None] = {}
    for kind, driven in mask.items():
        rows = np.flatnonzero(driven[:, axis])
        indices[kind] = rows * DOFS[kind] + axis if len(rows) else None
    return indices
