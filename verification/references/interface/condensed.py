"""The elastic blocks seen from their joints: what no joint touches is eliminated once, exactly."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import SuperLU, splu

from verification.references.interface.joints import all_jumps
from verification.references.interface.model import InterfaceModel

Array = np.ndarray
AT_ONCE = 64
"""Right-hand sides that are solved together."""


@dataclass(frozen=True)
class Condensed:
    """S q + sum of joint forces = dead + lambda * push over the free dofs of the joints, `boundary` (n,).

    stiffness (n, n) N/m   dead, push (n,) N   jump (3 m, n), jump_driven (3 m,): jumps are jump q + lambda jump_driven
    """

    model: InterfaceModel
    boundary: Array
    inner: Array
    stiffness: Array
    dead: Array
    push: Array
    jump: csc_matrix
    jump_driven: Array
    factor: SuperLU | None

    def all_dofs(self, q: Array, factor: float, dead: float) -> Array:
        """(N,) m, from the boundary dofs, lambda and the share of the dead load."""
        m = self.model
        u = factor * m.driven
        u[self.boundary] = q
        if self.factor is not None:
            u[self.inner] = self.factor.solve((dead * m.dead + factor * m.load - m.stiffness @ u)[self.inner])
        return u

    def row(self, weights: Array) -> tuple[Array, float, float]:
        """Weighted sum of u as (w, by_lambda, by_dead): w . q + by_lambda * lambda + by_dead * share of dead load."""
        m, k = self.model, self.model.stiffness
        adjoint = np.zeros(len(weights))
        if self.factor is not None:
            adjoint[self.inner] = self.factor.solve(weights[self.inner])
        w = weights[self.boundary] - (k @ adjoint)[self.boundary]
        by_lambda = weights @ m.driven + adjoint @ (m.load - k @ m.driven)
        return w, float(by_lambda), float(adjoint @ m.dead)


def condense(model: InterfaceModel) -> Condensed:
    """Eliminate the free dofs that touch no joint (static condensation); every block needs something that holds it
    once its joints are held."""
    jumps = all_jumps(model.joints)
    touched = np.zeros(len(model.held), dtype=bool)
    touched[jumps.indices] = True
    boundary, inner = np.flatnonzero(touched & ~model.held), np.flatnonzero(~touched & ~model.held)
    k = model.stiffness
    stiffness = k[boundary][:, boundary].toarray()
    loads = np.stack([model.dead, model.load - k @ model.driven])
    condensed, factor = loads[:, boundary].copy(), None
    if len(inner):
        factor = splu(
            k[inner][:, inner].tocsc(),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
        between = k[inner][:, boundary].tocsc()
        for first in range(0, len(boundary), AT_ONCE):
            columns = slice(first, first + AT_ONCE)
            stiffness[:, columns] -= between.T @ factor.solve(between[:, columns].toarray())
        condensed -= (between.T @ factor.solve(loads[:, inner].T)).T
    stiffness = 0.5 * (stiffness + stiffness.T)
    return Condensed(
        model,
        boundary,
        inner,
        stiffness,
        condensed[0],
        condensed[1],
        jumps[:, boundary].tocsc(),
        jumps @ model.driven,
        factor,
    )
