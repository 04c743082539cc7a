"""Elastic blocks of tets and joints between them, with what is held, driven and loaded."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import csc_matrix
from skfem import Basis, ElementTetP1, ElementTetP2, ElementVector, FacetBasis, LinearForm, asm
from skfem.models.elasticity import lame_parameters, linear_elasticity

from verification.references.interface.envelopes import Law
from verification.references.interface.joints import FacetJoint, joints
from verification.references.interface.mesh import TetSolid

Array = np.ndarray
Where = Callable[[Array, Array], Array]
"""(places (n, 3) m, blocks (n,)) -> mask (n,)"""


@dataclass
class InterfaceModel:
    """K u + sum of joint forces = dead + lambda * load,  u = lambda * driven on the prescribed dofs.

    place (N, 3) m, block (N,), axis (N,): where each dof is, of which block, and along which axis
    """

    body: TetSolid
    basis: Basis
    stiffness: csc_matrix
    joints: list[FacetJoint]
    place: Array
    block: Array
    axis: Array
    held: Array = field(default_factory=lambda: np.zeros(0, dtype=bool))
    driven: Array = field(default_factory=lambda: np.zeros(0))
    dead: Array = field(default_factory=lambda: np.zeros(0))
    load: Array = field(default_factory=lambda: np.zeros(0))

    def dofs(self, axes: str, where: Where) -> Array:
        """(N,) mask of the dofs along some axes ("xz") at the places that `where` picks."""
        return np.isin(self.axis, ["xyz".index(a) for a in axes]) & where(self.place, self.block)

    def hold(self, axes: str, where: Where) -> None:
        """Prescribe dofs; they stay where they are unless they are driven."""
        self.held |= self.dofs(axes, where)

    def drive(self, axes: str, where: Where, amount: float = 1.0) -> None:
        """Prescribe dofs that move by lambda * amount (m)."""
        chosen = self.dofs(axes, where)
        self.held |= chosen
        self.driven[chosen] = amount

    def pressed(self, stress: Sequence[float], where: Callable[[Array], Array]) -> Array:
        """(N,) N, of an even traction (3,) Pa on outer facets."""
        return self.traction(lambda x: np.multiply.outer(np.asarray(stress), np.ones_like(x[0])), where)

    def traction(self, stress: Callable[[Array], Array], where: Callable[[Array], Array]) -> Array:
        """(N,) N, of a traction (3, ...) Pa, a function of the place (3, ...), on outer facets whose middle `where`
        picks."""
        mesh = self.body.mesh
        facets = mesh.facets_satisfying(lambda x: where(x), boundaries_only=True)
        basis = FacetBasis(mesh, self.basis.elem, facets=facets, intorder=4)

        @LinearForm
        def push(v, w):
            return np.einsum("i...,i...->...", stress(w.x), v)

        return asm(push, basis)

    def displacement(self, u: Array) -> Array:
        """(P, 3) m, at the nodes as they were given."""
        return u[self.basis.nodal_dofs[:, self.body.number]].T


def model(
    body: TetSolid,
    young: float,
    poisson: float,
    law: Callable[[int, int], Law],
    degree: int = 1,
    rule: str | int | None = None,
) -> InterfaceModel:
    """Degree 1 with joints at the vertices of facets (tier 1), or degree 2 with Gauss points (tier 2)."""
    element = ElementVector({1: ElementTetP1, 2: ElementTetP2}[degree]())
    basis = Basis(body.mesh, element)
    rule = ("vertex" if degree == 1 else 4) if rule is None else rule
    count = basis.N
    axis, block = np.zeros(count, dtype=np.int64), np.zeros(count, dtype=np.int64)
    for dofs in (basis.nodal_dofs, basis.edge_dofs):
        for k in range(3 if len(dofs) else 0):
            axis[dofs[k]] = k
    block[basis.element_dofs] = body.block
    stiffness = asm(linear_elasticity(*lame_parameters(young, poisson)), basis).tocsc()
    nothing = np.zeros(count)
    return InterfaceModel(
        body,
        basis,
        stiffness,
        joints(body, basis, law, rule),
        basis.doflocs.T,
        block,
        axis,
        held=np.zeros(count, dtype=bool),
        driven=nothing.copy(),
        dead=nothing.copy(),
        load=nothing.copy(),
    )
