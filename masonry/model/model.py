"""Blocks + properties -> the flat arrays that the step runs on. Owns dtype (float64) and units (SI)."""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from geometry.blocks import Blocks, Joints
from masonry.laws.state import ContactState, JointProperties, has_strength
from masonry.model import stable_step
from masonry.model.body_arrays import (
    Bodies,
    Contacts,
    Groups,
    SideRows,
    bodies_of,
    group_state,
    idle_where_dry,
    in_rows,
    initial_state,
    rows_of_sides,
)
from masonry.model.contact_groups import contact_groups
from masonry.model.damping import (
    Damping,
    Phases,
    Swing,
    damping_in_steps,
    expects_motion,
    local_damping,
    price_of_dashpots,
)
from masonry.model.element_plan import Ends, elements_of, first_forces
from masonry.model.kinds import dof_words
from masonry.model.large.meeting import (
    Large,
    Meetings,
    bonds_of,
    near_of,
    pushed,
    without_sides,
)
from masonry.model.layout import DOFS, KINDS, Layout, Material, real_masses
from masonry.model.loads import Conditions
from masonry.model.phase_sums import Outline, PhaseSums, Stiffness, sums_of_phases
from masonry.model.step_cost import StepCost, step_cost
from masonry.patches.branches import NO_DASHPOTS, Dashpots, dashpots_of
from masonry.simd.rows import aligned


@dataclass(frozen=True)
class Stepping:
    """How time advances. masses: "scaled" (quasi-static) or "real"; time_step: "gershgorin", "equation-11", or seconds;
    step_fraction: of the proven bound (of eq. (11): its frac); damping: of damping.py; swing: what damps once the dead
    loads have settled, None where that is the same."""

    masses: str = "scaled"
    time_step: str | float = "gershgorin"
    step_fraction: float = 0.9
    damping: Damping = 0.8
    swing: Swing | None = None


@dataclass
class Model:
    """All that a step reads and writes. See kernels/step.py for the meaning of groups, contacts, bodies, drives.

    u      displacements (m) of tet nodes, then of contact points and of ends of elements
    force  (C + K, 3) N of the contacts, and behind them of elements
    swept  contact groups whose law the step calls
    alive  (C,) which contacts hold; patches take the place of those that do not
    large  what there is besides in large displacement; configuration/configuration.py asks whether there is
    damping  of bodies, now; phases: before and after the end of the settling, None where it stays
    dashpots  in closed contacts from then on, None without any; acting: those that act now
    elements  between points of blocks, or beside them: `masonry.elements.element` says what they answer
    parts  what configuration/parts/parts.py keeps here: how the bodies move, for as long as they are these bodies
    configuration  what configuration/configuration.py keeps here: what answers for its displacements
    """

    blocks: Blocks
    joints: Joints
    layout: Layout
    group_names: tuple[str, ...]
    group: np.ndarray
    state: ContactState
    groups: Groups
    contacts: Contacts
    bodies: Bodies
    drives: tuple
    supports: tuple
    masses: dict[str, np.ndarray]
    damping: Damping
    dt: float
    bound: float
    limited_by: str
    cost: StepCost | None
    u: np.ndarray
    force: np.ndarray
    swept: tuple[int, ...]
    alive: np.ndarray
    varying: list[dict[str, np.ndarray | None]]
    scaled: bool = True
    large: Large | None = None
    motion: dict[str, np.ndarray] | None = None
    phases: Phases | None = None
    dashpots: Dashpots | None = None
    acting: Dashpots = NO_DASHPOTS
    elements: tuple[Any, ...] = ()
    parts: Any = field(default=None, init=False, repr=False, compare=False)
    configuration: Any = field(default=None, init=False, repr=False, compare=False)

    def step_arguments(self) -> tuple[tuple, tuple, tuple, tuple]:
        """Groups, contacts, bodies and drives as kernels.step.step takes them: plain tuples, as named ones within
        named ones break its threads."""
        return self.groups.swept(self.swept), tuple(self.contacts), tuple(self.bodies), self.drives

    @property
    def dofs(self) -> int:
        return sum(body.v.size for body in self.bodies if body is not None)

    @property
    def dry(self) -> bool:
        """Whether some contacts are patches, or will be where blocks that are apart meet: those show no stress."""
        return self.large is not None and not (len(self.group) > 0 and bool(self.alive.all()))

    @property
    def crushes(self) -> bool:
        """Whether contacts of the undeformed shape may crush."""
        return self.state.crushed is not None

    def contact(self, c: int) -> str:
        """A contact in words, to blame it in a message."""
        a, b = self.joints.block_a[c], self.joints.block_b[c]
        where = ", ".join(f"{x:.4g}" for x in self.joints.point[c])
        return f"contact {c} ({self.group_names[self.group[c]]}) of blocks {a} and {b} at ({where}) m"

    def two_blocks(self, a: int, b: int) -> str:
        """Two blocks in words, and their groups, of which one may be the floor."""
        one, two = (self.blocks.groups[self.blocks.group[block]] for block in (a, b))
        return f"blocks {a} and {b} ({one} and {two})"


