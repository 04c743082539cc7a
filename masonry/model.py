"""Blocks + properties -> the flat arrays that the step runs on. Owns dtype (float64) and units (SI)."""

from dataclasses import dataclass

import numpy as np

from geometry.blocks import Blocks, Joints, TetMesh
from masonry import stiffness
from masonry.bodies import KINDS, Layout, Material, real_masses, tet_gradients, tet_volumes
from masonry.contact_groups import contact_groups
from masonry.kinematics.affine import Affine
from masonry.kinematics.rigid import Rigid
from masonry.kinematics.tets import Tets
from masonry.laws.interface import Interface
from masonry.laws.state import ContactState, fresh
from masonry.loads import Conditions


@dataclass(frozen=True)
class Stepping:
    """How time advances. masses: "scaled" (quasi-static) or "real"; time_step: "gershgorin", "equation-11", or seconds;
    step_fraction: of the proven bound (of eq. (11): its frac); damping: xi of eq. (3)."""

    masses: str = "scaled"
    time_step: str | float = "gershgorin"
    step_fraction: float = 0.9
    damping: float = 0.8


@dataclass
class Model:
    """All that a step reads and writes. See kernels/step.py for the meaning of groups, contacts, bodies, drives."""

    blocks: Blocks
    joints: Joints
    layout: Layout
    group_names: tuple[str, ...]
    group: np.ndarray
    state: ContactState
    groups: tuple
    contacts: tuple
    bodies: tuple
    drives: tuple
    supports: tuple
    masses: dict[str, np.ndarray]
    damping: float | None
    dt: float
    bound: float
    limited_by: str

    @property
    def freedoms(self) -> int:
        return sum(body.v.size for body in self.bodies if body is not None)


def sort_by_group(blocks: Blocks, joints: Joints) -> tuple[tuple[str, ...], np.ndarray, Joints]:
    """Names of the contact groups, the (C,) group of each contact, and the joints, sorted by group."""
    names, group = contact_groups(blocks, joints)
    order = np.argsort(group, kind="stable")
    per_contact = ("block_a", "block_b", "node_a", "node_b", "point", "normal", "area", "patch")
    values = {name: getattr(joints, name) for name in Joints.__dataclass_fields__}
    values.update({name: np.ascontiguousarray(values[name][order]) for name in per_contact})
    return names, group[order], Joints(**values)


def build(
    blocks: Blocks,
    joints: Joints,
    materials: dict[str, Material],
    laws: dict[str, tuple],
    stepping: Stepping,
    conditions: Conditions,
    layout: Layout,
) -> Model:
    """Arrays of a model. `joints` sorted by group (sort_by_group); laws: contact group -> (shape, Interface)."""
    names, group = contact_groups(blocks, joints)
    interfaces = [laws[name][1] for name in names]
    sides = _side(layout, joints, "a"), _side(layout, joints, "b")
    length = stiffness.lengths(
        layout, np.concatenate([joints.block_a, joints.block_b]), np.concatenate([s.arm for s in sides])
    )
    sides = _with_length(sides[0], length[joints.block_a]), _with_length(sides[1], length[joints.block_b])
    dilated = np.array([i.normal_stiffness * (1.0 + (i.tan_dilation or 0.0)) for i in interfaces])[group] * joints.area
    shear = np.array([i.shear_stiffness for i in interfaces])[group] * joints.area
    lame = _lame(blocks, layout, materials)
    sums = {kind: np.zeros_like(conditions.prescribed[kind], dtype=float) for kind in KINDS}
    stiffness.contact_row_sums(sums, sides, joints.normal, dilated, shear)
    stiffness.affine_row_sums(sums["affine"], layout, lame[layout.members["affine"]], length)
    stiffness.tet_row_sums(sums["tets"], layout, lame)
    stiffness.unscale(sums, layout, length)

    density = np.array([materials[g].density for g in blocks.groups])[blocks.group]
    masses, dt, bound, limited_by = _stepping(layout, sums, real_masses(layout, density), conditions, stepping, dilated)
    rows = {kind: layout.rows(kind) for kind in KINDS}
    first = {"tets": 0, "rigid": rows["tets"]}
    first["affine"] = first["rigid"] + int(np.sum(np.concatenate([s.kind for s in sides]) == KINDS.index("rigid")))
    side_rows, ordered = _number_sides(layout, sides, first, rows)
    u = np.zeros((first["affine"] + int(np.sum(np.concatenate([s.kind for s in sides]) == 1)), 3))
    bodies = _bodies(layout, conditions, masses, dt, lame, ordered, first)
    state = _state(group, interfaces)
    bounds = np.searchsorted(group, np.arange(len(names) + 1))
    states = tuple(_trim(state, i) for i in interfaces)
    return Model(
        blocks=blocks,
        joints=joints,
        layout=layout,
        group_names=names,
        group=group,
        state=state,
        groups=(tuple(laws[n][0] for n in names), tuple(interfaces), states, bounds),
        contacts=(side_rows, joints.normal, joints.area, u, np.zeros((len(group), 3))),
        bodies=bodies,
        drives=tuple(conditions.driven.get(kind) for kind in KINDS),
        supports=tuple(conditions.support.get(kind) for kind in KINDS),
        masses={kind: np.where(conditions.prescribed[kind], 0.0, masses[kind]) for kind in KINDS},
        damping=stepping.damping or None,
        dt=dt,
        bound=bound,
        limited_by=limited_by,
    )


