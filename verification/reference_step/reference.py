"""The arrays of the hand-written steps, made from the geometry of a model and its masses, not from its arrays."""

from collections.abc import Callable

import numpy as np

from masonry.model.layout import tet_gradients, tet_volumes
from masonry.model.model import Model
from verification.reference_step import contacts
from verification.reference_step.models import STONE, size_of
from verification.reference_step.steps import rigid_step, tet_step


def padded(values: np.ndarray) -> np.ndarray:
    """(n, 3) in rows of four."""
    return np.ascontiguousarray(np.pad(values, ((0, 0), (0, 1))))


def _by_row(row_a: np.ndarray, row_b: np.ndarray, rows: int) -> tuple[np.ndarray, np.ndarray]:
    """Sides of every row: where they start, and 2 * contact + (1 on side b)."""
    row = np.stack([row_a, row_b], axis=1).ravel()
    code = np.argsort(row, kind="stable")
    return np.searchsorted(row[code], np.arange(rows + 1)).astype(np.uint32), code.astype(np.uint32)


class ReferenceStep:
    """A model once more for the hand-written step: of rigid blocks with axes x, y, z, or of tets, with one law."""

    def __init__(self, model: Model, law: str = "exponential", damped: bool = True, booked: bool = True) -> None:
        self.model, self.dt, self.xi = model, model.dt, model.damping if damped else 0.0
        joints, count = model.joints, len(model.joints.area)
        parameters, joint = model.groups.parameters[0], model.groups.properties[0]
        i = joint
        self.law = (i.normal_stiffness, i.shear_stiffness)
        self.past, self.slip, self.dissipated = (np.zeros((count if law != "elastic" else 0, 4)) for _ in range(3))
        if law != "elastic":
            limits = i.tensile_strength, i.cohesion, i.tan_friction, i.residual_cohesion, i.tan_residual_friction
            self.law += limits + ((parameters.G_I, parameters.G_II) if law == "exponential" else (0.0, 1.0))
            self.past[:] = i.tensile_strength / i.normal_stiffness, 1.0, 1.0, i.normal_stiffness
        self.frame = np.column_stack([joints.normal, joints.area])
        self.force = np.zeros((count, 4))
        by_hand = getattr(contacts, law)
        self.body = self._tets() if model.layout.mesh is not None else self._rigid()
        self.step = (rigid_step if model.layout.mesh is None else tet_step)(by_hand, damped, booked)
        self.contacts = by_hand

    def _rigid(self) -> tuple:
        layout, joints = self.model.layout, self.model.joints
        blocks = len(layout.volume)
        start, code = _by_row(joints.block_a, joints.block_b, blocks)
        block = np.stack([joints.block_a, joints.block_b], axis=1).ravel()[code]
        arm = padded(joints.point[code >> 1] - layout.centroid[block])
        self.ends = np.argsort(code).astype(np.uint32).reshape(-1, 2)
        self.u = np.zeros((len(code), 4))
        self.q, self.v, self.pace = (np.zeros((2 * blocks, 4)) for _ in range(3))
        mass = self.model.masses["rigid"]
        self.pace[:, :3] = np.divide(self.dt, mass, out=np.zeros_like(mass), where=mass > 0).reshape(-1, 3)
        before, work = np.zeros((2 * blocks, 8)), np.zeros((2 * blocks, 8))
        return self.q, self.v, self.pace, before, work, start, code, arm

    def _tets(self) -> tuple:
        layout, joints = self.model.layout, self.model.joints
        mesh = layout.mesh
        assert mesh is not None
        nodes = len(mesh.nodes)
        start, code = _by_row(joints.node_a, joints.node_b, nodes)
        self.ends = np.stack([joints.node_a, joints.node_b], axis=1).astype(np.uint32)
        self.u, self.v, self.pace, inner = (np.zeros((nodes, 4)) for _ in range(4))
        self.q = self.u
        mass = self.model.masses["tets"]
        self.pace[:, :3] = np.divide(self.dt, mass, out=np.zeros_like(mass), where=mass > 0)
        slope = tet_gradients(mesh)[:, 1:].reshape(-1, 9) * np.sqrt(tet_volumes(mesh))[:, None]
        lame = np.tile(STONE.lame(), (len(layout.volume), 1))
        starts = mesh.node_start.astype(np.uint32), mesh.tet_start.astype(np.uint32)
        before, work = np.zeros((nodes, 8)), np.zeros((nodes, 8))
        return self.v, self.pace, before, work, start, code, *starts, mesh.tets.astype(np.uint32), slope, lame, inner

    def stepping(self, steps: int) -> Callable[[], None]:
        """A call that takes so many steps."""
        memory = self.past, self.slip, self.dissipated

        def take() -> None:
            self.step(steps, self.dt, self.xi, self.law, self.ends, self.frame, self.u, self.force, *memory, *self.body)

        return take

    def sweeping(self, by: np.ndarray, rounds: int, sweeps: bool = True) -> Callable[[], None]:
        """A call that so many times moves side b of every contact by (C, 3) m, and sweeps over them (or not)."""
        shove, arrays = contacts.shoving(self.contacts), (self.ends, self.frame, self.u, self.force)

        def take() -> None:
            shove(rounds, by, sweeps, self.law, *arrays, self.past, self.slip, self.dissipated)

        return take

    def set_velocity(self, velocity: np.ndarray) -> None:
        """(rows, 3) of nodes, or (B, 6) of rigid blocks; m/s."""
        self.v[:, :3] = velocity.reshape(-1, 3)

    def make_unstoppable(self) -> None:
        """As the model's: see models.py."""
        self.pace *= 1e-12

    def size(self) -> int:
        """Bytes of its arrays."""
        return size_of(self.ends, self.frame, self.u, self.force, self.past, self.slip, self.dissipated, self.body)