def sort_by_group(blocks: Blocks, joints: Joints) -> tuple[tuple[str, ...], np.ndarray, Joints]:
    """Names of the contact groups, the (C,) group of each contact, and the joints, sorted by group."""
    names, group = contact_groups(blocks, joints)
    order = np.argsort(group, kind="stable")
    per_contact = ["block_a", "block_b", "node_a", "node_b", "point", "normal", "area", "patch"]
    if joints.corner_a is not None:
        per_contact += ["corner_a", "share_a", "corner_b", "share_b"]
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
    meetings: Meetings | None = None,
    density: np.ndarray | None = None,
) -> Model:
    """Arrays of a model. `joints` sorted by group (sort_by_group); laws: group -> (parameters, JointProperties).

    meetings  how blocks meet in large displacement; None in small
    density   (B,) kg/m3; None: that of the materials
    """
    names, group = contact_groups(blocks, joints)
    sides, length = _sides(layout, joints)
    stiffness = _stiffness([laws[name][1] for name in names], group, joints, _lame(blocks, layout, materials))
    real = real_masses(layout, _density(blocks, materials) if density is None else density)
    ends = [plan.ends(layout, length) for plan in conditions.elements]
    outline = Outline(layout, sides, length, joints.normal, tuple(zip(conditions.elements, ends, strict=True)))
    sums = sums_of_phases(blocks, outline, stiffness, real, (local_damping(stepping.damping), stepping.swing), meetings)
    masses, dt, bound, limited_by = _stepping(layout, sums, real, conditions, stepping, stiffness.normal)
    side_rows = rows_of_sides(layout, sides, ends)
    u, force = _room(side_rows, len(group), ends)
    groups, state = _groups(names, group, laws)
    free = {kind: ~prescribed for kind, prescribed in conditions.prescribed.items()}
    model = Model(
        blocks=blocks,
        joints=joints,
        layout=layout,
        group_names=names,
        group=group,
        state=state,
        groups=groups,
        contacts=_contacts(side_rows, joints, u, force),
        bodies=bodies_of(layout, conditions, masses, dt, stiffness.lame, side_rows, expects_motion(stepping.damping)),
        drives=tuple(_row_and_number(conditions.driven.get(kind), kind) for kind in KINDS),
        supports=tuple(_row_and_number(conditions.support.get(kind), kind) for kind in KINDS),
        masses={kind: np.where(conditions.prescribed[kind], 0.0, masses[kind]) for kind in KINDS},
        damping=damping_in_steps(stepping.damping, dt),
        dt=dt,
        bound=bound,
        limited_by=limited_by,
        cost=step_cost(layout, sums.settling, real, free, stepping.masses == "scaled"),
        u=u,
        force=force,
        swept=tuple(range(len(names))),
        alive=np.ones(len(group), dtype=bool),
        varying=conditions.varying,
        scaled=stepping.masses == "scaled",
        motion=conditions.motion,
        phases=_phases(stepping, dt),
        dashpots=_dashpots(stepping, dt, len(group)),
    )
    rows = side_rows.ends
    if meetings is not None:
        model, rows = enlarged(model, meetings, masses, rows, conditions)
    model.elements = elements_of(model, conditions, ends, rows, meetings is not None)
    return model


