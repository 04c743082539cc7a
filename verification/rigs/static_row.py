"""The static answer of a row of boxes of tets (structured.py) by one sparse solve: a check that shares no kernel.

Linear tets and springs between the nodes that face each other, each with a third of the triangles round it: the same
discretisation as that of blocks with tets, assembled here from its definition.
"""

from collections.abc import Sequence

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.linalg import spsolve

from geometry.blocks import TetMesh

Floats = np.ndarray


def displacements(
    mesh: TetMesh, cuts: Sequence[float], lame: tuple[float, float], springs: tuple[float, float], traction: Floats
) -> Floats:
    """(N, 3) m: the first face is held, the last bears a traction (3,) Pa.

    lame: lambda, mu (Pa); springs: kn, ks (Pa/m)
    """
    rows, columns, values = [], [], []

    def add(row: Floats, column: Floats, value: Floats) -> None:
        rows.append(row.ravel())
        columns.append(column.ravel())
        values.append(value.ravel())

    add(*tets(mesh, *lame))
    for k, cut in enumerate(cuts[1:-1]):
        a, area = face(mesh, k, cut)
        b, other = face(mesh, k + 1, cut)
        assert np.allclose(mesh.nodes[a], mesh.nodes[b]) and np.allclose(area, other)
        for axis, stiffness in enumerate((springs[0], springs[1], springs[1])):
            pair = np.stack([3 * a + axis, 3 * b + axis], axis=1)
            force = stiffness * area[:, None, None] * np.array([[1.0, -1.0], [-1.0, 1.0]])
            add(np.repeat(pair, 2, axis=1), np.tile(pair, 2), force)
    size = mesh.nodes.size
    where = np.concatenate(rows), np.concatenate(columns)
    matrix = coo_array((np.concatenate(values), where), shape=(size, size)).tocsr()
    load, moved = np.zeros((len(mesh.nodes), 3)), np.zeros(size)
    end, area = face(mesh, len(cuts) - 2, cuts[-1])
    load[end] = area[:, None] * traction
    free = np.repeat(np.abs(mesh.nodes[:, 0] - cuts[0]) > 1e-9, 3)
    moved[free] = spsolve(matrix[free][:, free].tocsc(), load.ravel()[free])
    return moved.reshape(-1, 3)


def tets(mesh: TetMesh, lam: float, mu: float) -> tuple[Floats, Floats, Floats]:
    """Rows, columns and stiffness (N/m) of all tets: V (lambda g_ai g_bj + mu g_a.g_b delta_ij + mu g_bi g_aj)."""
    corner = mesh.nodes[mesh.tets]
    edge = corner[:, 1:] - corner[:, :1]
    volume = np.linalg.det(edge) / 6
    last = np.linalg.inv(edge).transpose(0, 2, 1)
    g = np.concatenate([-last.sum(axis=1, keepdims=True), last], axis=1)
    same = np.einsum("tai,tbi,jk->tajbk", g, g, np.eye(3))
    k = lam * np.einsum("tai,tbj->taibj", g, g) + mu * (same + np.einsum("tbi,taj->taibj", g, g))
    freedom = (3 * mesh.tets[:, :, None] + np.arange(3)).reshape(-1, 12)
    return np.repeat(freedom, 12, axis=1), np.tile(freedom, 12), volume[:, None, None, None, None] * k


def face(mesh: TetMesh, box: int, cut: float) -> tuple[Floats, Floats]:
    """Nodes of a box in the plane x = cut, ordered by y and z, and the third of the triangles round each (m2)."""
    mine = mesh.tets[mesh.tet_start[box] : mesh.tet_start[box + 1]]
    there = np.abs(mesh.nodes[mine][:, :, 0] - cut) < 1e-9
    triangles = mine[there.sum(axis=1) == 3][there[there.sum(axis=1) == 3]].reshape(-1, 3)
    corner = mesh.nodes[triangles]
    area = 0.5 * np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1)
    share = np.bincount(triangles.ravel(), np.repeat(area / 3, 3), minlength=len(mesh.nodes))
    nodes = np.unique(triangles)
    ordered = nodes[np.lexsort((mesh.nodes[nodes, 2], mesh.nodes[nodes, 1]))]
    return ordered, share[ordered]
