"""Small displacement: contacts are those of the undeformed shape, and displacements are linear in rotations."""

from functools import cached_property

import numpy as np

from masonry.configuration.chunk import Chunk, begin_at, with_calls
from masonry.configuration.contacts import (
    ContactsLook,
    pairs_of_contacts,
    stiffness_of_contacts,
    sums_of_blocks,
)
from masonry.configuration.joint_forces import summed_in_runs
from masonry.configuration.written import written_arrays
from masonry.elements.element import acting_on_blocks, stiffened, those_that_take, with_elements
from masonry.elements.joints.contact_dashpots import ContactDashpots
from masonry.elements.joints.joint_crushing import crushing_of_contacts
from masonry.elements.joints.joint_patches import NoPatches
from masonry.jit.compiled_parts import StepCalls
from masonry.kernels.driver import Stepper
from masonry.kernels.step import step
from masonry.model.model import Model

LEAP = 1e-2
"""A dof that moves by more than this share of the smallest block in one step is not a motion but an instability."""


class SmallDisplacement:
    """Answers to configuration.py for small displacement."""

    any_size, leap = False, LEAP

    def __init__(self, model: Model) -> None:
        self.model, self.stepper, self.contacts = model, Stepper(), ContactsLook(model)
        self.crushing, self.patches = crushing_of_contacts(model), NoPatches()
        self.of_joints = those_that_take((ContactDashpots(model), self.crushing))

    def advance(self, chunk: Chunk, threads: int, first: int, steps: int, drive_force: np.ndarray) -> None:
        model = self.model
        made_of = threads, model.dt, model.swept, model.groups, model.contacts, model.bodies, model.acting
        self.stepper.prepare(lambda shared: self.program(threads, shared), model.damping, *made_of)
        begin_at(model.elements, chunk, first)
        self.stepper.take(first, steps, chunk.dead_load, chunk.speed, drive_force)

    def program(self, threads: int, shared: np.ndarray) -> StepCalls:
        model, parallel = self.model, True if threads > 1 else None
        of_elements = [element.calls(model, shared) for element in model.elements]
        forces = [call for calls in of_elements for call in calls.forces]
        made_of = parallel, model.dt, model.damping, *model.step_arguments()
        calls = with_calls(step(*made_of, shared, model.acting, forces, model.force), of_elements)
        calls.of_rows = self.contacts.calls()
        return calls

    def after_row(self) -> None:
        pass

    def look_at_contacts(self, seen: np.ndarray) -> float:
        stored, seen[...] = self.contacts.look(), self.contacts.seen
        return stored

    def joint_forces(self) -> np.ndarray:
        return np.array(self.model.contacts.force)

    def forces_on_blocks(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        force, (block, arm) = self.model.contacts.force.T, self._sides
        acting = acting_on_blocks(self.model.elements)
        if acting is None:
            return block, np.concatenate([force, -force], axis=1), arm
        lever = acting.place - self.model.layout.centroid[acting.block]
        force = np.concatenate([force, -force, acting.force.T], axis=1)
        return np.concatenate([block, acting.block]), force, np.concatenate([arm, lever.T], axis=1)

    def forces_of_pairs(self) -> tuple[np.ndarray, np.ndarray]:
        joints = self.model.joints
        return summed_in_runs(np.column_stack([joints.block_a, joints.block_b]), self.model.contacts.force)

    @cached_property
    def _sides(self) -> tuple[np.ndarray, np.ndarray]:
        """The block (2 C,) of both sides of all contacts, and the arm (3, 2 C) m."""
        joints = self.model.joints
        block = np.concatenate([joints.block_a, joints.block_b])
        arm = np.concatenate([joints.point, joints.point]) - self.model.layout.centroid[block]
        return block, arm.T.copy()

    def pressed(self) -> np.ndarray:
        forces = np.abs(self.model.contacts.force).sum(axis=1)
        return with_elements(sums_of_blocks(self._pairs, forces, self.model.blocks.count), self.model.elements)

    @cached_property
    def _pairs(self) -> np.ndarray:
        return pairs_of_contacts(self.model)

    def stiffness(self) -> np.ndarray:
        return self._stiffness

    @cached_property
    def _stiffness(self) -> np.ndarray:
        of_contacts = sums_of_blocks(self._pairs, stiffness_of_contacts(self.model), self.model.blocks.count)
        return stiffened(of_contacts, self.model.elements)

    def rounding(self, kinetic: float) -> float:
        return 0.0

    def advice(self, leap: float) -> str:
        return (
            "The time step is within its proven bound, so the drive is too fast (take more steps, a lower rate or a "
            "smaller accuracy), a load too large, or a contact too soft for this specimen"
        )

    def written(self) -> dict[str, np.ndarray]:
        return written_arrays(self.model, self.of_joints)

    def make_room_for(self, saved: dict[str, np.ndarray]) -> None:
        pass
