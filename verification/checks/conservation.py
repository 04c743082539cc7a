"""Resultants of freedoms: momentum from masses times velocities, forces from generalised forces. Linear theory."""

import numpy as np

from masonry.model.model import Model
from verification.fixtures.models import present

LEVI_CIVITA = np.zeros((3, 3, 3))
for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
    LEVI_CIVITA[i, j, k], LEVI_CIVITA[i, k, j] = 1.0, -1.0


def resultant(model: Model, values: dict[str, np.ndarray]) -> np.ndarray:
    """(6,) sum and moment about the origin of forces (or momenta) given on the freedoms of each kind."""
    total, layout = np.zeros(6), model.layout
    for kind, _ in present(model):
        f = values[kind]
        which = layout.members[kind]
        place = layout.centroid[which] if layout.mesh is None or kind != "tets" else layout.mesh.nodes
        total[:3] += f[:, :3].sum(axis=0)
        total[3:] += np.cross(place, f[:, :3]).sum(axis=0)
        if kind == "rigid":
            total[3:] += np.einsum("bij,bj->i", layout.axes[which], f[:, 3:])
        if kind == "affine":
            first_moment = np.einsum("bjl,bkl->bjk", layout.axes[which], f[:, 3:].reshape(-1, 3, 3))
            total[3:] += np.einsum("ijk,bjk->i", LEVI_CIVITA, first_moment)
    return total


def momentum(model: Model) -> np.ndarray:
    """(6,) linear (kg m/s) and angular momentum (kg m2/s)."""
    return resultant(model, {kind: model.masses[kind] * body.v for kind, body in present(model)})


def contact_forces(model: Model) -> np.ndarray:
    """(6,) N, N m: what all contacts together do to all blocks."""
    return resultant(model, {kind: body.contact for kind, body in present(model)})
