"""Flat arrays of a model: the sides of the contacts in the order of their bodies, the bodies, the contacts' state."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from geometry.blocks import TetMesh
from masonry.kinematics.affine import Affine
from masonry.kinematics.rigid import Rigid
from masonry.kinematics.tets import Tets
from masonry.laws.elastic import Elastic
from masonry.laws.state import ContactState, JointProperties, fresh, has_strength
from masonry.model.element_plan import Ends, first_forces
from masonry.model.kinds import KIND
from masonry.model.layout import KINDS, Layout, tet_gradients, tet_volumes
from masonry.model.loads import Conditions
from masonry.model.stable_step import BETWEEN, Side
from masonry.simd.rows import BEHIND, aligned


class Groups(NamedTuple):
    """Data of each contact group, and bounds (G + 1,): the range of its contacts."""

    parameters: tuple
    properties: tuple
    states: tuple
    bounds: np.ndarray

    def swept(self, which: Sequence[int]) -> tuple[tuple, tuple, tuple, np.ndarray]:
        """Parameters, properties and states of some groups, and (2 K,) the first contact of each and the one behind."""
        own = [tuple(part[g] for g in which) for part in self[:3]]
        return own[0], own[1], own[2], np.array([self.bounds[g + i] for g in which for i in (0, 1)], dtype=np.int64)


class Contacts(NamedTuple):
    """Rows of u of both sides (C, 2), normal (C, 3), area (C,) m2, displacements u (m), and force (C, 3) N."""

    sides: np.ndarray
    normal: np.ndarray
    area: np.ndarray
    u: np.ndarray
    force: np.ndarray


class Bodies(NamedTuple):
    """Blocks by how they move (Rigid, Affine, Tets), None where there are none."""

    rigid: Any
    affine: Any
    tets: Any


class SideRows(NamedTuple):
    """Where the sides of contacts stand among the rows of u: nodes, points of rigid and affine blocks, points between.

    total    rows of u
    first    by kind, and "between", the first row of its points
    sides    (C, 2) rows of both sides
    ends     (E,) rows of the ends of each element
    ordered  by kind, (start, code, arm) of the sides in the order of their bodies; under "between" nodes, shape
             functions and code of the sides whose points lie between tet nodes, in order of nodes
    """

    total: int
    first: dict[str, int]
    sides: np.ndarray
    ends: tuple[np.ndarray, ...]
    ordered: dict[str, tuple]


def rows_of_sides(layout: Layout, sides: tuple[Side, Side], ends: Sequence[Ends | None] = ()) -> SideRows:
    """The rows of both sides of the contacts, and of the ends of elements, None of those without any."""
    count = len(sides[0].kind)
    each = [(own, first) for own, first in zip(ends, first_forces(count, ends), strict=False) if own is not None]
    every = (*sides, *(own.side for own, _ in each))
    kind, row, arm, axes = (
        np.concatenate([getattr(s, name) for s in every]) for name in ("form", "row", "arm", "axes")
    )
    code = np.concatenate([2 * np.arange(count), 2 * np.arange(count) + 1, *(own.code(first) for own, first in each)])
    rigid, affine, _, between = (int(points) for points in np.bincount(kind, minlength=BETWEEN + 1))
    nodes = layout.rows("tets")
    first = {"tets": 0, "rigid": nodes, "affine": nodes + rigid, "between": nodes + rigid + affine}
    place, ordered = row.copy(), {}
    for k, name in enumerate(KINDS):
        which = np.flatnonzero(kind == k)
        which = which[np.lexsort((code[which], row[which]))]
        start = np.searchsorted(row[which], np.arange(layout.rows(name) + 1)).astype(np.uint32)
        arms = np.ascontiguousarray(KIND[name].local_arms(arm[which], axes[which]))
        ordered[name] = start, code[which].astype(np.uint32), arms
        if not KIND[name].nodal:
            place[which] = first[name] + np.arange(len(which))
    which = np.flatnonzero(kind == BETWEEN)
    if len(which):
        corner, fraction = (
            np.concatenate([_three(s, getattr(s, name)) for s in every])[which] for name in ("corner", "fraction")
        )
        order = np.argsort(corner[:, 0], kind="stable")
        place[which[order]] = first["between"] + np.arange(len(which))
        ordered["between"] = corner[order], fraction[order], code[which[order]]
    both = aligned(place[: 2 * count].reshape(2, -1).T.astype(np.uint32))
    numbers = [0 if own is None else len(own.force) for own in ends]
    of_ends = np.split(place[2 * count :], np.cumsum(numbers))[: len(ends)]
    return SideRows(first["between"] + between, first, both, tuple(of_ends), ordered)


def _three(side: Side, values: np.ndarray | None) -> np.ndarray:
    """(n, 3) what sides have of three nodes; -1 of those that have none."""
    return np.full((len(side.kind), 3), -1) if values is None else values


def bodies_of(
    layout: Layout, conditions: Conditions, masses: dict, dt: float, lame: np.ndarray, side_rows: SideRows, guided: bool
) -> Bodies:
    """The blocks by how they move; guided bodies have room for their expected velocities."""
    members, first, arms = layout.members, side_rows.first, {kind: side_rows.ordered[kind][2] for kind in KINDS}
    common = {kind: _common(kind, layout, conditions, dt, masses[kind], side_rows, guided) for kind in KINDS}
    axes = {kind: _axes(layout.axes[blocks]) for kind, blocks in members.items()}
    rigid = affine = tets = None
    if len(b := members["rigid"]):
        q, point = in_rows(np.zeros((len(b), 6))), np.uint32(first["rigid"])
        rigid = Rigid(q=q, arm=arms["rigid"], first_point=point, axes=axes["rigid"], **common["rigid"])
    if len(b := members["affine"]):
        q, point = in_rows(np.zeros((len(b), 12))), np.uint32(first["affine"])
        stiffness = lame[b] * layout.volume[b, None]
        affine = Affine(
            q=q, arm=arms["affine"], stiffness=stiffness, first_point=point, axes=axes["affine"], **common["affine"]
        )
    if layout.mesh is not None and len(members["tets"]):
        sides = side_rows.ordered.get("between")
        between = {} if sides is None else _between(layout, layout.mesh, sides, first["between"])
        tets = _tets(layout, layout.mesh, lame, {**common["tets"], **between})
    return Bodies(rigid, affine, tets)


def _common(
    kind: str, layout: Layout, conditions: Conditions, dt: float, masses: np.ndarray, side_rows: SideRows, guided: bool
) -> dict:
    """Fields that bodies of every kind have; masses (rows, dofs) kg, kg m2."""
    prescribed, load = conditions.prescribed[kind], conditions.load[kind]
    varies = any(varying[kind] is not None for varying in conditions.varying)
    start, code, _ = side_rows.ordered[kind]

    def room() -> np.ndarray:
        return in_rows(np.zeros(prescribed.shape))

    return {
        "v": room(),
        "contact": room(),
        "hold": room(),
        "dt_over_mass": in_rows(np.where(prescribed, 0.0, dt / np.where(masses > 0, masses, np.inf))),
        "start": start,
        "code": code,
        "load": in_rows(load) if load is not None else room() if varies else None,
        "change": room() if varies else None,
        "guess": room() if guided else None,
        "work": np.zeros((len(layout.members[kind]), 3)),
    }


def _axes(axes: np.ndarray) -> np.ndarray | None:
    """(n, 3, 3) axes of blocks; None where all are x, y, z."""
    return None if np.array_equal(axes, np.broadcast_to(np.eye(3), axes.shape)) else axes


def _tets(layout: Layout, mesh: TetMesh, lame: np.ndarray, common: dict) -> Tets:
    b = layout.members["tets"]
    last = np.append(b, len(mesh.node_start) - 1)
    count = np.diff(mesh.tet_start[last])
    group_start = np.concatenate([[0], np.cumsum(-(-count // 8))])
    slot = np.arange(len(mesh.tets)) + np.repeat(8 * group_start[:-1] - mesh.tet_start[last[:-1]], count)
    corner = np.repeat(np.repeat(mesh.node_start[b], 8 * np.diff(group_start))[:, None], 4, axis=1)
    corner[slot] = mesh.tets
    slope = np.zeros((len(corner), 9))
    slope[slot] = (tet_gradients(mesh)[:, 1:] * np.sqrt(tet_volumes(mesh))[:, None, None]).reshape(-1, 9)
    return Tets(
        inner=in_rows(np.zeros((len(mesh.nodes), 3))),
        node_start=mesh.node_start[last].astype(np.uint32),
        group_start=group_start.astype(np.uint32),
        corner=_side_by_side(corner).astype(np.uint32),
        slope=_side_by_side(slope),
        lame=np.ascontiguousarray(lame[b]),
        **common,
    )


def _side_by_side(rows: np.ndarray) -> np.ndarray:
    """(8 G, n) -> (G, n, 8)."""
    return np.ascontiguousarray(rows.reshape(-1, 8, rows.shape[1]).transpose(0, 2, 1))


def in_rows(values: np.ndarray) -> np.ndarray:
    """The same numbers in rows that lie 4 or 8 apart, on boundaries of 64 bytes, so that a row is one vector."""
    rows, used = values.shape
    width = -(-used // 8) * 8 if used in (6, 8) else -(-used // 4) * 4
    view = aligned(np.zeros((rows + BEHIND) * width)).reshape(-1, width)[:rows, :used]
    view[...] = values
    return view


def whole_rows(view: np.ndarray) -> np.ndarray:
    """The rows of `in_rows` with the room behind their numbers: one piece of memory, where a number is found sooner."""
    width = view.strides[0] // view.itemsize
    return np.lib.stride_tricks.as_strided(view, (len(view), width), (view.strides[0], view.itemsize))


def _between(layout: Layout, mesh: TetMesh, sides: tuple, first: int) -> dict:
    """Fields of Tets for the sides whose points lie between nodes, as number_sides gives them."""
    corner, fraction, code = sides
    last = np.append(layout.members["tets"], len(mesh.node_start) - 1)
    order = np.argsort(corner.ravel(), kind="stable")
    return {
        "corner_between": corner.astype(np.uint32),
        "fraction_between": np.ascontiguousarray(fraction),
        "start_between": np.searchsorted(corner[:, 0], mesh.node_start[last]).astype(np.uint32),
        "first_between": np.uint32(first),
        "pull_start": np.searchsorted(corner.ravel()[order], np.arange(len(mesh.nodes) + 1)).astype(np.uint32),
        "pull_code": np.repeat(code, 3)[order].astype(np.uint32),
        "pull_fraction": fraction.ravel()[order],
    }


def initial_state(group: np.ndarray, joint_properties: list[JointProperties]) -> ContactState:
    """Intact contacts, nothing opened beyond the elastic limit. A strength may differ from contact to contact."""
    limit, stiffness = np.zeros(len(group)), np.zeros(len(group))
    for g, joint in enumerate(joint_properties):
        strength = 0.0 if joint.tensile_strength is None else joint.tensile_strength
        limit[group == g] = strength / joint.normal_stiffness
        stiffness[group == g] = joint.normal_stiffness
    return fresh(
        limit,
        stiffness,
        dilates=any(i.tan_dilation is not None for i in joint_properties),
        permanent_opening=any(i.elastic_unloading is not None for i in joint_properties),
        crushes=any(i.compressive_strength is not None for i in joint_properties),
    )


def group_state(state: ContactState, joint: JointProperties) -> ContactState:
    """A group's view of the state: what its law does not use is None, and compiled away."""
    if joint.tensile_strength is None:
        return ContactState()
    dilates = joint.tan_dilation is not None
    return state._replace(
        dilation=state.dilation if dilates else None,
        permanent_opening=state.permanent_opening if joint.elastic_unloading is not None else None,
        plastic_slip=state.plastic_slip if dilates else None,
        crushed=state.crushed if joint.compressive_strength is not None else None,
    )


def idle_where_dry(groups: Groups) -> Groups:
    """The same groups, where those without strength have a law that does nothing: patches take their place."""
    parts = zip(groups.parameters, groups.properties, groups.states, strict=True)
    near = [
        (Elastic(), JointProperties(joint.normal_stiffness, joint.shear_stiffness), ContactState())
        if not has_strength(joint)
        else (parameters, joint, state)
        for parameters, joint, state in parts
    ]
    columns = [tuple(column) for column in zip(*near, strict=True)] or [(), (), ()]
    return Groups(columns[0], columns[1], columns[2], groups.bounds)
