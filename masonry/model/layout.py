"""The blocks of a model sorted by how they move: which block is where, and what mass each dof has."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from geometry.blocks import Blocks, TetMesh
from geometry.polyhedra import measures

KINDS = ("rigid", "affine", "tets")
DOFS = {"rigid": 6, "affine": 12, "tets": 3}
ALONG = 1.0 - 1e-9
"""Cosine of the angle within which a principal axis counts as x, y or z."""


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
    axes       (B, 3, 3) principal axes in columns: see `principal_axes`
    mesh       tets, or None
    owner      per kind, (rows,) the block that each row of dofs belongs to: of tets the rows are nodes
    place      per kind, (rows, 3) m, where it is: centroids, or nodes
    """

    kind: np.ndarray
    local: np.ndarray
    members: dict[str, np.ndarray]
    volume: np.ndarray
    centroid: np.ndarray
    moment: np.ndarray
    axes: np.ndarray
    mesh: TetMesh | None

    @cached_property
    def owner(self) -> dict[str, np.ndarray]:
        none = np.zeros(0, dtype=np.int64)
        nodes = none if self.mesh is None else np.repeat(np.arange(len(self.kind)), np.diff(self.mesh.node_start))
        return {"rigid": self.members["rigid"], "affine": self.members["affine"], "tets": nodes}

    @cached_property
    def place(self) -> dict[str, np.ndarray]:
        nodes = np.zeros((0, 3)) if self.mesh is None else self.mesh.nodes
        return {kind: self.centroid[self.members[kind]] for kind in ("rigid", "affine")} | {"tets": nodes}

    def rows(self, kind: str) -> int:
        """Rows of dofs of a kind: blocks, or nodes."""
        return len(self.owner[kind])

    @cached_property
    def deforms(self) -> np.ndarray:
        """(B,) which blocks are not rigid."""
        return ~self.are("rigid")

    @cached_property
    def meshed(self) -> np.ndarray:
        """(B,) which blocks are made of tets."""
        return self.are("tets")

    def are(self, kind: str) -> np.ndarray:
        """(B,) which blocks are of a kind."""
        return np.asarray(self.kind == KINDS.index(kind))

    def of_kind(self, chosen: np.ndarray, kind: str) -> np.ndarray:
        """Those of some blocks (n,) that are of a kind."""
        return chosen[self.kind[chosen] == KINDS.index(kind)]


def lay_out(blocks: Blocks, kind_of_group: dict[str, str], mesh: TetMesh | None) -> Layout:
    """Sort the blocks by kind."""
    by_group = np.array([KINDS.index(kind_of_group[g]) for g in blocks.groups], dtype=np.int64)
    kind = by_group[blocks.group]
    members = {name: np.flatnonzero(kind == k) for k, name in enumerate(KINDS)}
    local = np.zeros(blocks.count, dtype=np.int64)
    for which in members.values():
        local[which] = np.arange(len(which))
    volume, centroid, tensor = measures.moments(blocks)
    moment, axes = principal_axes(tensor)
    return Layout(kind, local, members, volume, centroid, moment, axes, mesh)


def principal_axes(tensor: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Principal second moments (B, 3) and axes in columns (B, 3, 3) of tensors (B, 3, 3).

    Where x, y or z is a principal axis, it is the first, second or third of them: a support may hold the turn about it
    alone, and a step for large displacement holds turns about x, y, z. Equal moments leave the axes open, and so they
    are x, y, z where that may be. What is below 1e-9 of the largest moment counts as 0.
    """
    diagonal = np.einsum("bii->bi", tensor)
    beside = np.abs(tensor - np.einsum("bi,ij->bij", diagonal, np.eye(3))).max(axis=2)
    principal = beside <= 1e-9 * diagonal.max(axis=1, keepdims=True)
    moment, axes = np.linalg.eigh(tensor)
    straight = principal.all(axis=1)
    moment[straight], axes[straight] = diagonal[straight], np.eye(3)
    for k in range(3):
        turned = np.flatnonzero(principal[:, k] & ~straight)
        others = np.delete(np.arange(3), k)
        in_plane, plane = np.ix_(turned, others), np.ix_(turned, others, others)
        axes[turned], moment[turned] = np.eye(3), diagonal[turned]
        moment[in_plane], axes[plane] = np.linalg.eigh(tensor[plane])
    size = np.abs(axes)
    for b, k in np.argwhere((size.max(axis=2) >= ALONG) & (size.argmax(axis=2) != np.arange(3))):
        own = np.argmax(np.abs(axes[b, k]))
        axes[b][:, [k, own]], moment[b, [k, own]] = axes[b][:, [own, k]], moment[b, [own, k]]
    return moment, axes


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
