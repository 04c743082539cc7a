"""Small models made by hand: how they march, and their forces and stiffness through the compiled step."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from masonry import loads
from masonry.bodies import KINDS, Material, lay_out
from masonry.holds import Hold, held_freedoms
from masonry.kernels.freedom import Guided
from masonry.kernels.step import advance
from masonry.laws.elastic import Elastic
from masonry.laws.interface import Interface
from masonry.loads import Push
from masonry.model import Model, Stepping, build
from verification.rigs.shapes import Setup

STONE = Material(density=1900.0, young_modulus=5e9, poisson_ratio=0.2)
GLUE = (Elastic(), Interface(normal_stiffness=2e11, shear_stiffness=8e10))
REAL = Stepping(masses="real", damping=0.0)
SMALL = 2.0**-20
"""m, a displacement at which contacts that never yield are far from it."""


def make(
    s: Setup,
    law: tuple = GLUE,
    stepping: Stepping = REAL,
    holds: Sequence[Hold] = (),
    pushes: Sequence[Push] = (),
    gravity: Sequence[float] = (0.0, 0.0, 0.0),
    material: Material = STONE,
) -> Model:
    """A model of a set-up; always with dead loads, axes and a damping, so that few types get compiled."""
    layout = lay_out(replace(s.blocks, group=s.kind, groups=KINDS), {k: k for k in KINDS}, s.mesh)
    conditions = loads.no_conditions(layout)
    for hold in holds:
        for kind, mask in held_freedoms(s.blocks, layout, hold).items():
            conditions.prescribed[kind] |= mask
    loads.add_gravity(layout, conditions.load, np.full(s.blocks.count, material.density), np.asarray(gravity))
    for push in pushes:
        loads.add_traction(s.blocks, layout, conditions.load, push)
    model = build(s.blocks, s.joints, {"units": material}, {"unit_unit": law}, stepping, conditions, layout)
    model.damping = stepping.damping
    rigid, affine, tets = model.bodies
    if rigid is not None:
        rigid = rigid._replace(axes=np.ascontiguousarray(layout.axes[layout.members["rigid"]]))
    if affine is not None:
        affine = affine._replace(axes=np.ascontiguousarray(layout.axes[layout.members["affine"]]))
    model.bodies = rigid, affine, tets
    return model


def everything(*blocks: int) -> Hold:
    """Blocks that are held altogether."""
    return Hold(np.array(blocks), (0, 1, 2), turns=(0, 1, 2))


def present(model: Model) -> list[tuple]:
    """(kind, body) of the kinds of blocks that are there."""
    return [(kind, body) for kind, body in zip(KINDS, model.bodies, strict=True) if body is not None]


def march(model: Model, steps: int, dead_load: float = 1.0) -> None:
    """Take steps under a constant share of the dead loads."""
    gauge, share = np.zeros(steps), np.full(steps + 1, dead_load)
    speed = np.zeros(steps + 1)
    advance(
        *(None, 0, steps, model.dt, model.damping, share, speed),
        *(model.groups, model.contacts, model.bodies, model.drives, gauge),
    )


def positions(model: Model) -> dict[str, np.ndarray]:
    """The displacements that the freedoms of each kind hold: q, and the rows of u that belong to tet nodes."""
    return {kind: model.contacts[3][: len(body.v)] if kind == "tets" else body.q for kind, body in present(model)}


def free(model: Model) -> np.ndarray:
    """(n,) which freedoms move, in the order of `gather`."""
    return np.concatenate([(body.pace > 0).ravel() for _, body in present(model)])


def gather(values: dict[str, np.ndarray]) -> np.ndarray:
    """(n,) all values by kind in one row."""
    return np.concatenate([np.asarray(v).ravel() for v in values.values()])


def put(model: Model, what: dict[str, np.ndarray], vector: np.ndarray) -> None:
    """Write a vector, in the order of `gather`, into arrays by kind."""
    first = 0
    for values in what.values():
        values[...] = vector[first : first + values.size].reshape(values.shape)
        first += values.size


def kick(model: Model, displacement: np.ndarray, dead_load: float = 0.0) -> np.ndarray:
    """(n,) velocity after one compiled step from rest in this position, without damping; elastic only."""
    put(model, positions(model), displacement)
    velocity = {kind: body.v for kind, body in present(model)}
    put(model, velocity, np.zeros(len(displacement)))
    damping = model.damping
    model.damping = None if damping is None else 0.0
    march(model, 1, dead_load)
    model.damping = damping
    found = gather(velocity)
    put(model, velocity, np.zeros(len(displacement)))
    return found


def forces(model: Model, displacement: np.ndarray, dead_load: float = 0.0) -> np.ndarray:
    """(n,) force on every free freedom at rest in this position; elastic only."""
    pace = np.concatenate([body.pace.ravel() for _, body in present(model)])
    found = kick(model, displacement, dead_load)
    return np.divide(found, pace, out=np.zeros_like(found), where=pace > 0)


def acceleration_matrix(model: Model) -> np.ndarray:
    """(f, f) -M^-1 K of the f free freedoms, as the compiled step has it: no mass is read from the model."""
    moves = np.flatnonzero(free(model))
    columns = [kick(model, SMALL * unit)[moves] / (SMALL * model.dt) for unit in np.eye(len(free(model)))[moves]]
    put(model, positions(model), np.zeros(len(free(model))))
    return np.stack(columns, axis=1)


def stiffness_matrix(model: Model) -> np.ndarray:
    """(n, n) N/m by unit displacements through the compiled kernels; rows and columns of held freedoms are zero."""
    moves = np.flatnonzero(free(model))
    count = len(free(model))
    matrix = np.zeros((count, count))
    for j in moves:
        unit = np.zeros(count)
        unit[j] = 1.0
        matrix[:, j] = -forces(model, unit)
    put(model, positions(model), np.zeros(count))
    return matrix


def mass_vector(model: Model) -> np.ndarray:
    """(n,) masses of motion in the order of `gather`: kg, and kg m2 for turns and strains; 0 where held."""
    return np.concatenate([model.masses[kind].ravel() for kind, _ in present(model)])


def frequencies(model: Model) -> np.ndarray:
    """Ascending eigenfrequencies (rad/s) of the model, from its exact stiffness and its masses of motion."""
    which = free(model)
    root = np.sqrt(mass_vector(model)[which])
    matrix = stiffness_matrix(model)[np.ix_(which, which)] / np.outer(root, root)
    return np.sqrt(np.maximum(np.linalg.eigvalsh(0.5 * (matrix + matrix.T)), 0.0))


def true_limit(model: Model) -> float:
    """2/w_max/sqrt(1 + xi) in seconds, from the exact stiffness matrix and the masses of motion."""
    assert not isinstance(model.damping, Guided)
    return float(2.0 / frequencies(model)[-1] / np.sqrt(1.0 + (model.damping or 0.0)))


def linear_field(model: Model, shift: np.ndarray, gradient: np.ndarray) -> np.ndarray:
    """The freedoms at which every point moves by shift + gradient @ x; for rigid blocks only its turn is taken."""
    layout, found = model.layout, {}
    for kind, _ in present(model):
        if kind == "tets":
            assert layout.mesh is not None
            found[kind] = shift + layout.mesh.nodes @ gradient.T
            continue
        which = layout.members[kind]
        move = shift + layout.centroid[which] @ gradient.T
        if kind == "affine":
            inner = (gradient @ layout.axes[which]).reshape(-1, 9)
        else:
            w = 0.5 * (gradient - gradient.T)
            inner = np.array([w[2, 1], w[0, 2], w[1, 0]]) @ layout.axes[which]
        found[kind] = np.concatenate([move, inner], axis=1)
    return gather(found)


def displacements(model: Model) -> tuple[np.ndarray, np.ndarray]:
    """(B, 3) m at the centroids of rigid and affine blocks, and (N, 3) m of the tet nodes."""
    moved = np.zeros((model.blocks.count, 3))
    for kind, body in present(model):
        if kind != "tets":
            moved[model.layout.members[kind]] = body.q[:, :3]
    tets = model.bodies[2]
    return moved, model.contacts[3][: len(tets.v)].copy() if tets is not None else np.zeros((0, 3))
