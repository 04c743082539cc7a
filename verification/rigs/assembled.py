"""The stiffness of a model, assembled from its geometry: sums over contacts, affine blocks and tets, in scipy.

Written apart from the program's forces, which never form a matrix: virtual work of springs k_n, k_s at the contact
points, of one strain in each affine block, of one in each tet. Freedoms in the order of `rig.gather`.
"""

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix, diags
from scipy.sparse.linalg import eigsh

from masonry.bodies import FREEDOMS, KINDS, Material
from masonry.model import Model
from verification.rigs import rig


def elasticity(material: Material) -> np.ndarray:
    """(3, 3, 3, 3) Pa: sigma_ij = C_ijkl du_k/dx_l."""
    lame, shear = material.lame()
    d = np.eye(3)
    bulk = lame * np.einsum("ij,kl->ijkl", d, d)
    return bulk + shear * (np.einsum("ik,jl->ijkl", d, d) + np.einsum("il,jk->ijkl", d, d))


def stiffness(model: Model, material: Material) -> csr_matrix:
    """(n, n) N/m (N m for turns and strains), all freedoms, held ones too."""
    layout, joints = model.layout, model.joints
    kinds = [kind for kind, _ in rig.present(model)]
    first, count = {}, 0
    for kind in kinds:
        first[kind] = count
        count += layout.rows(kind) * FREEDOMS[kind]
    parts: list[tuple[np.ndarray, np.ndarray]] = []

    def side(block: int, node: int, point: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Freedoms (m,) and displacement (3, m) of a point for a unit of each."""
        kind, eye = KINDS[layout.kind[block]], np.eye(3)
        if kind == "tets":
            return first[kind] + 3 * node + np.arange(3), eye
        arm, axes = point - layout.centroid[block], layout.axes[block]
        number = first[kind] + FREEDOMS[kind] * layout.local[block] + np.arange(FREEDOMS[kind])
        if kind == "rigid":
            return number, np.hstack([eye, np.cross(axes.T, arm).T])
        return number, np.hstack([eye, np.kron(eye, arm @ axes)])

    for c in range(len(joints.area)):
        interface = model.groups[1][model.group[c]]
        n = joints.normal[c]
        spring = interface.shear_stiffness * np.eye(3)
        spring += (interface.normal_stiffness - interface.shear_stiffness) * np.outer(n, n)
        a, moved_a = side(joints.block_a[c], joints.node_a[c], joints.point[c])
        b, moved_b = side(joints.block_b[c], joints.node_b[c], joints.point[c])
        apart = np.hstack([-moved_a, moved_b])
        parts.append((np.concatenate([a, b]), joints.area[c] * apart.T @ spring @ apart))
    for block in layout.members["affine"]:
        gradient = np.einsum("ki,lm->klim", np.eye(3), layout.axes[block]).reshape(3, 3, 9)
        own = np.einsum("ija,ijkl,klb->ab", gradient, elasticity(material), gradient) * layout.volume[block]
        parts.append((first["affine"] + 12 * layout.local[block] + 3 + np.arange(9), own))
    if layout.mesh is not None:
        for tet in layout.mesh.tets:
            corners = np.hstack([np.ones((4, 1)), layout.mesh.nodes[tet]])
            slope, volume = np.linalg.inv(corners)[1:].T, abs(np.linalg.det(corners)) / 6.0
            gradient = np.einsum("ki,al->klai", np.eye(3), slope).reshape(3, 3, 12)
            own = np.einsum("ija,ijkl,klb->ab", gradient, elasticity(material), gradient) * volume
            parts.append((first["tets"] + (3 * tet[:, None] + np.arange(3)).ravel(), own))
    rows = np.concatenate([np.repeat(number, len(number)) for number, _ in parts])
    columns = np.concatenate([np.tile(number, len(number)) for number, _ in parts])
    values = np.concatenate([matrix.ravel() for _, matrix in parts])
    return coo_matrix((values, (rows, columns)), shape=(count, count)).tocsr()


def fastest(model: Model, matrix: csr_matrix) -> tuple[float, np.ndarray]:
    """Highest eigenfrequency (rad/s) of the free freedoms with the masses of motion, and its mode (n,), largest 1."""
    which = np.flatnonzero(rig.free(model))
    root = 1.0 / np.sqrt(rig.mass_vector(model)[which])
    scaled = diags(root) @ matrix[which][:, which] @ diags(root)
    start = np.random.default_rng(4).normal(size=len(which))
    if len(which) < 3:
        square, vectors = np.linalg.eigh(scaled.toarray())
    else:
        square, vectors = eigsh(scaled, k=1, which="LA", v0=start, tol=1e-14)
    mode = np.zeros(matrix.shape[0])
    mode[which] = vectors[:, -1] * root
    return float(np.sqrt(square[-1])), mode / np.abs(mode).max()
