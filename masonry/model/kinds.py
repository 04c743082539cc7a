"""The kinds of motion that blocks may have: which dofs they have, and what these mean. Each kind answers for itself."""

from typing import Any

import numpy as np

from masonry.model.layout import Layout


class KindOfMotion:
    """Blocks that move as a whole: their first three dofs are the movement of the centroid along x, y, z.

    beyond  what the dofs behind the first three are, in a word
    nodal   whether the rows of dofs are those of nodes, and not of blocks
    """

    name: str
    beyond: str
    nodal = False

    def rows_of(self, layout: Layout, chosen: np.ndarray) -> np.ndarray:
        """The rows of dofs that belong to some blocks (n,), of those that are of this kind."""
        return layout.local[layout.of_kind(chosen, self.name)]

    def displacements(self, body: Any, u: np.ndarray) -> np.ndarray:
        """(rows, dofs) m, and turns or strains, of a body of this kind; u (S, 3) m, of nodes and contact points."""
        return np.asarray(body.q)

    def sums(self, layout: Layout, values: np.ndarray) -> np.ndarray:
        """(b, ...) of each block of this kind, from values (rows, ...)."""
        return values

    def mean(self, layout: Layout, values: np.ndarray) -> np.ndarray:
        """(b, n) of each block of this kind, from values (rows, n)."""
        return values

    def largest(self, layout: Layout, values: np.ndarray) -> np.ndarray:
        """(b, n) the largest of each block of this kind, from values (rows, n)."""
        return values

    def spread(self, layout: Layout, values: np.ndarray) -> np.ndarray:
        """(rows,) what blocks (B,) have."""
        return values[layout.members[self.name]]

    def words(self, layout: Layout, row: int) -> str:
        """Block to which a row of dofs belongs, in words for a message."""
        return f"{self.name} block {layout.owner[self.name][row]}"

    def local_arms(self, arm: np.ndarray, axes: np.ndarray) -> np.ndarray:
        """(S, 3) m arms of contacts as the step takes them, from those along the axes (S, 3, 3) of their blocks."""
        return np.einsum("cij,cj->ci", axes, arm)

    def spin(self, axes: np.ndarray, spin: np.ndarray) -> np.ndarray:
        """(n, dofs - 3) rates of the dofs beyond the first three in a rigid motion; spin (3,) rad/s, axes (n, 3, 3)."""
        raise NotImplementedError

    def columns(self, arm: np.ndarray, axes: np.ndarray, length: np.ndarray) -> np.ndarray:
        """(c, 3, n) displacement of points for a unit of each dof beyond the first three, over its length."""
        raise NotImplementedError

    def lengths(self, length: np.ndarray) -> np.ndarray:
        """(b, n) m of the dofs beyond the first three, from those along the axes of each block (b, 3)."""
        raise NotImplementedError

    def levers(self, arm: np.ndarray, length: np.ndarray, slack: float) -> np.ndarray:
        """(c, 3) levers of points over the lengths of turns about the principal axes, or of columns of H; `slack` (m)
        longer than they are."""
        raise NotImplementedError

    def gauge(self, axes: np.ndarray, arm: np.ndarray, axis: int) -> tuple[int, np.ndarray]:
        """By what the displacement along an axis of points with arms (n, 3) m depends on turns or strains: the first of
        three dofs, and their weights (n, 3)."""
        raise NotImplementedError

    def moment(self, axes: np.ndarray, arm: np.ndarray, force: np.ndarray) -> np.ndarray:
        """(dofs - 3,) what a force (3,) N at an arm (3,) m from the centroid does on the dofs beyond the first three of
        a block; axes (3, 3)."""
        raise NotImplementedError

    def moments(self, axes: np.ndarray, forces: np.ndarray) -> np.ndarray:
        """(n, 3) N m about the centroid, of what belongs to the dofs beyond the first three (n, dofs - 3)."""
        raise NotImplementedError


class RigidKind(KindOfMotion):
    """Rigid blocks: turns about the principal axes."""

    name, beyond = "rigid", "rotation"

    def spin(self, axes: np.ndarray, spin: np.ndarray) -> np.ndarray:
        return np.asarray(np.einsum("bji,j->bi", axes, spin))

    def columns(self, arm: np.ndarray, axes: np.ndarray, length: np.ndarray) -> np.ndarray:
        local_arm = np.einsum("cij,cj->ci", axes, arm)
        rotation = np.cross(axes.transpose(0, 2, 1), local_arm[:, None, :]).transpose(0, 2, 1)
        return np.asarray(rotation / across(length)[:, None])

    def lengths(self, length: np.ndarray) -> np.ndarray:
        return across(length)

    def levers(self, arm: np.ndarray, length: np.ndarray, slack: float) -> np.ndarray:
        square = arm**2
        return np.asarray((np.sqrt(square.sum(axis=1, keepdims=True) - square) + slack) / across(length))

    def gauge(self, axes: np.ndarray, arm: np.ndarray, axis: int) -> tuple[int, np.ndarray]:
        return 3, np.einsum("nij,ni->nj", axes, np.cross(arm, np.eye(3)[axis]))

    def moment(self, axes: np.ndarray, arm: np.ndarray, force: np.ndarray) -> np.ndarray:
        return np.asarray(axes.T @ np.cross(arm, force))

    def moments(self, axes: np.ndarray, forces: np.ndarray) -> np.ndarray:
        return np.asarray(np.einsum("bij,bj->bi", axes, forces))


