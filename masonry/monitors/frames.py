"""Frames of a run: how the corners of all blocks have moved, what contacts show, and the mean stress of blocks."""

import numpy as np

from geometry.blocks import Blocks
from geometry.jit_cache import compiled
from masonry.configuration.configuration import configuration_of
from masonry.configuration.energy import Observation
from masonry.configuration.parts.parts import parts_of
from masonry.model.layout import KINDS
from masonry.model.model import Model
from masonry.rows.history import Frame

PAIRS = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
"""xx yy zz yz xz xy"""


class Frames:
    """Takes frames of a model; what does not change is found once."""

    def __init__(self, model: Model) -> None:
        blocks, layout = model.blocks, model.layout
        self.model = model
        block = block_of_points(blocks)
        self.points = {kind: np.flatnonzero(layout.kind[block] == k) for k, kind in enumerate(KINDS)}
        self.row = layout.local[block]
        self.arm = blocks.points - layout.centroid[block]
        self.nearest = nearest_nodes(model)
        self.configuration = configuration_of(model)

    def take(self, view: Observation, force: np.ndarray, step: int, displacement: float) -> Frame:
        """The specimen now; force (C, 3) N of the contacts on their side a (JointForces)."""
        model, seen = self.model, view.seen
        tets = model.bodies.tets
        stress, sigma, tau = view.stress.copy(), seen.sigma, seen.tau
        if model.bodies.rigid is not None:
            stress[model.layout.members["rigid"]] = self.contact_stress()
        gone, joints, shear = ~model.alive, model.joints, None
        if gone.any():
            along = np.einsum("ci,ci->c", force, joints.normal)
            shear = force - along[:, None] * joints.normal
            across = np.linalg.norm(shear, axis=1)
            sigma, tau = np.where(gone, along / joints.area, sigma), np.where(gone, across / joints.area, tau)
        return Frame(
            step=step,
            time=step * model.dt,
            displacement=displacement,
            corners=self.corners(),
            nodes=model.u[: len(tets.v)].copy() if tets is not None else np.zeros((0, 3)),
            opening=seen.opening,
            slip=seen.slip,
            normal_stress=sigma,
            shear_stress=tau,
            damage_tension=1.0 - model.state.intact_n,
            damage_shear=1.0 - model.state.intact_s,
            stress=stress,
            crushing=self.configuration.crushing.closing(),
            shear=shear,
        )

    def corners(self) -> np.ndarray:
        """(P, 3) m, displacements of the corners of the blocks: exact for rigid and affine ones, of tets those of the
        nearest node."""
        moved = np.zeros_like(self.arm)
        for part in parts_of(self.model):
            p = self.points[part.name]
            if part.kind.nodal:
                assert self.nearest is not None
                moved[p] = self.model.u[self.nearest[p]]
            else:
                moved[p] = part.moved_corners(self.row[p], self.arm[p])
        return moved

    def contact_stress(self) -> np.ndarray:
        """(R, 6) Pa, tension positive, in the order of the rigid blocks: the sum of force x arm over the volume.

        That is the mean stress of a block in equilibrium under its contacts and its weight (Love 1927, art. 123). Zero
        for blocks that are held or driven, where forces act whose places are not known; a traction on a block is
        missing in it.
        """
        layout, which = self.model.layout, self.model.layout.members["rigid"]
        free = np.zeros(layout.volume.shape)
        free[which[(self.model.bodies.rigid.dt_over_mass > 0.0).all(axis=1)]] = 1.0
        sides, force, arm = self.configuration.forces_on_blocks()
        sums = np.zeros((len(free), len(PAIRS)))
        add_force_times_arm(sides, force, arm, sums)
        stress: np.ndarray = (0.5 * sums)[which] * (free / layout.volume)[which, None]
        return stress


@compiled
def add_force_times_arm(sides, force, arm, sums):
    """Add twice the symmetric part of force (3, K) times arm (3, K) to the sums (B, 6) of the blocks `sides` (K,)."""
    for k in range(len(sides)):
        for c, (i, j) in enumerate(PAIRS):
            sums[sides[k], c] += force[i, k] * arm[j, k] + force[j, k] * arm[i, k]


def compile_frame(model: Model) -> None:
    """Compile what a frame needs."""
    for part in parts_of(model):
        if not part.kind.nodal:
            part.moved_corners(np.zeros(0, dtype=np.int64), np.zeros((0, 3)))
    if model.bodies.rigid is not None:
        add_force_times_arm(*configuration_of(model).forces_on_blocks(), np.zeros((model.blocks.count, len(PAIRS))))


def nearest_nodes(model: Model) -> np.ndarray | None:
    """(P,) the node of its own block nearest to each corner of a block with tets, 0 elsewhere; None without tets."""
    blocks, mesh = model.blocks, model.layout.mesh
    if mesh is None:
        return None
    from scipy.spatial import cKDTree

    p = np.flatnonzero(np.isin(block_of_points(blocks), model.layout.members["tets"]))
    far = 10.0 * float(np.ptp(mesh.nodes, axis=0).max())  # a fourth axis on which other blocks are out of reach
    own = np.repeat(np.arange(blocks.count), np.diff(mesh.node_start))
    tree = cKDTree(np.column_stack([mesh.nodes, far * own]))
    result = np.zeros(len(blocks.points), dtype=np.int64)
    result[p] = tree.query(np.column_stack([blocks.points[p], far * block_of_points(blocks)[p]]))[1]
    return result


def block_of_points(blocks: Blocks) -> np.ndarray:
    """(P,) the block that each corner belongs to."""
    block = np.zeros(len(blocks.points), dtype=np.int64)
    block[blocks.face_points] = np.repeat(blocks.face_block(), np.diff(blocks.face_start))
    return block
