"""Drive, tractions and gravity on the dofs of the bodies; what is absent stays None."""

from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from math import ceil
from typing import NamedTuple

import numpy as np

from geometry.blocks import Blocks
from geometry.joints.boundary import surface_nodes
from geometry.polyhedra import measures
from masonry.errors import SceneError
from masonry.model.layout import DOFS, KINDS, Layout, node_masses


@dataclass(frozen=True)
class Push:
    """Uniform traction (3,) Pa on faces."""

    faces: np.ndarray
    stress: np.ndarray


@dataclass
class Conditions:
    """Per kind: masks of what supports and drive prescribe, dead loads (None where there are none); flat indices of the
    driven dofs and of those that support against the drive; masks of what supports alone hold; loads of tractions
    that vary, one entry each, by kind, at a share of 1. And by name: masks of what each support and the drive hold, and
    each dead load at a share of 1, those that vary included.

    motion  per kind, velocities (rows, dofs) that bodies start with, in the dofs that v has; None without any
    spin    (B, 3) rad/s along x, y, z, with which each block starts; None without any
    """

    prescribed: dict[str, np.ndarray]
    load: dict[str, np.ndarray | None]
    driven: dict[str, np.ndarray | None] = field(default_factory=dict)
    support: dict[str, np.ndarray | None] = field(default_factory=dict)
    supported: dict[str, np.ndarray] = field(default_factory=dict)
    varying: list[dict[str, np.ndarray | None]] = field(default_factory=list)
    held_by: dict[str, dict[str, np.ndarray]] = field(default_factory=dict)
    each_load: dict[str, dict[str, np.ndarray | None]] = field(default_factory=dict)
    motion: dict[str, np.ndarray] | None = None
    spin: np.ndarray | None = None


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
        if KINDS[layout.kind[b]] != "tets":
            add_force(layout, load, b, push.stress * area[f], centre[f] - layout.centroid[b])
    meshed = push.faces[layout.kind[owner[push.faces]] == KINDS.index("tets")]
    if layout.mesh is not None and len(meshed):
        nodes, tributary = surface_nodes(layout.mesh, blocks, meshed)
        np.add.at(_of(load, "tets", layout), nodes, tributary[:, None] * push.stress)


def add_force(layout: Layout, load: dict, b: int, force: np.ndarray, arm: np.ndarray) -> None:
    """Add a force (3,) N on a rigid or affine block, at an arm (3,) m from its centroid."""
    kind, row = KINDS[layout.kind[b]], layout.local[b]
    if kind == "rigid":
        moment = layout.axes[b].T @ np.cross(arm, force)
    else:
        moment = np.outer(force, layout.axes[b].T @ arm).ravel()
    _of(load, kind, layout)[row] += np.concatenate([force, moment])


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
    found: dict[str, np.ndarray | None] = {}
    for kind, held in mask.items():
        rows = np.flatnonzero(held[:, axis])
        found[kind] = rows * DOFS[kind] + axis if len(rows) else None
    return found


def smooth(x: np.ndarray) -> np.ndarray:
    """Quintic rise from 0 to 1 over [0, 1] with zero slope and curvature at both ends."""
    x = np.clip(x, 0.0, 1.0)
    return x**3 * (10.0 + x * (6.0 * x - 15.0))


MOST_STEPS = 100_000_000


@dataclass(frozen=True)
class Program:
    """What happens at each step 0..n: share of the dead load, velocity of the drive (m/s) after the step.

    settle  steps before the drive starts     ramp  steps over which the drive's velocity rises
    varying (H, n + 1) share of each load that varies, at each step; None without any
    marks   steps, rising, after which a row is due besides the regular ones
    layers  (L, settle + 1) share of each load that comes on in layers, until the end of the settling; None without any
    straight   of its largest share: how far a history may leave the straight line that the loading takes for it
    rest_from  step from which on the run may end as soon as all is at rest; None where it goes on to the last step
    """

    dead_load: np.ndarray
    speed: np.ndarray
    settle: int
    ramp: int
    varying: np.ndarray | None = None
    marks: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    straight: float = 1e-3
    rest_from: int | None = None
    layers: np.ndarray | None = None

    @property
    def steps(self) -> int:
        return len(self.speed) - 1

    @property
    def load_factors(self) -> np.ndarray | None:
        """(L + H, n + 1) factor of each load that does not simply rise with the others, at each step."""
        if self.layers is None:
            return self.varying
        stay = np.pad(self.layers, ((0, 0), (0, self.steps - self.settle)), mode="edge")
        return stay if self.varying is None else np.concatenate([stay, self.varying])


