"""Result of a limit analysis as data: the factor, the mechanism, the thrust in each joint."""

from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import numpy as np

from geometry.blocks import Joints, Specimen
from geometry.polyhedra.measures import centroids
from masonry.limit_analysis.element_limits import LimitElement
from masonry.limit_analysis.positions import FactorEnvelope
from masonry.results.joint_resultants import COLUMNS, resultants
from masonry.scene import Scene
from masonry.statics.problem import Solution

MOVING = 1e-6
"""Share of the fastest block's speed at which a block counts as moving."""


@dataclass(repr=False)
class LimitData:
    """The answer of a limit analysis.

    factor        the largest load factor, or the factor of safety
    least         of a drive: its least force, N; a negative one pulls
    unit          of the factor, "" for a plain number
    assumed       of what blocks and joints it holds
    bound         what kind of number the factor is under these assumptions
    gap           between the factor and that of the dual problem, over the factor
    unbalance     what is left on the block that is balanced worst, over its own loads
    worst         this block
    velocity      (B, 6) of the mechanism: m/s and rad/s at the centres of the blocks, times any number
    envelope      of a vehicle that travels: its factors over its positions; the rest is of the least
    normal, shear (C,) and (C, 3) N at each contact point of `joints`, what block a does to block b; above 0 it presses
    elements      of the scene, with what each bears
    """

    scene: Scene
    specimen: Specimen
    joints: Joints
    words: str = ""
    unit: str = ""
    assumed: str = ""
    bound: str = ""
    factor: float = 0.0
    gap: float = 0.0
    unbalance: float = 0.0
    worst: int = 0
    velocity: np.ndarray = field(default_factory=lambda: np.zeros((0, 6)))
    normal: np.ndarray = field(default_factory=lambda: np.zeros(0))
    shear: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    method: str = ""
    points: str = ""
    remarks: list[str] = field(default_factory=list)
    is_safety: bool = False
    at: float = 0.0
    least: float | None = None
    with_dilation: float | None = None
    steps: int | None = None
    excess: float | None = None
    open: float | None = None
    seconds: float = 0.0
    envelope: FactorEnvelope | None = None
    elements: list[LimitElement] = field(default_factory=list)

    def take(self, solution: Solution) -> None:
        """Transfer of the solution of an optimisation into this result."""
        self.factor, self.gap, self.unbalance = solution.factor, solution.gap, solution.unbalance
        self.worst = solution.worst
        count = len(self.joints.area)
        self.velocity, self.normal, self.shear = solution.velocity, solution.normal[:count], solution.shear[:count]
        for element in self.elements:
            first, count = count, count + len(element.force)
            element.force = solution.normal[first:count]

    @property
    def title(self) -> str:
        """The scene's title, or its name where it has none."""
        return self.scene.title or self.scene.name

    @property
    def moving(self) -> np.ndarray:
        """(B,) whether a block takes part in the mechanism, by the speed of its centre and its corners."""
        speed = self.speeds()
        return speed > MOVING * max(float(speed.max(initial=0.0)), 1e-300)

    def corner_velocities(self) -> tuple[np.ndarray, np.ndarray]:
        """Block (n,) and velocity (n, 3) of the corner of each face, in the order of `face_points`."""
        blocks = self.specimen.blocks
        block = np.repeat(blocks.face_block(), np.diff(blocks.face_start))
        return block, self.velocity_at(block, blocks.points[blocks.face_points])

    def velocity_at(self, block: np.ndarray, point: np.ndarray) -> np.ndarray:
        """(n, 3) of points (n, 3) m as parts of blocks (n,)."""
        arm = point - centroids(self.specimen.blocks)[block]
        return self.velocity[block, :3] + np.cross(self.velocity[block, 3:], arm)

    def speeds(self) -> np.ndarray:
        """(B,) of the fastest corner of each block."""
        block, velocity = self.corner_velocities()
        speed = np.zeros(self.specimen.blocks.count)
        np.maximum.at(speed, block, np.linalg.norm(velocity, axis=1))
        return speed

    def thrust(self) -> dict[str, np.ndarray]:
        """Column by column what each joint between units carries: as `resultants.csv` of a run, without `moment`."""
        force = -(self.normal[:, None] * self.joints.normal + self.shear)
        table = resultants(self.specimen.blocks, self.joints, {"limit": SimpleNamespace(force=force)})  # type: ignore[dict-item]
        return {name: table[name] for name in COLUMNS}

    def as_data(self) -> dict[str, Any]:
        """All of it as plain values for JSON, in SI."""
        top = max(float(self.speeds().max(initial=0.0)), 1e-300)
        thrust = {name: [_plain(x) for x in values.tolist()] for name, values in self.thrust().items()}
        content = {
            "scene": self.scene.name,
            "factor": self.factor,
            "unit": self.unit or "1",
            "is": "factor of safety" if self.is_safety else "peak force" if self.unit == "N" else "load factor",
            "of": self.words,
            "assumed": self.assumed,
            "bound": self.bound,
            "duality_gap": self.gap,
            "unbalance": self.unbalance,
            "worst_balanced": self.worst,
            "method": self.method,
            "contact_points": self.points,
            "blocks": self.specimen.blocks.count,
            "joints": len(self.joints.patch_start) - 1,
            "points": len(self.joints.area),
            "seconds": self.seconds,
            "remarks": self.remarks,
            "mechanism": {
                "scaled": "the fastest corner has speed 1",
                "moving_blocks": np.flatnonzero(self.moving).tolist(),
                "velocity": (self.velocity[:, :3] / top).tolist(),
                "spin": (self.velocity[:, 3:] / top).tolist(),
            },
            "thrust": {"units": COLUMNS, **thrust},
        }
        content |= {element.name: element.as_data() for element in self.elements}
        if self.with_dilation is not None:
            content |= {"with_dilation": _plain(self.with_dilation)}
        if self.steps is not None:
            content |= {"steps": self.steps, "excess": self.excess, "open": self.open}
        if self.least is not None:
            content |= {"least": self.least}
        if self.scene.vehicle is not None and not self.is_safety:
            content |= self._vehicle_data()
        if self.is_safety:
            content |= {"at": self.at}
        return content

    def _vehicle_data(self) -> dict[str, Any]:
        """Where the vehicle of the scene stands, and the factors at the other positions of one that travels."""
        assert self.scene.vehicle is not None
        content = {"position": self.scene.vehicle.position, "direction": self.scene.vehicle.directions[0]}
        if (envelope := self.envelope) is None:
            return content
        columns = {"direction": list(envelope.direction), "position": envelope.position.tolist()}
        factor = [_plain(x) for x in envelope.factor.tolist()]
        return content | {"envelope": {**columns, "factor": factor, "bound": envelope.bound}}


def set_of(specimen: Specimen, block: int) -> str:
    """The smallest named set that a block is in, "" where it is in none."""
    sizes = {name: len(members) for name, members in specimen.sets.items() if block in members}
    return min(sizes, key=lambda name: sizes[name], default="")


def _plain(value: Any) -> Any:
    """None for what is not a number."""
    return None if isinstance(value, float) and not np.isfinite(value) else value
