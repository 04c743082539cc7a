"""How much elastic energy a mesh of constant-strain tets has too much, from the stress itself (Zienkiewicz and Zhu).

The stress at a node is recovered as the value there of the linear field that fits the stresses of the tets around it
best (superconvergent patch recovery; of a node with few tets around it, those around its neighbours as well). Between
nodes it is linear. The energy of what it differs by from the stress of the tets is what the tets store too much at the
displacements that they have: those of bending, for one, are right on average, and so is the recovered stress, while the
tets cannot have it. So a block that stores U with an error E is 1/(1 - E/U) times as stiff as it should be, and under
given loads deforms, and stores, by about the share E/U too little.
"""

import numpy as np

from geometry.blocks import TetMesh
from masonry.model.layout import tet_gradients, tet_volumes

FEW = 8
"""Tets around a node, below which those around its neighbours count as well."""
FLAT = 1e-6
"""Of the largest second moment of a patch: along an axis with a smaller one its stress has no slope."""
MOST = 0.95
"""Share of the energy beyond which an error is not told apart."""
BELOW = 0.5
"""Of a limit, what a finer mesh aims at: the error of stress that peaks at an edge falls by less than the square."""
LOCK = "as tets of constant strain are too stiff"
ORDER = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
"""xx yy zz yz xz xy"""


def tet_stresses(mesh: TetMesh, moved: np.ndarray, lame: np.ndarray, large: bool = False) -> np.ndarray:
    """(T, 6) Pa (xx yy zz yz xz xy), from displacements of nodes (N, 3) m and lambda, mu (T, 2) Pa.

    large: second Piola-Kirchhoff stress of Green's strain, which a turn leaves as it is
    """
    gradient = np.einsum("tai,taj->tij", moved[mesh.tets], tet_gradients(mesh))
    strain = 0.5 * (gradient + gradient.transpose(0, 2, 1))
    if large:
        strain += 0.5 * np.einsum("tki,tkj->tij", gradient, gradient)
    stress = 2.0 * lame[:, 1, None, None] * strain
    stress += (lame[:, 0] * np.einsum("tii->t", strain))[:, None, None] * np.eye(3)
    return np.stack([stress[:, i, j] for i, j in ORDER], axis=1)


def mesh_error(mesh: TetMesh, stress: np.ndarray, lame: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(T,) J that each tet stores by its stress (T, 6) Pa, and (T,) J of what it differs by from the recovered one."""
    volume = tet_volumes(mesh)
    off = recovered(mesh, stress, volume)[mesh.tets] - stress[:, None]
    squares = _density(off, lame[:, None]).sum(axis=1) + _density(off.sum(axis=1), lame)
    return strain_energy(mesh, stress, lame), volume / 20.0 * squares


def strain_energy(mesh: TetMesh, stress: np.ndarray, lame: np.ndarray) -> np.ndarray:
    """(T,) J that each tet stores by its stress (T, 6) Pa."""
    return tet_volumes(mesh) * _density(stress, lame)


def recovered(mesh: TetMesh, stress: np.ndarray, volume: np.ndarray) -> np.ndarray:
    """(N, 6) Pa at the nodes, from stresses (T, 6) of the tets."""
    places = _about_middles(mesh)
    middle = places[mesh.tets].mean(axis=1)
    one = np.column_stack([np.ones(len(middle)), middle])
    tets = volume[:, None, None] * one[:, :, None] * np.column_stack([one, stress])[:, None, :]
    sums = _around(mesh, tets)
    further = _around(mesh, sums[mesh.tets].sum(axis=1))
    few = np.bincount(mesh.tets.ravel(), minlength=len(mesh.nodes)) < FEW
    sums[few] = further[few]
    weight = sums[:, 0, 0]
    means = sums[:, 0, 1:] / weight[:, None]  # of places, then stresses
    moments = sums[:, 1:, 1:] / weight[:, None, None] - means[:, :3, None] * means[:, None, :]
    slopes = np.linalg.pinv(moments[:, :, :3], rcond=FLAT, hermitian=True) @ moments[:, :, 3:]
    return np.asarray(means[:, 3:] + np.einsum("ni,nij->nj", places - means[:, :3], slopes))


def _about_middles(mesh: TetMesh) -> np.ndarray:
    """(N, 3) m, nodes seen from the middle of those of their block: no digits are lost in squares."""
    count = np.diff(mesh.node_start)
    meshed = np.flatnonzero(count)
    middle = np.add.reduceat(mesh.nodes, mesh.node_start[meshed]) / count[meshed, None]
    return mesh.nodes - np.repeat(middle, count[meshed], axis=0)


def _around(mesh: TetMesh, values: np.ndarray) -> np.ndarray:
    """(N, ...) sums of values (T, ...) over the tets around each node."""
    flat, nodes = values.reshape(len(values), -1), mesh.tets.ravel()
    sums = [np.bincount(nodes, np.repeat(column, 4), len(mesh.nodes)) for column in flat.T]
    return np.column_stack(sums).reshape(-1, *values.shape[1:])


def _density(stress: np.ndarray, lame: np.ndarray) -> np.ndarray:
    """J/m3 of stresses (..., 6) Pa, by Hooke's law with lambda, mu (..., 2)."""
    lam, mu = lame[..., 0], lame[..., 1]
    trace = stress[..., :3].sum(axis=-1)
    squares = (stress[..., :3] ** 2).sum(axis=-1) + 2.0 * (stress[..., 3:] ** 2).sum(axis=-1)
    return np.asarray((squares - lam / (3.0 * lam + 2.0 * mu) * trace**2) / (4.0 * mu))


def finer(mesh: TetMesh, error: np.ndarray, share: float, limit: float, kind: str, size: float | None) -> str:
    """Advice that brings a share of the energy below a limit, where the error (T,) J of each tet is now: by how much
    tets are too stiff falls with the square of their size. kind, size (m): of the mesh, as in a scene."""
    if kind == "fan":
        return 'take specimen.mesh = "gmsh" with a mesh_size that is a fraction of a block'
    corners = mesh.nodes[mesh.tets]
    edges = [np.linalg.norm(corners[:, i] - corners[:, j], axis=1) for i in range(4) for j in range(i)]
    mean, share, aim = float(error @ np.mean(edges, axis=0) / error.sum()), min(share, MOST), BELOW * limit
    length = 1000.0 * min(mean, size or np.inf) * np.sqrt(aim / (1.0 - aim) * (1.0 - share) / share)
    return f'take specimen.mesh_size = "{length:.2g} mm" or less' if size else f"take tets of {length:.2g} mm or less"
