"""What the joints of the undeformed shape bear: forces of their contacts, and of the patches that take their place.

In large displacement the points of a patch are not those of the joint. What patches between two blocks bear goes to the
contacts of their joint: its normal force and moments by a stress that is linear over what is pressed, as if the joint
were elastic and did not pull; its shear force evenly over that. So force and place of the normal force are those of the
patch, as far as the contacts reach.
"""

import numpy as np

from masonry.kernels.patches import point_forces
from masonry.kernels.redetection import Near
from masonry.model.model import Model
from masonry.monitors.energy import moved

ROUNDS = 20
"""Of leaving out contacts that would pull, at most."""
SAME_DIRECTION = 1e-3
"""Normals of one pair of blocks that differ by less belong to one joint."""
ROUND_OFF = 1e-9
"""Of the mean stress of a joint, and of the largest second moment of its area."""


class JointForces:
    """Takes the forces of all contacts of a model; which contacts make up a joint is found once."""

    def __init__(self, model: Model) -> None:
        self.model, joints = model, model.joints
        pair = np.column_stack([joints.block_a, joints.block_b])
        if model.large is None or not len(pair):
            return
        from scipy.spatial import cKDTree

        kinds = np.column_stack([pair, np.rint(joints.normal / SAME_DIRECTION)])
        self.joint = np.unique(kinds, axis=0, return_inverse=True)[1].ravel()
        self.pairs, which = np.unique(pair @ [model.blocks.count, 1], return_inverse=True)
        self.apart = 10.0 * float(np.ptp(model.blocks.points, axis=0).max())  # other pairs are out of reach
        self.nearest = cKDTree(np.column_stack([joints.point, self.apart * which.ravel()]))

    def take(self) -> np.ndarray:
        """(C, 3) N on side a; in large displacement turned back with side a."""
        model = self.model
        force: np.ndarray = model.contacts.force.copy()
        if model.large is None:
            return force
        gone = ~model.large.bonds.alive
        force[gone] = 0.0
        if gone.any():
            self._of_patches(gone, force)
        return force

    def _of_patches(self, gone: np.ndarray, force: np.ndarray) -> None:
        """Add what patches bear to the forces (C, 3) of contacts that are gone."""
        contact, place, acts = self._on_joints(gone)
        joints, count = self.model.joints, int(self.joint.max()) + 1
        if not len(contact):
            return
        joint = self.joint[contact]
        normal = np.einsum("ki,ki->k", acts, joints.normal[contact])
        across = _sums(joint, acts - normal[:, None] * joints.normal[contact], count)
        sigma = self._stress(gone, joint, normal, place, count)
        pressed = np.where(sigma < 0.0, joints.area, 0.0)
        area = np.bincount(self.joint, pressed, count)
        share = pressed / np.maximum(area, 1e-300)[self.joint]
        force += (joints.area * sigma)[:, None] * joints.normal + share[:, None] * across[self.joint]

    def _on_joints(self, gone: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Of all points of patches between blocks that have a joint: the contact that is nearest (K,), the place
        (K, 3) m and the force (K, 3) N on its side a, turned back with that block."""
        model = self.model
        assert model.large is not None
        near, frames, centroid = model.large.near, model.large.bonds.frames, model.layout.centroid
        block, where, acts = _points(near)
        swapped = block[:, 0] > block[:, 1]
        block[swapped], acts[swapped] = block[swapped, ::-1], -acts[swapped]
        pair = block @ [model.blocks.count, 1]
        which = np.searchsorted(self.pairs, pair)
        has = self.pairs[np.minimum(which, len(self.pairs) - 1)] == pair
        a, which, where, acts = block[has, 0], which[has], where[has], acts[has]
        place = where - centroid[a] - near.motion.moved[a, :3]
        place = centroid[a] + np.einsum("kij,kj->ki", np.linalg.inv(near.motion.frame[a]), place)
        contact = self.nearest.query(np.column_stack([place, self.apart * which]))[1]
        acts = np.einsum("kji,kj->ki", frames[a], acts)
        free = gone[contact]
        return contact[free], place[free], acts[free]

    def _stress(
        self, gone: np.ndarray, joint: np.ndarray, normal: np.ndarray, place: np.ndarray, count: int
    ) -> np.ndarray:
        """(C,) Pa, linear over the pressed contacts of each joint, with the forces normal (K,) N at places (K, 3) m."""
        joints = self.model.joints
        thrust = np.bincount(joint, normal, count)
        bears = thrust < 0.0
        centre = _sums(joint, normal[:, None] * place, count) / np.where(bears, thrust, 1.0)[:, None]
        area = np.where(gone & bears[self.joint], joints.area, 0.0)
        sigma = np.zeros(len(area))
        for _ in range(ROUNDS):
            whole = np.maximum(np.bincount(self.joint, area, count), 1e-300)
            middle = _sums(self.joint, area[:, None] * joints.point, count) / whole[:, None]
            arm = joints.point - middle[self.joint]
            second = _sums(self.joint, area[:, None, None] * arm[:, :, None] * arm[:, None, :], count)
            slope = np.einsum("jik,jk->ji", np.linalg.pinv(second, rcond=ROUND_OFF, hermitian=True), centre - middle)
            mean = (thrust / whole)[self.joint]
            sigma = np.where(area > 0.0, mean + thrust[self.joint] * np.einsum("ci,ci->c", slope[self.joint], arm), 0.0)
            pulls = (area > 0.0) & (sigma > ROUND_OFF * np.abs(mean))
            left = np.bincount(self.joint, np.where(pulls, 0.0, area), count)
            pulls &= left[self.joint] > 0.0
            if not pulls.any():
                break
            area[pulls] = 0.0
        return np.minimum(sigma, 0.0)


def forces_on_blocks(model: Model) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """All that acts between blocks now, in large displacement: the block (K,), the force (3, K) N on it, and its arm
    (3, K) m from the centroid, along x, y and z."""
    assert model.large is not None
    bonds, joints, layout = model.large.bonds, model.joints, model.layout
    block, place, force = _points(model.large.near)
    whole = bonds.alive
    pair = np.column_stack([joints.block_a, joints.block_b])[whole]
    block, force = np.concatenate([block, pair]), np.concatenate([force, bonds.force[whole]])
    place = np.concatenate([place, joints.point[whole] + moved(model, joints.point[whole], pair[:, 1])])
    now = layout.centroid + model.large.near.motion.moved[: len(layout.centroid), :3]
    sides = block.T.ravel()
    arm = np.concatenate([place, place]) - now[sides]
    return sides, np.concatenate([force, -force]).T.copy(), arm.T.copy()


def _points(near: Near) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Blocks (K, 2), place (K, 3) m and force (K, 3) N on the first block of all points that bear."""
    room = int(near.points.held.sum())
    block, place, force = np.zeros((room, 2), dtype=np.int64), np.zeros((room, 3)), np.zeros((room, 3))
    count = point_forces(near, block, place, force)
    return block[:count], place[:count], force[:count]


def _sums(which: np.ndarray, values: np.ndarray, count: int) -> np.ndarray:
    """Sums of rows (K, ...) by a number (K,): (count, ...)."""
    found = np.zeros((count, *values.shape[1:]))
    np.add.at(found, which, values)
    return found
