"""Rigid bricks that fly and hit, made by hand, and small models of large bodies on springs that join their contacts."""

import numpy as np

from masonry.configuration.energy import present
from masonry.kernels.driver import Stepper
from masonry.kernels.step import step
from masonry.kinematics import deforming, deforming_tets, turning
from masonry.kinematics.dispatch import move, update_positions
from masonry.kinematics.turning import Turning
from masonry.model.body_arrays import Bodies, in_rows
from masonry.model.large.bodies import large
from masonry.model.model import Model

MASS = 2000 * 0.24 * 0.115 * 0.06
INERTIA = np.array([0.0046437, 0.0168912, 0.0195477])
"""kg and kg m2 of the brick of 0.24 x 0.115 x 0.06 m and 2000 kg/m3."""
ALL_OF_IT = 1.0, 1.0, 0.0, 0.0
"""Clock of a step with the whole dead load and no drive."""


def turn(axis: int, angle: float) -> np.ndarray:
    """Rotation (3, 3) about x, y or z by an angle in rad."""
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(3)
    matrix[i, i] = matrix[j, j] = np.cos(angle)
    matrix[j, i] = np.sin(angle)
    matrix[i, j] = -matrix[j, i]
    return matrix


def brick(dt: float, arms=(), free=(True,) * 6, **fields) -> Turning:
    """One brick at rest with a contact side at each arm; free: which of its six movements are."""
    rows = {name: in_rows(np.zeros((1, 6))) for name in ("q", "v", "contact", "hold")}
    masses = np.array([[MASS, MASS, MASS, *INERTIA]])
    values = {
        "dt_over_mass": in_rows(np.where(np.array([free]), dt / masses, 0.0)),
        "frame": np.eye(3)[None].copy(),
        "momentum": np.zeros((1, 3)),
        "inertia": INERTIA[None].copy(),
        "start": np.array([0, len(arms)], dtype=np.uint32),
        "code": np.arange(0, 2 * len(arms), 2).astype(np.uint32),
        "arm": np.array(arms, dtype=float).reshape(-1, 3),
        "first_point": np.uint32(0),
        "work": np.zeros((1, 4)),
    }
    return Turning(**rows, **values | fields)


def fly(body: Turning, dt: float, steps: int, damping=None, speed=0.0, drive=None) -> None:
    """Steps without contacts, through the compiled step."""
    nothing = in_rows(np.zeros((1, 3)))
    contacts = np.zeros((0, 2), dtype=np.uint32), np.zeros((0, 3)), np.zeros(0), nothing, nothing
    groups = (), (), (), np.zeros(0, dtype=np.uint32)
    bodies, drives, stepper = (body, None, None), (drive, None, None), Stepper()
    stepper.prepare(lambda shared: step(None, dt, damping, groups, contacts, bodies, drives, shared), damping)
    stepper.take(0, steps, np.ones(steps + 1), np.full(steps + 1, speed), np.zeros(steps))


def kinetic_of_a_brick(body: Turning, before: np.ndarray) -> float:
    """J, by the bilinear form."""
    return turning.kinetic(body, np.where(body.dt_over_mass > 0, MASS, 0.0), before)


class Springs:
    """A model of large bodies whose contacts are springs: force on side a = k d, with d = u_b - u_a and k (C, 3, 3)."""

    def __init__(self, model: Model, stiffness: np.ndarray, apart: bool = True) -> None:
        self.model, self.stiffness = model, stiffness
        self.u, self.force = model.contacts.u, model.contacts.force
        self.apart = in_rows(np.zeros((len(model.group), 3)))
        inertia = model.masses["rigid"][:, 3:] if model.bodies.rigid is not None else np.zeros((0, 3))
        self.bodies: Bodies = large(model.bodies, inertia, self.apart if apart else None)
        model.bodies = self.bodies
        self.present = present(model)

    def set_velocities(self, seed: int, size: float) -> None:
        """Random ones, m/s; turns and strains by as much at a tenth of a metre."""
        rng = np.random.default_rng(seed)
        for kind, body in self.present:
            body.v[...] = np.where(body.dt_over_mass > 0, size * rng.normal(size=body.v.shape), 0.0)
            if kind != "tets":
                body.v[:, 3:] *= 10.0
        if self.bodies.rigid is not None:
            turning.spin(self.bodies.rigid)

    def march(self, steps: int, damping=None, parallel=None) -> None:
        """Steps of all bodies; the springs in between."""
        dt = self.model.dt
        for _ in range(steps):
            for _, body in self.present:
                update_positions(parallel, body, dt, self.u)
            a, b = self.model.contacts.sides.T
            self.apart[...] = self.u[b] - self.u[a]
            self.force[...] = np.einsum("cij,cj->ci", self.stiffness, self.apart)
            for _, body in self.present:
                move(parallel, body, dt, damping, ALL_OF_IT, self.force, self.u)

    def before(self) -> list[np.ndarray]:
        """What `kinetic` needs a step later."""
        return [turning.momenta(body) if kind == "rigid" else body.v.copy() for kind, body in self.present]

    def kinetic(self, before: list[np.ndarray]) -> float:
        """J, by the bilinear form."""
        total = 0.0
        for (kind, body), old in zip(self.present, before, strict=True):
            masses = self.model.masses[kind]
            total += turning.kinetic(body, masses, old) if kind == "rigid" else 0.5 * np.sum(masses * old * body.v)
        return float(total)

    def works(self) -> np.ndarray:
        """(4,) J."""
        return np.sum([body.work.sum(axis=0) for _, body in self.present], axis=0)

    def elastic(self) -> float:
        """J in the blocks."""
        energy = 0.0
        for kind, body in self.present:
            if kind == "affine":
                energy += deforming.observe(body, np.zeros((len(body.q), 6)))[0]
            if kind == "tets":
                energy += deforming_tets.observe(body, self.u, np.zeros((len(body.lame), 6)))[0]
        return energy

    def in_springs(self) -> float:
        """J."""
        return 0.5 * float(np.einsum("ci,cij,cj->", self.apart, self.stiffness, self.apart))

    def momenta(self) -> tuple[np.ndarray, np.ndarray]:
        """Linear momentum, and angular momentum about the origin, now between two steps."""
        layout, linear, angular = self.model.layout, np.zeros(3), np.zeros(3)
        for kind, body in self.present:
            masses = self.model.masses[kind]
            p = masses[:, :3] * body.v[:, :3]
            linear += p.sum(axis=0)
            if kind == "tets":
                angular += np.cross(layout.mesh.nodes + self.u[: len(p)], p).sum(axis=0)
                continue
            angular += np.cross(layout.centroid[layout.members[kind]] + body.q[:, :3], p).sum(axis=0)
            if kind == "rigid":
                angular += body.momentum.sum(axis=0)
            else:
                edges = layout.axes[layout.members[kind]] + body.q[:, 3:].reshape(-1, 3, 3)
                speeds = (masses[:, 3:] * body.v[:, 3:]).reshape(-1, 3, 3)
                angular += np.cross(edges.transpose(0, 2, 1), speeds.transpose(0, 2, 1)).sum(axis=(0, 1))
        return linear, angular