def _density(blocks: Blocks, materials: dict[str, Material]) -> np.ndarray:
    """(B,) kg/m3 of the materials."""
    return np.array([materials[g].density for g in blocks.groups])[blocks.group]


def _room(side_rows: SideRows, contacts: int, ends: list[Ends | None]) -> tuple[np.ndarray, np.ndarray]:
    """Displacements, with a row behind them that never moves where elements have ends, and forces of contacts and
    elements."""
    rows = side_rows.total + any(own is not None for own in ends)
    forces = first_forces(contacts, ends)[-1]
    return in_rows(np.zeros((rows, 3))), in_rows(np.zeros((forces, 3)))


def _contacts(side_rows: SideRows, joints: Joints, u: np.ndarray, force: np.ndarray) -> Contacts:
    """Contacts without a force yet: their rows are the first of force (C + K, 3), those of elements follow."""
    own = force if len(force) == len(joints.area) else force[: len(joints.area)]
    return Contacts(side_rows.sides, aligned(joints.normal), aligned(joints.area), u, own)


def _sides(layout: Layout, joints: Joints) -> tuple[tuple[stable_step.Side, stable_step.Side], np.ndarray]:
    """Both sides of the contacts, and the (B, 3) lengths of the blocks, m."""
    a, b = side_of(layout, joints, "a"), side_of(layout, joints, "b")
    block, arm = np.concatenate([joints.block_a, joints.block_b]), np.concatenate([a.arm, b.arm])
    length = stable_step.lengths(layout, block, arm)
    return (replace(a, length=length[joints.block_a]), replace(b, length=length[joints.block_b])), length


def _stiffness(properties: list[JointProperties], group: np.ndarray, joints: Joints, lame: np.ndarray) -> Stiffness:
    """Of the contacts, from the properties of their groups, and of the blocks."""
    normal = np.array([joint.normal_stiffness * (1.0 + (joint.tan_dilation or 0.0)) for joint in properties])
    shear = np.array([joint.shear_stiffness for joint in properties])
    return Stiffness(normal[group] * joints.area, shear[group] * joints.area, lame)


def _phases(stepping: Stepping, dt: float) -> Phases | None:
    """The damping of bodies in steps of dt (s), where it changes at the end of the settling."""
    if stepping.swing is None:
        return None
    return Phases(damping_in_steps(stepping.damping, dt), stepping.swing.of_bodies(dt))


def _dashpots(stepping: Stepping, dt: float, contacts: int) -> Dashpots | None:
    """Dashpots of so many contacts in steps of dt (s)."""
    if stepping.swing is None or not stepping.swing.in_contacts:
        return None
    return dashpots_of(*stepping.swing.branches(dt), contacts)


def _groups(names: tuple[str, ...], group: np.ndarray, laws: dict[str, tuple]) -> tuple[Groups, ContactState]:
    """The contact groups with their laws, and the state of the contacts, sorted by group (C,), that they see."""
    properties = tuple(laws[name][1] for name in names)
    state = initial_state(group, list(properties))
    bounds = np.searchsorted(group, np.arange(len(names) + 1)).astype(np.uint32)
    states = tuple(group_state(state, joint) for joint in properties)
    return Groups(tuple(laws[name][0] for name in names), properties, states, bounds), state