def _side(layout: Layout, joints: Joints, which: str) -> stiffness.Side:
    block, node = getattr(joints, f"block_{which}"), getattr(joints, f"node_{which}")
    kind = layout.kind[block]
    row = np.where(kind == KINDS.index("tets"), node, layout.local[block])
    axes = layout.axes[block]
    arm = np.einsum("cji,cj->ci", axes, joints.point - layout.centroid[block])
    return stiffness.Side(kind, row, arm, axes, np.ones(len(block)))


def _with_length(side: stiffness.Side, length: np.ndarray) -> stiffness.Side:
    return stiffness.Side(side.kind, side.row, side.arm, side.axes, length)


def _lame(blocks: Blocks, layout: Layout, materials: dict[str, Material]) -> np.ndarray:
    """(B, 2) Pa, zero for rigid blocks."""
    lame = np.zeros((blocks.count, 2))
    for g, name in enumerate(blocks.groups):
        which = (blocks.group == g) & (layout.kind != KINDS.index("rigid"))
        if which.any():
            lame[which] = materials[name].lame()
    return lame


def _stepping(
    layout: Layout, sums: dict, real: dict, conditions: Conditions, stepping: Stepping, kn: np.ndarray
) -> tuple[dict, float, float, str]:
    """Masses of motion, time step, its proven bound, and what limits it."""
    xi = stepping.damping
    free = {kind: ~held for kind, held in conditions.prescribed.items()}
    if stepping.masses == "real":
        bound, kind, row, i = stiffness.stable_step(sums, real, free, xi)
        dt = stepping.step_fraction * bound
        if stepping.time_step == "equation-11":
            dt = stiffness.equation_11(layout, real, kn, stepping.step_fraction)
        elif not isinstance(stepping.time_step, str):
            dt = stepping.time_step
        return real, dt, bound, layout.freedom(kind, row, i) if kind else "nothing: nothing can move"
    dt = stiffness.step_that_keeps_the_mass(sums, real, free, stepping.step_fraction, xi)
    if not isinstance(stepping.time_step, str):
        dt = stepping.time_step
    masses = stiffness.scaled_masses(sums, dt, stepping.step_fraction, xi)
    return masses, dt, dt / stepping.step_fraction, "every freedom alike: masses are scaled to one bound"