class AffineKind(KindOfMotion):
    """Blocks of one strain: the gradient of the displacement, rows along x, y, z, columns along the principal axes."""

    name, beyond = "affine", "strain"

    def local_arms(self, arm: np.ndarray, axes: np.ndarray) -> np.ndarray:
        return arm

    def spin(self, axes: np.ndarray, spin: np.ndarray) -> np.ndarray:
        return np.cross(spin, axes, axisb=1, axisc=1).reshape(-1, 9)

    def columns(self, arm: np.ndarray, axes: np.ndarray, length: np.ndarray) -> np.ndarray:
        return np.einsum("im,ck->cimk", np.eye(3), arm / length).reshape(len(arm), 3, 9)

    def lengths(self, length: np.ndarray) -> np.ndarray:
        return np.tile(length, 3)

    def levers(self, arm: np.ndarray, length: np.ndarray, slack: float) -> np.ndarray:
        return np.asarray((np.abs(arm) + slack) / length)

    def gauge(self, axes: np.ndarray, arm: np.ndarray, axis: int) -> tuple[int, np.ndarray]:
        return 3 + 3 * axis, np.einsum("nij,ni->nj", axes, arm)

    def moment(self, axes: np.ndarray, arm: np.ndarray, force: np.ndarray) -> np.ndarray:
        return np.outer(force, axes.T @ arm).ravel()

    def moments(self, axes: np.ndarray, forces: np.ndarray) -> np.ndarray:
        # first moments, force times arm along the axes of the block, or what they have become
        t = np.einsum("bik,bjk->bij", forces.reshape(-1, 3, 3), axes)
        return np.column_stack([t[:, 2, 1] - t[:, 1, 2], t[:, 0, 2] - t[:, 2, 0], t[:, 1, 0] - t[:, 0, 1]])


class TetKind(KindOfMotion):
    """Blocks of tets: the displacements of their nodes, and nothing beyond."""

    name, beyond, nodal = "tets", "", True

    def rows_of(self, layout: Layout, chosen: np.ndarray) -> np.ndarray:
        none = np.zeros(0, dtype=np.int64)
        if layout.mesh is None:
            return none
        start = layout.mesh.node_start
        return np.concatenate([none, *(np.arange(start[b], start[b + 1]) for b in layout.of_kind(chosen, self.name))])

    def displacements(self, body: Any, u: np.ndarray) -> np.ndarray:
        return u[: len(body.v)]

    def sums(self, layout: Layout, values: np.ndarray) -> np.ndarray:
        return np.asarray(np.add.reduceat(values, self._first(layout)))

    def mean(self, layout: Layout, values: np.ndarray) -> np.ndarray:
        count = np.bincount(layout.owner[self.name])[layout.members[self.name]]
        return self.sums(layout, values) / count[:, None]

    def largest(self, layout: Layout, values: np.ndarray) -> np.ndarray:
        return np.asarray(np.maximum.reduceat(values, self._first(layout)))

    def spread(self, layout: Layout, values: np.ndarray) -> np.ndarray:
        return values[layout.owner[self.name]]

    def words(self, layout: Layout, row: int) -> str:
        return f"node {row} of block {layout.owner[self.name][row]}"

    def spin(self, axes: np.ndarray, spin: np.ndarray) -> np.ndarray:
        return np.zeros((len(axes), 0))

    def columns(self, arm: np.ndarray, axes: np.ndarray, length: np.ndarray) -> np.ndarray:
        return np.zeros((len(arm), 3, 0))

    def lengths(self, length: np.ndarray) -> np.ndarray:
        return np.zeros((len(length), 0))

    def levers(self, arm: np.ndarray, length: np.ndarray, slack: float) -> np.ndarray:
        return np.zeros(arm.shape)

    def _first(self, layout: Layout) -> np.ndarray:
        """The first node of each block of this kind."""
        assert layout.mesh is not None
        return layout.mesh.node_start[layout.members[self.name]]


KIND: dict[str, KindOfMotion] = {kind.name: kind for kind in (RigidKind(), AffineKind(), TetKind())}
"""By name, in the order of layout.KINDS."""


def across(length: np.ndarray) -> np.ndarray:
    """(n, 3) m: for each axis, the radius of gyration about it, from those along the two others."""
    square = length**2
    return np.sqrt(square.sum(axis=1, keepdims=True) - square)


def dof_words(layout: Layout, kind: str, row: int, i: int) -> str:
    """A dof in words, to blame it in a message."""
    place = ", ".join(f"{x:.4g}" for x in layout.place[kind][row])
    what = f"movement along {'xyz'[i]}" if i < 3 else KIND[kind].beyond
    return f"{KIND[kind].words(layout, row)} at ({place}) m, {what}"


def velocities_of(
    layout: Layout, kind: str, rows: np.ndarray, velocity: np.ndarray, spin: np.ndarray, about: np.ndarray
) -> np.ndarray:
    """(n, dofs) of a rigid motion on rows of a kind: velocity (3,) m/s of the point `about` (3,) m, and spin (3,)
    rad/s, in the dofs that v of these bodies has.

    Rigid: velocity of the centroid along x, y, z, spin about the block's principal axes. Affine: velocity of the
    centroid, then the rate of the gradient, rows along x, y, z and columns along the principal axes. Tets: velocity of
    each node.
    """
    moves = velocity + np.cross(spin, layout.place[kind][rows] - about)
    rates = KIND[kind].spin(layout.axes[layout.owner[kind][rows]], spin)
    return np.concatenate([moves, rates], axis=1)