@dataclass(frozen=True)
class Controlled:
    """A drive paced by its error (loading/adaptive.py): displacement (m, signed) and accuracy (0.01 is 1 %).

    dead_load  (settle + 1,) share of the dead load at each step before the drive starts; its last value stays
    reversals  places (m, signed) that the drive visits one after the other, in place of going to its displacement
    layers     as of Program
    """

    dead_load: np.ndarray
    displacement: float
    accuracy: float
    reversals: tuple[float, ...] = ()
    layers: np.ndarray | None = None

    ramp = 0

    @property
    def settle(self) -> int:
        return len(self.dead_load) - 1


class Control(NamedTuple):
    """Behind its collapse a load is led by a gauge, by its name, until it reads so much (m)."""

    gauge: str
    until: float


class Leg(NamedTuple):
    """A part of the way of a load's factor, from one value to another."""

    start: float
    end: float

    @property
    def length(self) -> float:
        return abs(self.end - self.start)

    def at(self, passed: float) -> float:
        """The factor behind so much of the leg."""
        if passed >= self.length:
            return self.end
        return self.start + (passed if self.end > self.start else -passed)


@dataclass(frozen=True)
class Growing:
    """A load whose factor grows until nothing balances it (loading/growing.py), to an accuracy, up to `most`.

    dead_load  (settle + 1,) share of the dead load at each step before it grows; its last value stays
    reversals  factors to which the load goes one after the other, in place of growing up to `most`
    tilts      whether the factor is the tangent of the angle by which gravity turns: two loads, see `load_factors`
    layers     as of Program
    """

    dead_load: np.ndarray
    accuracy: float
    most: float
    tilts: bool = False
    layers: np.ndarray | None = None
    control: Control | None = None
    reversals: tuple[float, ...] = ()

    ramp = 0

    @property
    def settle(self) -> int:
        return len(self.dead_load) - 1

    @cached_property
    def legs(self) -> tuple[Leg, ...]:
        """The way of the factor."""
        return tuple(Leg(start, end) for start, end in pairwise((0.0, *(self.reversals or (self.most,)))))

    @property
    def path(self) -> float:
        """The length of all legs."""
        return sum(leg.length for leg in self.legs)

    @property
    def span(self) -> float:
        """From the least factor on the way to the greatest."""
        return float(np.ptp([0.0, *(leg.end for leg in self.legs)]))

    def load_factors(self, factor: float) -> np.ndarray:
        """(H,) factors of the loads that vary; of a tilt those of the weight less 1, and of it turned by 90 degrees."""
        if not self.tilts:
            return np.array([factor])
        whole = float(np.hypot(1.0, factor))
        return np.array([1.0 / whole - 1.0, factor / whole])

    def slope(self, factor: float) -> np.ndarray:
        """(H,) by how much the load factors change per unit of the factor."""
        whole = float(np.hypot(1.0, factor))
        return np.array([-factor, 1.0]) / whole**3 if self.tilts else np.ones(1)


Plan = Program | Controlled | Growing


def controlled(settle: int, displacement: float, accuracy: float, reversals: tuple[float, ...] = ()) -> Controlled:
    """Dead loads rise over the first half of `settle`; then the drive makes its way to an accuracy."""
    return Controlled(rise(settle, settle), displacement, accuracy, reversals)


def rise(settle: int, steps: int) -> np.ndarray:
    """Share of the dead loads at each step 0..n: they rise over the first half of `settle`, if there is one."""
    return smooth(np.arange(steps + 1) / (0.5 * settle)) if settle else np.zeros(steps + 1)


def require_few(steps: float, dt: float, where: str = "drive", advice: str = "") -> None:
    """SceneError where a program, that of a key of the scene, would take more steps than anybody waits for."""
    if steps > MOST_STEPS:
        raise SceneError(
            f"{where}: this would take {steps:.2g} steps of {dt:.3g} s; at most {MOST_STEPS:.0e} are allowed: "
            f"{advice or 'raise drive.rate, or give drive.steps'}"
        )


def program(dt: float, settle: int, displacement: float, steps: int | None, rate: float | None, ramp: float) -> Program:
    """Dead loads rise over the first half of `settle`; then the drive makes exactly `displacement` (m, signed).

    Either the number of steps or the rate (m/s) after the ramp is given; the ramp takes a share of the steps.
    """
    if displacement == 0.0:
        count = 0
    elif steps is not None:
        count = steps
    else:
        assert rate is not None
        count = max(1, ceil(min(abs(displacement) / (rate * dt * (1.0 - 0.5 * ramp)), 1e18)))
    if count and settle == 0:
        count = max(count, 2)  # the first step starts at rest and cannot move anything
    require_few(settle + count, dt)
    k = np.arange(settle + count + 1)
    shape: np.ndarray = np.where(
        k < settle, 0.0, smooth((k - settle + 0.5) / (ramp * count)) if ramp * count > 0 else 1.0
    )
    shape[[0, -1]] = 0.0  # the first step starts at rest; what is set after the last step moves nothing
    speed = shape * (displacement / (dt * shape.sum())) if count else np.zeros(len(k))
    return Program(rise(settle, settle + count), speed, settle, int(np.ceil(ramp * count)))