def _number_sides(layout: Layout, sides: tuple, first: dict[str, int], rows: dict[str, int]) -> tuple:
    """Rows of u of both sides (C, 2), and per kind (start, code, arm) of the sides in the order of their bodies."""
    count = len(sides[0].kind)
    kind = np.concatenate([s.kind for s in sides])
    row = np.concatenate([s.row for s in sides])
    arm = np.concatenate([s.arm for s in sides])
    axes = np.concatenate([s.axes for s in sides])
    code = np.concatenate([2 * np.arange(count), 2 * np.arange(count) + 1])
    place = row.copy()
    ordered = {}
    for k, name in enumerate(KINDS):
        which = np.flatnonzero(kind == k)
        which = which[np.lexsort((code[which], row[which]))]
        start = np.searchsorted(row[which], np.arange(rows[name] + 1))
        arms = arm[which] if name == "affine" else np.einsum("cij,cj->ci", axes[which], arm[which])
        ordered[name] = start.astype(np.int64), code[which].astype(np.int64), np.ascontiguousarray(arms)
        if name != "tets":
            place[which] = first[name] + np.arange(len(which))
    return np.ascontiguousarray(place.reshape(2, count).T), ordered


def _bodies(
    layout: Layout, conditions: Conditions, masses: dict, dt: float, lame: np.ndarray, ordered: dict, first: dict
) -> tuple:
    """(rigid, affine, tets), None where absent."""
    common = {}
    for kind in KINDS:
        held, load = conditions.prescribed[kind], conditions.load[kind]
        zeros = [np.zeros(held.shape) for _ in range(3)]
        pace = np.where(held, 0.0, dt / np.where(masses[kind] > 0, masses[kind], np.inf))
        start, code, _ = ordered[kind]
        common[kind] = {
            **dict(zip(("v", "contact", "hold"), zeros, strict=True)),
            **{
                "pace": pace,
                "start": start,
                "code": code,
                "load": load,
                "work": np.zeros((len(layout.members[kind]), 3)),
            },
        }
    which = layout.members
    axes = {
        kind: None if np.array_equal(layout.axes[b], np.broadcast_to(np.eye(3), (len(b), 3, 3))) else layout.axes[b]
        for kind, b in which.items()
    }
    rigid = affine = tets = None
    if len(which["rigid"]):
        q = np.zeros((len(which["rigid"]), 6))
        rigid = Rigid(q=q, arm=ordered["rigid"][2], first_point=first["rigid"], axes=axes["rigid"], **common["rigid"])
    if len(which["affine"]):
        b = which["affine"]
        affine = Affine(
            q=np.zeros((len(b), 12)),
            arm=ordered["affine"][2],
            stiffness=lame[b] * layout.volume[b, None],
            first_point=first["affine"],
            axes=axes["affine"],
            **common["affine"],
        )
    if layout.mesh is not None and len(which["tets"]):
        tets = _tets(layout, layout.mesh, lame, common["tets"])
    return rigid, affine, tets


def _tets(layout: Layout, mesh: TetMesh, lame: np.ndarray, common: dict) -> Tets:
    b = layout.members["tets"]
    last = np.append(b, len(mesh.node_start) - 1)
    root = np.sqrt(tet_volumes(mesh))
    return Tets(
        inner=np.zeros((len(mesh.nodes), 3)),
        node_start=mesh.node_start[last],
        tet_start=mesh.tet_start[last],
        corner=mesh.tets.astype(np.uint32),
        slope=(tet_gradients(mesh)[:, 1:] * root[:, None, None]).reshape(-1, 9),
        lame=np.ascontiguousarray(lame[b]),
        **common,
    )


def _state(group: np.ndarray, interfaces: list[Interface]) -> ContactState:
    """Fresh memory: intact, nothing opened beyond the elastic limit."""
    limit = np.array([(i.tensile_strength or 0.0) / i.normal_stiffness for i in interfaces])
    return fresh(
        len(group),
        limit[group] if len(group) else np.zeros(0),
        uplift=any(i.tan_dilation is not None for i in interfaces),
        gap=any(i.elastic_unloading is not None for i in interfaces),
        run=any(i.tan_dilation is not None or i.plastic_softening is not None for i in interfaces),
    )


def _trim(state: ContactState, interface: Interface) -> ContactState:
    """A group's view of the memory: what its law does not use is None, and compiled away."""
    if interface.tensile_strength is None:
        return ContactState()
    dilates = interface.tan_dilation is not None
    return state._replace(
        uplift=state.uplift if dilates else None,
        gap=state.gap if interface.elastic_unloading is not None else None,
        run=state.run if dilates or interface.plastic_softening is not None else None,
    )