def enlarged(
    model: Model,
    meetings: Meetings,
    masses: dict[str, np.ndarray],
    ends: tuple[np.ndarray, ...],
    conditions: Conditions,
) -> tuple[Model, tuple[np.ndarray, ...]]:
    """The same model in large displacement, and rows of u of the ends of elements, as they are then.

    masses of motion by kind, of held blocks too

    Contacts without strength become patches.
    """
    joints, layout, count = model.joints, model.layout, len(model.group)
    apart = in_rows(np.zeros(model.force.shape))
    bodies = pushed(model.bodies, masses, apart)
    without = np.array([not has_strength(joint) for joint in model.groups.properties], dtype=bool)
    dry = without[model.group]
    rows = np.column_stack([np.zeros(count), np.arange(1, count + 1)]).astype(np.uint32)
    parted = in_rows(np.zeros((count + 1, 3)))
    contacts = model.contacts._replace(sides=aligned(rows), u=parted, area=aligned(np.where(dry, 0.0, joints.area)))
    bonded = np.column_stack([joints.block_a, joints.block_b])[~dry]
    moved = [dofs for plan in conditions.elements for dofs in plan.moved()]
    near, members = near_of(model.blocks, layout, bodies, masses, meetings, bonded, model.drives, moved)
    if near.rules.rise is not None:
        near.rules.rise[...] *= [model.dt, model.dt**2, 1.0 / model.dt]
    frames = near.motion.frame if members is None else near.motion.frame.copy()
    sides = model.contacts.sides
    if members is None:
        bodies, ends = without_sides(bodies, count, ends)
    bonds = bonds_of(sides, joints, layout.centroid, frames, model.contacts.u, apart, ~dry)
    large = replace(
        model,
        contacts=contacts,
        force=bonds.force,
        groups=idle_where_dry(model.groups),
        bodies=bodies,
        swept=tuple(np.flatnonzero(~without).tolist()),
        alive=bonds.alive,
        large=Large(bonds, parted[1:], near, members),
    )
    return large, ends


def _row_and_number(dofs: np.ndarray | None, kind: str) -> np.ndarray | None:
    """(K, 2) of flat indices of dofs."""
    return None if dofs is None else np.column_stack(np.divmod(dofs, DOFS[kind]))


def side_of(layout: Layout, joints: Joints, which: str) -> stable_step.Side:
    """One side ("a", "b") of all contacts."""
    block, node, corner, fraction = (
        getattr(joints, f"{name}_{which}") for name in ("block", "node", "corner", "share")
    )
    kind = layout.kind[block]
    row = np.where(layout.meshed[block], node, layout.local[block])
    axes = layout.axes[block]
    arm = np.einsum("cji,cj->ci", axes, joints.point - layout.centroid[block])
    return stable_step.Side(kind, row, arm, axes, np.ones((len(block), 3)), corner, fraction)


def _lame(blocks: Blocks, layout: Layout, materials: dict[str, Material]) -> np.ndarray:
    """(B, 2) Pa, zero for rigid blocks."""
    lame = np.zeros((blocks.count, 2))
    for g, name in enumerate(blocks.groups):
        which = (blocks.group == g) & layout.deforms
        if which.any():
            lame[which] = materials[name].lame()
    return lame


def _stepping(
    layout: Layout, phases: PhaseSums, real: dict, conditions: Conditions, stepping: Stepping, kn: np.ndarray
) -> tuple[dict, float, float, str]:
    """Masses of motion, time step, its proven bound, and what limits it."""
    swing, xi, sums = stepping.swing, local_damping(stepping.damping), phases.settling
    fraction = phases.share * stepping.step_fraction
    free = {kind: ~held for kind, held in conditions.prescribed.items()}
    if not any(each.any() for each in free.values()):  # what is held or led throughout has the step of what is free
        free = {kind: np.ones_like(each) for kind, each in free.items()}
    if stepping.masses == "real":
        bound, kind, row, i = stable_step.stable_step(sums, real, free, xi)
        price = ""
        if swing is not None:
            swung = stable_step.stable_step(phases.swinging or sums, real, free, swing.local)
            if swing.stiffness_time and swung[0] < bound:
                price = price_of_dashpots(stable_step.stable_step(sums, real, free, swing.local)[0] / swung[0])
            bound, kind, row, i = min(swung, (bound, kind, row, i))
        dt = fraction * bound
        if stepping.time_step == "equation-11":
            dt = stable_step.equation_11(layout, real, kn, fraction)
        elif not isinstance(stepping.time_step, str):
            dt = stepping.time_step
        return real, dt, bound, f"{dof_words(layout, kind, row, i)}{price}" if kind else "nothing: nothing can move"
    dt = stable_step.step_that_keeps_the_mass(sums, real, free, fraction, xi)
    if not isinstance(stepping.time_step, str):
        dt = stepping.time_step
    masses = stable_step.scaled_masses(sums, dt, fraction, xi)
    return masses, dt, dt / fraction, "every degree of freedom alike: masses are scaled to one bound"
