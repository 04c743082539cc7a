"""Optional parts of a step, and how a model comes to contain each of them without its doing anything.

The reduced model is what a scene compiles to that does not use the part. The full one holds the same numbers and the
code of the part: zero loads, a dilation of angle zero, axes that are turned by nothing, ...
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from masonry.assembly.assemble import Assembly, assemble
from masonry.configuration.chunk import Chunk
from masonry.kinematics.motion import Guided
from masonry.loading.scheduled import Program
from masonry.model.body_arrays import Bodies, Groups, group_state, in_rows, initial_state
from masonry.model.model import Model
from masonry.timeloop.compiled_step import advance_model
from verification.convergence.joint_in_tension import SCENE as PULLED
from verification.scene_runs import load

STEPS = 4000
WALL: dict[str, Any] = {
    "specimen.courses": 2,
    "specimen.divisions": [4, 2],
    "drive.displacement": "0.1 mm",
    "drive.steps": STEPS,
    "contact.unit_unit.dilation_angle": "0 deg",
}
STRONG = {
    f"contact.{group}.{key}": value
    for group in ("unit_unit", "within_units")
    for key, value in (("tensile_strength", "1 TPa"), ("cohesion", "1 TPa"), ("fracture_energy_mode_1", "1 TN/m"))
}
ELASTIC = {f"contact.{group}.law": "elastic" for group in ("unit_unit", "within_units")}


@dataclass(frozen=True)
class Part:
    """A part that can be left out.

    reduced, full  keys of the scene for either run
    change         brings the part into the model of the full run (or takes it out of the reduced one: `drop`)
    same           whether the arrays of both models correspond, so that one can take the state of the other
    """

    name: str
    scene: str = "wallette-mode-1"
    reduced: dict[str, Any] = field(default_factory=lambda: WALL)
    full: dict[str, Any] = field(default_factory=lambda: WALL)
    change: Callable[[Model], None] | None = None
    drop: Callable[[Model], None] | None = None
    same: bool = True

    def models(self) -> tuple[Assembly, Assembly]:
        """(reduced, full), at rest."""
        both = [assemble(load(self.scene, keys)) for keys in (self.reduced, self.full)]
        for assembly, change in zip(both, (self.drop, self.change), strict=True):
            if change is not None:
                change(assembly.model)
        return both[0], both[1]


def march(assembly: Assembly) -> np.ndarray:
    """Take all steps of a program in one call: (steps,) force of the drive, N."""
    plan = assembly.plan
    assert isinstance(plan, Program)
    drive_force = np.zeros(plan.steps)
    advance_model(assembly.model, Chunk(plan.dead_load, plan.speed, False), 1, 0, plan.steps, drive_force)
    return drive_force


def few_steps(assembly: Assembly, steps: int) -> list[np.ndarray]:
    """Take some more at the drive's highest speed: force of the drive (N), displacements (m), velocities (m/s)."""
    model, plan = assembly.model, assembly.plan
    assert isinstance(plan, Program)
    speed = np.full(steps + 1, plan.speed[np.argmax(np.abs(plan.speed))])
    drive_force = np.zeros(steps)
    advance_model(model, Chunk(np.zeros(steps + 1), speed, False), 1, 0, steps, drive_force)
    return [drive_force, model.contacts.u, *(body.v for body in model.bodies if body is not None)]


def put_in_the_state_of(other: Model, model: Model) -> None:
    """Give a model the place, speed, forces and contact state of another one of the same blocks."""
    for body, its in zip(model.bodies, other.bodies, strict=True):
        for name in ("q", "v", "contact", "hold"):
            if body is not None and hasattr(body, name):
                getattr(body, name)[...] = getattr(its, name)
    for array, its in ((model.contacts.u, other.contacts.u), (model.contacts.force, other.contacts.force)):
        array[...] = its
    for name, its in other.state._asdict().items():
        array = getattr(model.state, name)
        if array is not None and its is not None:
            array[...] = its


def _bodies(model: Model, values: Callable[[Any], dict[str, Any]]) -> None:
    model.bodies = Bodies(*(None if body is None else body._replace(**values(body)) for body in model.bodies))


def load_with_nothing(model: Model) -> None:
    """Dead loads of zero."""
    _bodies(model, lambda body: {"load": in_rows(np.zeros(body.v.shape))})


def expect_nothing(model: Model) -> None:
    """A guided drive that expects no motion, and has no viscosity against it."""
    _bodies(model, lambda body: {"guess": in_rows(np.zeros(body.v.shape))})
    model.damping = Guided(0.0, float(model.damping or 0.0))  # type: ignore[arg-type]


def turn_by_nothing(model: Model) -> None:
    """Principal axes that are those of the space."""
    _bodies(model, lambda body: {"axes": np.tile(np.eye(3), (len(body.v), 1, 1))})


def book_nothing(model: Model) -> None:
    """No energy ledger."""
    _bodies(model, lambda body: {"work": None})


def dilate_by_nothing(model: Model) -> None:
    """Dilation of angle zero in all groups that can crack."""
    law_parameters, joint_properties, _, bounds = model.groups
    joint_properties = tuple(
        i if i.tensile_strength is None else i._replace(tan_dilation=0.0, dilation_cutoff=1.0) for i in joint_properties
    )
    model.state = initial_state(model.group, list(joint_properties))
    model.groups = Groups(
        law_parameters, joint_properties, tuple(group_state(model.state, i) for i in joint_properties), bounds
    )


def damp_by_nothing(model: Model) -> None:
    """Local damping of zero."""
    model.damping = 0.0


def split(model: Model) -> None:
    """Each contact group as two, of the same law and numbers."""
    law_parameters, joint_properties, states, bounds = model.groups
    middle = (bounds[:-1] + bounds[1:]) // 2
    twice = np.sort(np.concatenate([bounds, middle])).astype(bounds.dtype)
    law_parameters, joint_properties, states = (
        tuple(x for x in of for _ in range(2)) for of in (law_parameters, joint_properties, states)
    )
    model.groups = Groups(law_parameters, joint_properties, states, twice)


def glued(kind: str) -> dict[str, Any]:
    """Plates of another kinematics that are held altogether; the specimen between them is rigid. In real time: scaled
    masses would depend on the plates.
    """
    settings = {"kinematics": {"default": "rigid", "plates": kind}, "drive.steps": STEPS, "drive.displacement": "30 um"}
    settings |= {"solver.masses": "real", "solver.time_step": "5e-6 s", "solver.damping": 0}
    stuff = {"young_modulus": "210 GPa", "poisson_ratio": 0.3}
    return (
        settings | {f"material.plates.{key}": value for key, value in stuff.items()} | {"specimen.mesh_size": "100 mm"}
    )


UNDAMPED = WALL | {"solver.damping": 0}
PARTS = (
    Part("dead loads (gravity, traction)", change=load_with_nothing),
    Part("dilation", change=dilate_by_nothing),
    Part("damping", reduced=UNDAMPED, full=UNDAMPED, change=damp_by_nothing),
    Part("energy ledger", drop=book_nothing),
    Part("strength and softening", reduced=WALL | ELASTIC, full=WALL | STRONG, same=False),
    Part("more contact groups", change=split),
    Part("expected motion of a guided drive", change=expect_nothing),
    Part("turned principal axes", change=turn_by_nothing),
    Part("affine blocks", PULLED, glued("rigid"), glued("affine"), same=False),
    Part("tets", PULLED, glued("rigid"), glued("tets"), same=False),
)
