"""The blocks of a model sorted by how they move: which block is where, and what mass each dof has."""

from dataclasses import dataclass

import numpy as np

from geometry.blocks import Blocks, TetMesh
from geometry.polyhedra import measures

KINDS = ("rigid", "affine", "tets")
DOFS = {"rigid": 6, "affine": 12, "tets": 3}


@dataclass(frozen=True)
class Material:
    """SI. Young's modulus and Poisson's ratio are needed by affine blocks and tets only."""

    density: float
    young_modulus: float | None = None
    poisson_ratio: float | None = None

    def lame(self) -> tuple[float, float]:
        """Lame constants lambda and mu, Pa."""
        modulus, nu = self.young_modulus, self.poisson_ratio
        if modulus is None or nu is None:
            raise ValueError("young_modulus and poisson_ratio are needed")
        return modulus * nu / ((1 + nu) * (1 - 2 * nu)), modulus / (2 * (1 + nu))


@dataclass(frozen=True)
class Layout:
    """Which block is of which kind, and its measures.

    kind       (B,) index into KINDS      local  (B,) number of the block among its kind
    members    per kind, the blocks of it
    volume, centroid, moment  (B,), (B, 3), (B, 3) principal second moments of volume (m5)
    axes       (B, 3, 3) principal axes in columns
    mesh       tets, or None
    """

    kind: np.ndarray
    local: np.ndarray
    members: dict[str, np.ndarray]
    volume: np.ndarray
    centroid: np.ndarray
    moment: np.ndarray
    axes: np.ndarray
    mesh: TetMesh | None

    def rows(self, kind: str) -> int:
        """Rows of dofs of a kind: blocks, or nodes."""
        if kind == "tets":
            return 0 if self.mesh is None else len(self.mesh.nodes)
        return len(self.members[kind])

    def dof(self, kind: str, row: int, i: int) -> str:
        """A dof in words, to blame it in a message."""
        if kind == "tets":
            assert self.mesh is not None
            block = int(np.searchsorted(self.mesh.node_start, row, side="right") - 1)
            place = self.mesh.nodes[row]
            part = f"node {row} of block {block}"
        else:
            block = int(self.members[kind][row])
            place = self.centroid[block]
            part = f"{kind} block {block}"
        what = f"movement along {'xyz'[i]}" if i < 3 else "rotation" if kind == "rigid" else "strain"
        return f"{part} at ({place[0]:.4g}, {place[1]:.4g}, {place[2]:.4g}) m, {what}"


def lay_out(blocks: Blocks, kind_of_group: dict[str, str], mesh: TetMesh | None) -> Layout:
    """Sort the blocks by kind. Axes within 1e-9 of x, y, z are taken as such."""
    by_group = np.array([KINDS.index(kind_of_group[g]) for g in blocks.groups], dtype=np.int64)
    kind = by_group[blocks.group]
    members = {name: np.flatnonzero(kind == k) for k, name in enumerate(KINDS)}
    local = np.zeros(blocks.count, dtype=np.int64)
    for which in members.values():
        local[which] = np.arange(len(which))
    volume, centroid, tensor = measures.moments(blocks)
    diagonal = np.einsum("bii->bi", tensor)
    off = np.abs(tensor - np.einsum("bi,ij->bij", diagonal, np.eye(3))).max(axis=(1, 2))
    moment, axes = np.linalg.eigh(tensor)
    straight = off <= 1e-9 * diagonal.max(axis=1)
    moment[straight] = diagonal[straight]
    axes[straight] = np.eye(3)
    return Layout(kind, local, members, volume, centroid, moment, axes, mesh)


def real_masses(layout: Layout, density: np.ndarray) -> dict[str, np.ndarray]:
    """Mass of every dof (kg, kg m2): (B, 6) rigid, (B, 12) affine, (N, 3) tets (a quarter of each tet per node)."""
    masses = {}
    which = layout.members["rigid"]
    m, s = density[which] * layout.volume[which], density[which, None] * layout.moment[which]
    masses["rigid"] = np.column_stack([m, m, m, s[:, 1] + s[:, 2], s[:, 0] + s[:, 2], s[:, 0] + s[:, 1]])
    which = layout.members["affine"]
    m, s = density[which] * layout.volume[which], density[which, None] * layout.moment[which]
    masses["affine"] = np.column_stack([m, m, m, s, s, s])
    masses["tets"] = np.repeat(node_masses(layout.mesh, density)[:, None], 3, axis=1)
    return masses


def node_masses(mesh: TetMesh | None, density: np.ndarray) -> np.ndarray:
    """(N,) kg."""
    if mesh is None:
        return np.zeros(0)
    mass = tet_volumes(mesh) * np.repeat(density, np.diff(mesh.tet_start)) / 4
    return np.bincount(mesh.tets.ravel(), np.repeat(mass, 4), minlength=len(mesh.nodes))


def tet_edges(mesh: TetMesh) -> np.ndarray:
    """(T, 3, 3) m, edges from the first corner to the others, in rows."""
    corners = mesh.nodes[mesh.tets]
    return corners[:, 1:] - corners[:, :1]


def tet_volumes(mesh: TetMesh) -> np.ndarray:
    """(T,) m3."""
    return np.linalg.det(tet_edges(mesh)) / 6


def tet_gradients(mesh: TetMesh) -> np.ndarray:
    """(T, 4, 3) 1/m, gradients of the four shape functions."""
    last = np.linalg.inv(tet_edges(mesh)).transpose(0, 2, 1)
    return np.concatenate([-last.sum(axis=1, keepdims=True), last], axis=1)
