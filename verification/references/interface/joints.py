"""Joints of no thickness: the jump between two facets at quadrature points, as one sparse matrix."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix, vstack
from skfem import CellBasis, FacetBasis

from verification.references.interface.envelopes import Law
from verification.references.interface.mesh import TetSolid, facet_pairs

Array = np.ndarray
VERTICES = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]), np.full(3, 1.0 / 6.0)
"""A third of a facet's area at each of its corners: what point contacts at nodes stand for."""


@dataclass(frozen=True)
class FacetJoint:
    """The points of all facets that follow one law.

    jump    (3 n, N) u_b - u_a at the points from the dofs, x, y, z of each point
    weight  (n,) m2     normal  (n, 3) from a to b     place  (n, 3) m     blocks  (n, 2)
    """

    law: Law
    jump: csr_matrix
    weight: Array
    normal: Array
    place: Array
    blocks: Array


def joints(
    body: TetSolid, basis: CellBasis, law: Callable[[int, int], Law], rule: str | int = "vertex"
) -> list[FacetJoint]:
    """The joints of a solid, one for each law; rule: "vertex", or the degree that Gauss points integrate exactly."""
    facets_a, facets_b, blocks = facet_pairs(body)
    laws = [law(a, b) for a, b in blocks.tolist()]
    joint_list = []
    for each in dict.fromkeys(laws):
        which = np.flatnonzero([other == each for other in laws])
        joint_list.append(_joint(each, body, basis, facets_a[which], facets_b[which], blocks[which], rule))
    return joint_list


def _joint(
    law: Law, body: TetSolid, basis: CellBasis, facets_a: Array, facets_b: Array, blocks: Array, rule: str | int
) -> FacetJoint:
    how = {"quadrature": VERTICES} if rule == "vertex" else {"intorder": rule}
    a, b = (FacetBasis(body.mesh, basis.elem, facets=facets, **how) for facets in (facets_a, facets_b))
    place = np.asarray(a.global_coordinates())
    gap = np.abs(place - np.asarray(b.global_coordinates())).max()
    if gap > 1e-7 * np.ptp(body.mesh.p):
        raise ValueError(f"quadrature points of the two sides of a joint are {gap:.2g} m apart")
    joint = FacetJoint(
        law,
        (_values(b, basis.N) - _values(a, basis.N)).tocsr(),
        a.dx.ravel(),
        a.normals.transpose(1, 2, 0).reshape(-1, 3),
        place.transpose(1, 2, 0).reshape(-1, 3),
        np.repeat(blocks, a.dx.shape[1], axis=0),
    )
    return joint if rule != "vertex" else _merged(joint, body.mesh.facets[:, facets_a].T.ravel())


def _merged(joint: FacetJoint, vertex: Array) -> FacetJoint:
    """One point where several facets of one plane have a corner: their jumps are one, and their areas add up."""
    key = np.column_stack([vertex, joint.blocks, np.round(joint.normal * 1e6)]).astype(np.int64)
    _, first, same = np.unique(key, axis=0, return_index=True, return_inverse=True)
    rows = (3 * first[:, None] + np.arange(3)).ravel()
    weight = np.bincount(same.ravel(), joint.weight)
    return FacetJoint(joint.law, joint.jump[rows], weight, joint.normal[first], joint.place[first], joint.blocks[first])


def _values(facets: FacetBasis, count: int) -> csr_matrix:
    """(3 n, N) displacement at the points of facets from the dofs."""
    cells, points = facets.dx.shape
    row = np.arange(cells * points * 3).reshape(cells, points, 3)
    rows, columns, values = [], [], []
    for j in range(facets.Nbfun):
        value = np.asarray(facets.basis[j][0]).transpose(1, 2, 0)
        rows.append(row.ravel())
        columns.append(np.broadcast_to(facets.element_dofs[j][:, None, None], value.shape).ravel())
        values.append(value.ravel())
    shape = (3 * cells * points, count)
    matrix = coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=shape).tocsr()
    matrix.eliminate_zeros()
    return matrix


def all_jumps(joints: list[FacetJoint]) -> csr_matrix:
    """(3 m, N) the jumps of all joints, one below the other."""
    return vstack([joint.jump for joint in joints]).tocsr()
