"""The step of large displacement: as Fig. 2 of the paper, with bonds in frames that turn and patches that are detected.

A scene of small displacement compiles nothing of this file.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from masonry.jit.compiled_parts import Call, CompiledPart, StepCalls
from masonry.jit.records import unpack
from masonry.kernels import bonds as bonded
from masonry.kernels import gathering
from masonry.kernels.bonds import Bonds
from masonry.kernels.gathering import Members
from masonry.kernels.step import displacing, driving, kicking, sweeping
from masonry.kinematics.shared import SPARE, TRAVEL
from masonry.patches.arrays import Near
from masonry.patches.branches import NO_DASHPOTS, Dashpots
from masonry.patches.press import press
from masonry.patches.press_deforming import press_deforming
from masonry.patches.refreshing import count_travel, looking


def step(
    dt: float, damping: Any, groups: tuple, contacts: tuple, bonds: Bonds, bodies: Sequence[Any],
    drives: Sequence[Any], near: Near, members: Members | None, shared: np.ndarray, dashpots: Dashpots = NO_DASHPOTS,
    elements: Sequence[Call] = (),
) -> StepCalls:  # fmt: skip
    """The step of large displacement, for `driver.drive`: it ends where room runs out.

    Arguments as of kernels.step.step; contacts hold displacements and forces in the frames of the bonds.
    near     what blocks meet
    members  where some blocks deform, else None
    elements  calls that compute their forces
    """
    *_, local, force = contacts
    motion, sweeps = near.motion, sweeping(None, groups, contacts, dashpots)
    kicks = [*kicking(None, bodies, dt, damping, shared, bonds.force, bonds.u), *driving(bodies, drives, shared)]
    kicks = [*elements, *kicks]
    moves, some_bonds = displacing(None, bodies, dt, bonds.u), len(bonds.runs) > 0
    begins = [_travel.of(motion, dt, shared)]
    if members is None:
        parting = [_part_rigid.of(bonds, motion, local)] if some_bonds else []
        pushing = [_push_rigid.of(bonds, motion, local, force)] if some_bonds else []
        rest = [*moves, *parting, *sweeps, press.of(near, dt), *pushing, *kicks]
        return StepCalls([], begins, [looking(near, shared)], rest)
    places = of_each_kind(places_of, bodies, motion, members, bonds)
    velocities = of_each_kind(velocities_of, bodies, motion, members)
    parting = [_to_frames.of(bonds, local)] if some_bonds else []
    pushing = [_from_frames.of(bonds, force)] if some_bonds else []
    patches = [press_deforming.of(near, dt), *of_each_kind(patch_forces_on, bodies, motion, members)]
    rest = [*moves, *places, *parting, *sweeps, *pushing, *patches, *kicks]
    return StepCalls(places, [*velocities, *begins], [looking(near, shared)], rest)


def of_each_kind(part: CompiledPart, bodies: Sequence[Any], *arguments: Any) -> list[Call]:
    """A call for the bodies of each kind that there are: those of the other kinds are None in it."""
    present = [kind for kind, body in enumerate(bodies) if body is not None]
    return [
        part.of(*arguments, *(body if kind == present_kind else None for kind, body in enumerate(bodies)))
        for present_kind in present
    ]


@CompiledPart
def velocities_of(record):
    """Gather the velocities of the bodies of one kind, the others being None."""
    motion, members, rigid, affine, tets = unpack(record)
    gathering.gather_velocities(motion, members, rigid, affine, tets)


@CompiledPart
def places_of(record):
    """Gather their places."""
    motion, members, bonds, rigid, affine, tets = unpack(record)
    gathering.gather_places(motion, members, rigid, affine, tets, bonds)


@CompiledPart
def patch_forces_on(record):
    """Hand them the forces of the patches."""
    motion, members, rigid, affine, tets = unpack(record)
    gathering.hand_over(motion, members, rigid, affine, tets)


@CompiledPart
def _travel(record):
    motion, dt, shared = unpack(record)
    shared[TRAVEL] = 2.0 * count_travel(motion, dt, motion.strain)
    shared[SPARE] -= shared[TRAVEL]


@CompiledPart
def _part_rigid(record):
    bonds, motion, local = unpack(record)
    bonded.part_rigid(bonds, motion, local)


@CompiledPart
def _push_rigid(record):
    bonds, motion, local, force = unpack(record)
    bonded.push_rigid(bonds, motion, local, force)


@CompiledPart
def _to_frames(record):
    bonds, local = unpack(record)
    bonded.to_frames(bonds, local)


@CompiledPart
def _from_frames(record):
    bonds, force = unpack(record)
    bonded.from_frames(bonds, force)
