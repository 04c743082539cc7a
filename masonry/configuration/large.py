"""Large displacement: blocks turn and deform as they like, bonds turn with them, and contacts are found anew."""

from functools import cached_property
from math import sqrt

import numpy as np

from masonry.configuration.chunk import Chunk, begin_at, with_calls
from masonry.configuration.contacts import (
    ContactsLook,
    pairs_of_contacts,
    stiffness_of_contacts,
    sums_of_blocks,
)
from masonry.configuration.joint_forces import BearingPoints, JointForces, forces_of_pairs, forces_on_blocks, moved
from masonry.configuration.retirement import retire
from masonry.configuration.room import make_room, make_room_for
from masonry.configuration.written import joined, written_arrays, written_in_large
from masonry.elements.element import stiffened, those_that_take
from masonry.elements.joints.contact_dashpots import ContactDashpots
from masonry.elements.joints.joint_crushing import crushing_of_joints
from masonry.elements.joints.joint_patches import Patches
from masonry.jit.compiled_parts import StepCalls
from masonry.kernels.driver import Stepper
from masonry.kernels.large_step import step
from masonry.model.large.meeting import Large
from masonry.model.model import Model
from masonry.patches.arrays import AREA

ROUNDED = 1e-6
"""Of the momentum over a time step: forces below are measured by it. Rounding makes 1e-16 of it."""


class LargeDisplacement:
    """Answers to configuration.py for large displacement. What leaps may be a motion, but what it meets is not told
    well."""

    any_size, leap = True, 1e-1

    def __init__(self, model: Model, large: Large) -> None:
        self.model, self.parts, self.stepper, self.contacts = model, large, Stepper(), ContactsLook(model)
        self.crushing, self.patches = crushing_of_joints(model, large), Patches(large)
        self.of_joints = those_that_take((self.patches, ContactDashpots(model), self.crushing))
        self.bearing = BearingPoints(large.near)

    def advance(self, chunk: Chunk, threads: int, first: int, steps: int, drive_force: np.ndarray) -> None:
        """Raises Stopped where blocks overlap deeply at once."""
        model, large, done = self.model, self.parts, 0
        while done < steps or steps == 0:
            made_of = model.dt, model.swept, model.groups, model.contacts, model.bodies, large.near, model.acting
            self.stepper.prepare(lambda shared: self.program(threads, shared), model.damping, *made_of)
            begin_at(model.elements, chunk, first + done)
            done += self.stepper.take(first + done, steps - done, chunk.dead_load, chunk.speed, drive_force[done:])
            if done == steps:
                return
            make_room(model, large)

    def program(self, threads: int, shared: np.ndarray) -> StepCalls:
        model, large = self.model, self.parts
        groups, contacts, bodies, drives = model.step_arguments()
        of_elements = [element.calls(model, shared) for element in model.elements]
        forces = [call for calls in of_elements for call in calls.forces]
        calls = step(
            *(model.dt, model.damping, groups, contacts, large.bonds, bodies, drives),
            *(large.near, large.members, shared, model.acting, forces),
        )
        calls = with_calls(calls, of_elements)
        calls.of_rows = [*self.contacts.calls(), *self.patches.calls_of_rows(), self.bearing.of(large.near)]
        return calls

    def after_row(self) -> None:
        retire(self.model, self.parts, self.crushing)

    def look_at_contacts(self, seen: np.ndarray) -> float:
        stored, seen[...] = self.contacts.look(), self.contacts.seen
        self._look_at_parted_points(seen)
        return stored + self.patches.elastic()

    def _look_at_parted_points(self, seen: np.ndarray) -> None:
        """How far points of joints without bonds have parted, in the frame of side a; they carry nothing."""
        model, bonds, joints, gone = self.model, self.parts.bonds, self.model.joints, ~self.model.alive
        if self.parts.members is None:
            a, b = (moved(model, self.parts, joints.point[gone], of[gone]) for of in (joints.block_a, joints.block_b))
        else:  # points of blocks that deform move with them at every step
            a, b = bonds.u[bonds.rows[gone].T.astype(np.int64)]
        parted = np.einsum("cji,cj->ci", bonds.frames[joints.block_a[gone]], b - a)
        normal = model.contacts.normal[gone]
        opening = np.einsum("ci,ci->c", parted, normal)
        seen[0, gone] = opening
        seen[1, gone] = np.linalg.norm(parted - opening[:, None] * normal, axis=1)
        seen[2:, gone] = 0.0

    @cached_property
    def _joint_forces(self) -> JointForces:
        return JointForces(self.model, self.parts, self.bearing.take)

    def joint_forces(self) -> np.ndarray:
        return self._joint_forces.take()

    def forces_on_blocks(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return forces_on_blocks(self.model, self.parts, self.bearing.take(self.parts.near))

    def forces_of_pairs(self) -> tuple[np.ndarray, np.ndarray]:
        return forces_of_pairs(self.model, self.parts, self.bearing.take(self.parts.near))

    def pressed(self) -> np.ndarray:
        block, forces, _ = self.forces_on_blocks()
        return np.asarray(np.bincount(block, np.abs(forces).sum(axis=0), self.model.blocks.count))

    @cached_property
    def _bonds(self) -> tuple[np.ndarray, np.ndarray]:
        """Both blocks (C, 2) of each bond, and its stiffness (C,) N/m."""
        return pairs_of_contacts(self.model), stiffness_of_contacts(self.model)

    def stiffness(self) -> np.ndarray:
        near, alive, (bonded, stiffness) = self.parts.near, self.model.alive, self._bonds
        pairs, points = near.pairs, near.points
        touching = np.flatnonzero(pairs.slot[: pairs.number[0]] >= 0)
        slot = pairs.slot[touching]
        area = points.quads[:, slot, AREA].transpose(1, 0, 2).reshape(len(slot), points.quads[:, 0, AREA].size)
        area = np.where(np.arange(area.shape[1]) < points.number[slot, None], area, 0.0).sum(axis=1)
        pair = np.concatenate([bonded[alive], near.pieces.block[pairs.body[touching]]])
        patches = near.rules.normal_stiffness[pairs.law[touching]] * area
        of_contacts = sums_of_blocks(pair, np.append(stiffness[alive], patches), self.model.blocks.count)
        return stiffened(of_contacts, self.model.elements)

    def rounding(self, kinetic: float) -> float:
        mass = sum(float(of_kind[:, 0].sum()) for of_kind in self.model.masses.values())
        return ROUNDED * sqrt(2.0 * mass * max(kinetic, 0.0)) / self.model.dt

    def advice(self, leap: float) -> str:
        model = self.model
        size = leap / self.leap
        return (
            f"In large displacement nothing may move by more than {self.leap:g} of the smallest block "
            f"({size:.3g} m) in one step ({model.dt:.3g} s), that is {leap / model.dt:.4g} m/s. Where it "
            "is to be as fast, take a smaller solver.time_step; where not, a velocity or a load is too large"
        )

    def written(self) -> dict[str, np.ndarray]:
        return joined(written_arrays(self.model, self.of_joints), written_in_large(self.model, self.parts))

    def make_room_for(self, saved: dict[str, np.ndarray]) -> None:
        make_room_for(self.parts, saved)
