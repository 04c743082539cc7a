"""Models for timing, and all that the benchmarks know of the layout of their arrays."""

from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass

import numba
import numpy as np

from geometry.blocks import Blocks, Joints, TetMesh
from masonry.configuration.chunk import Chunk
from masonry.configuration.configuration import configuration_of
from masonry.jit.compiler import jit
from masonry.kernels.contact import sweep
from masonry.kinematics.motion import Guided
from masonry.laws.brittle import Brittle
from masonry.laws.exponential import Exponential
from masonry.laws.state import JointProperties
from masonry.model import loads
from masonry.model.body_arrays import Bodies
from masonry.model.layout import KINDS, Material, lay_out
from masonry.model.model import Model, Stepping, build, sort_by_group

STONE = Material(density=1900.0, young_modulus=16.7e9, poisson_ratio=0.2)
JOINT = JointProperties(167e9, 69.6e9, 0.1e6, 0.15e6, 1.0, 1.5e3, 0.7265, combined=1.0)
SOFTENING = Exponential(5.0, 15.0), JOINT


def model_of(
    blocks: Blocks,
    joints: Joints,
    mesh: TetMesh | None = None,
    *,
    law: tuple = SOFTENING,
    kind: str = "rigid",
    damping: float = 0.8,
    loaded: bool = False,
    guided: bool = False,
    ledger: bool = True,
) -> Model:
    """A model in which nothing is held; the same law in all contact groups."""
    names, _, joints = sort_by_group(blocks, joints)
    layout = lay_out(blocks, dict.fromkeys(blocks.groups, kind), mesh)
    conditions = loads.no_conditions(layout)
    if loaded:
        loads.add_gravity(layout, conditions.load, np.full(blocks.count, STONE.density), np.zeros(3))
    stepping = Stepping(damping=Guided(0.0, damping) if guided else damping)
    materials = dict.fromkeys(blocks.groups, STONE)
    model = build(blocks, joints, materials, dict.fromkeys(names, law), stepping, conditions, layout)
    if not ledger:
        replace_bodies(model, work=None)
    return model


def stepping(model: Model, steps: int, threads: int = 1) -> Callable[[], None]:
    """A call that takes so many steps, without a drive and with the whole dead load."""
    chunk, drive_force = Chunk(np.ones(steps + 1), np.zeros(steps + 1), row=False), np.zeros(steps)
    configuration = configuration_of(model)

    def take() -> None:
        if threads > 1:
            numba.set_num_threads(threads)
        configuration.advance(chunk, threads, 0, steps, drive_force)

    return take


def replace_bodies(model: Model, **values) -> None:
    """Fields of all bodies, such as work=None."""
    model.bodies = Bodies(*(None if body is None else body._replace(**values) for body in model.bodies))


def set_velocity(model: Model, velocity: np.ndarray) -> None:
    """(rows, n) velocities of the first n dofs of each block or node; m/s."""
    for body in model.bodies:
        if body is not None:
            body.v[:, : velocity.shape[1]] = velocity


def make_unstoppable(model: Model) -> None:
    """Forces hardly change the velocities any more: blocks move as set, and everything is computed as ever."""
    for body in model.bodies:
        if body is not None:
            body.dt_over_mass[...] *= 1e-12


def turn_axes(model: Model) -> None:
    """Blocks compute as if their principal axes were turned."""
    replace_bodies(model, axes=np.tile(np.eye(3), (model.blocks.count, 1, 1)))


def used(model: Model) -> set[str]:
    """Optional parts that the step of a model contains, by the names of test_left_out.py."""
    bodies = [body for body in model.bodies if body is not None]
    law_parameters, joint_properties = model.groups[:2]
    parts = {
        "dead loads": any(body.load is not None for body in bodies),
        "dilation": any(i.tan_dilation is not None for i in joint_properties),
        "damping": model.damping is not None,
        "energy ledger": any(body.work is not None for body in bodies),
        "softening": any(
            i.tensile_strength is not None and not isinstance(s, Brittle)
            for s, i in zip(law_parameters, joint_properties, strict=True)
        ),
        "second law": len(law_parameters) > 1,
        "expected motion": any(body.guess is not None for body in bodies),
        "turned axes": any(getattr(body, "axes", None) is not None for body in bodies),
        "tets": model.bodies.tets is not None,
    }
    return {name for name, there in parts.items() if there}


def moved(model: Model) -> np.ndarray:
    """(rows, 3) displacement of every block, or of every node of tets."""
    for kind, body in zip(KINDS, model.bodies, strict=True):
        if body is not None:
            return model.contacts.u[: len(body.v), :3] if kind == "tets" else body.q[:, :3]
    raise ValueError("no bodies")


def works(model: Model) -> np.ndarray:
    """(3,) J: of contacts, damping, and external forces."""
    return sum(body.work.sum(axis=0) for body in model.bodies if body is not None)


@jit
def _shove(rounds, sides, by, u, sweeps, parameters, joint, state, normal, area, force):
    for _ in range(rounds):
        for c in range(len(by)):
            b = sides[c, 1]
            u[b, 0] += by[c, 0]
            u[b, 1] += by[c, 1]
            u[b, 2] += by[c, 2]
        if sweeps:
            sweep(
                None, parameters, joint, state, 0, len(by), sides, normal, area, u, force, None, None, None, None, None
            )


def sweeping(model: Model, by: np.ndarray, rounds: int, sweeps: bool = True) -> Callable[[], None]:
    """A call that moves side b of every contact by (C, 3) m, then sweeps over the contacts (or not), so many times."""
    law_parameters, joint_properties, states, _ = model.groups
    sides, normal, area, u, force = model.contacts

    def take() -> None:
        _shove(rounds, sides, by, u, sweeps, law_parameters[0], joint_properties[0], states[0], normal, area, force)

    return take


def forces(model: Model) -> np.ndarray:
    """(C, 3) N, of every contact."""
    return model.contacts.force[:, :3]


def history(model: Model) -> np.ndarray:
    """(C, n) what every contact remembers, side by side; in the order of the model's joints."""
    arrays = [array for array in model.state if array is not None]
    return np.concatenate([array.reshape(len(array), -1) for array in arrays], axis=1)


def evolving(model: Model, take: Callable[[], None]) -> float:
    """Share of the contacts whose history a call of `take` changes."""
    before = history(model).copy()
    take()
    return float((history(model) != before).any(axis=1).mean())


def size_of(*parts: object) -> int:
    """Bytes of all arrays in some tuples, lists and dataclasses, each counted once."""
    owners = {id(base): base for array in _arrays(parts) for base in [_owner(array)]}
    return sum(base.nbytes for base in owners.values())


def _owner(array: np.ndarray) -> np.ndarray:
    while isinstance(array.base, np.ndarray):
        array = array.base
    return array


def _arrays(part: object) -> Iterator[np.ndarray]:
    if isinstance(part, np.ndarray):
        yield part
    elif isinstance(part, dict):
        yield from _arrays(tuple(part.values()))
    elif isinstance(part, tuple | list):
        for item in part:
            yield from _arrays(item)
    elif is_dataclass(part):
        for field in fields(part):
            yield from _arrays(getattr(part, field.name))


def step_bytes(model: Model) -> int:
    """Bytes of the arrays that a step reads and writes."""
    return size_of(model.groups, model.contacts, model.bodies, model.drives)
