"""Forces of the joints of the undeformed shape: those of their contacts, and of the patches that take their place.

In large displacement the points of a patch are not those of the joint. What patches between two units bear in the
plane of a joint goes to its contacts: normal force and moments by a stress that is linear over what is pressed, as if
the joint were elastic and did not pull; shear force and the moment about the normal as on a rigid plate. So force and
moment are those of the patch, as far as the contacts reach. Between blocks of one unit each pair is looked at alone.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from geometry.polyhedra.measures import extent
from masonry.elements.element import acting_on_blocks
from masonry.jit.compiled_parts import Call, RepeatedCall
from masonry.model.large.meeting import Large
from masonry.model.model import Model
from masonry.patches.arrays import Near
from masonry.patches.measures import point_forces

ROUNDS = 20
"""Of leaving out contacts that would pull, at most."""
SAME_DIRECTION, SAME_PLANE = 1e-3, 1e-5
"""Normals, and places of a plane over the size of the specimen, that differ by less belong to one joint."""
ALIGNED = 0.7
"""Least cosine between the normals of a patch and of the joint that it takes the place of."""
ROUND_OFF = 1e-9
"""Of the mean stress of a joint, and of the square of its polar moment."""


class Points(NamedTuple):
    """Points that bear: the two blocks and bodies (K, 2), place (K, 3) m, force on the first (K, 3) N, and normal
    (K, 3) from the first to the second."""

    block: np.ndarray
    body: np.ndarray
    place: np.ndarray
    force: np.ndarray
    normal: np.ndarray


class BearingPoints:
    """Takes the points that bear now; room for them is there from one time to the next."""

    def __init__(self, near: Near) -> None:
        self.number, self.call = np.zeros(1, dtype=np.int64), RepeatedCall(point_forces)
        self.make_room(int(near.points.number.sum()))

    def make_room(self, room: int) -> None:
        self.room = (*np.zeros((2, room, 2), dtype=np.int64), *np.zeros((3, room, 3)))

    def of(self, near: Near) -> Call:
        """The call that looks for them."""
        return self.call.of(near, *self.room, self.number)

    def take(self, near: Near) -> Points:
        """The points, in arrays of their own."""
        self.of(near)()
        if self.number[0] > len(self.room[0]):
            self.make_room(2 * int(self.number[0]))
            self.of(near)()
        return Points(*(array[: self.number[0]].copy() for array in self.room))


class JointForces:
    """Takes the forces of all contacts of a model; which contacts make up a joint is found once."""

    def __init__(self, model: Model, large: Large, bearing: Callable[[Near], Points]) -> None:
        """bearing: takes the points of patches that bear"""
        self.model, self.parts, self.bearing, joints = model, large, bearing, model.joints
        if not len(joints.area):
            return
        from scipy.spatial import cKDTree

        pair = np.column_stack([joints.block_a, joints.block_b])
        key, self.sign = self._sides(pair)
        self.normal = self.sign[:, None] * joints.normal
        self.size = extent(model.blocks)
        level = np.einsum("ci,ci->c", self.normal, joints.point) / (SAME_PLANE * self.size)
        kinds = np.column_stack([key, np.rint(self.normal / SAME_DIRECTION), np.rint(level)])
        first, self.joint = np.unique(kinds, axis=0, return_index=True, return_inverse=True)[1:]
        self.joint = self.joint.ravel()
        self.across = self.normal[first]
        least = np.eye(3)[np.abs(self.across).argmin(axis=1)]
        along = np.cross(self.across, least)
        self.along = along / np.linalg.norm(along, axis=1, keepdims=True)
        self.beside = np.cross(self.across, self.along)
        self.pairs, which = np.unique(key, return_inverse=True)
        self.nearest = cKDTree(self._place(joints.point, which.ravel(), self.normal))

    def take(self) -> np.ndarray:
        """(C, 3) N on side a, turned back with the block on the side of the lower unit."""
        force: np.ndarray = self.model.contacts.force.copy()
        gone = ~self.model.alive
        force[gone] = 0.0
        if gone.any():
            self._of_patches(gone, force)
        return force

    def _sides(self, pair: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(K,) a number of what meets in pairs of blocks (K, 2), two units or two blocks of one; and 1.0, or -1.0
        where the first block belongs to the unit of the higher number."""
        unit, count = self.model.blocks.unit[pair].astype(np.int64), self.model.blocks.count
        within = unit[:, 0] == unit[:, 1]
        what = np.where(within[:, None], pair, unit)
        most = max(count, int(self.model.blocks.unit.max()) + 1)
        key = (what.min(axis=1) * most + what.max(axis=1)) * 2 + within
        return key, np.where(what[:, 0] <= what[:, 1], 1.0, -1.0)

    def _place(self, point: np.ndarray, which: np.ndarray, normal: np.ndarray) -> np.ndarray:
        """Places, pairs (K,) and normals in one space, in which another pair is out of reach, and a normal far off."""
        return np.column_stack([point / self.size, 100.0 * which, normal])

    def _of_patches(self, gone: np.ndarray, force: np.ndarray) -> None:
        """Add what patches bear to the forces (C, 3) of contacts that are gone."""
        joint, place, acts = self._on_joints(gone)
        if not len(joint):
            return
        joints, count = self.model.joints, len(self.across)
        along = np.einsum("ki,ki->k", acts, self.across[joint])
        sigma = self._stress(gone, joint, along, place)
        mean = np.bincount(joint, along, count) / np.maximum(np.bincount(self.joint, joints.area, count), 1e-300)
        area = np.where(sigma < ROUND_OFF * mean[self.joint], joints.area, 0.0)
        arm, middle, (one, _, two) = self._about_middle(area)
        turning = np.einsum("ki,ki->k", np.cross(place - middle[joint], acts), self.across[joint])
        spin = np.bincount(joint, turning, count) / np.maximum(one + two, 1e-300)
        beside = (acts - along[:, None] * self.across[joint]).T
        pressed = np.maximum(np.bincount(self.joint, area, count), 1e-300)
        shear = np.column_stack([np.bincount(joint, part, count) / pressed for part in beside])
        traction = shear[self.joint] + spin[self.joint, None] * np.cross(self.across[self.joint], arm)
        force += self.sign[:, None] * (joints.area[:, None] * sigma[:, None] * self.normal + area[:, None] * traction)

    def _on_joints(self, gone: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Of all points of patches in the plane of a joint: its number (K,), the place (K, 3) m and the force (K, 3) N
        on the side of the lower unit, turned back with the block there."""
        near, points = self.parts.near, self.bearing(self.parts.near)
        key, sign = self._sides(points.block)
        which = np.minimum(np.searchsorted(self.pairs, key), len(self.pairs) - 1)
        row, low = np.arange(len(key)), (sign < 0.0).astype(int)
        block, body = points.block[row, low], points.body[row, low]
        motion = near.motion
        undo = (motion.frame if motion.dual is None else motion.dual)[body]  # transposed
        place = points.place - motion.centre[body] - motion.moved[body, :3]
        place = motion.centre[body] + np.einsum("kji,kj->ki", undo, place)
        back = sign[:, None, None] * self.parts.bonds.frames[block].transpose(0, 2, 1)
        acts, normal = (np.einsum("kij,kj->ki", back, vector) for vector in (points.force, points.normal))
        contact = self.nearest.query(self._place(place, which, normal))[1]
        aligned = np.einsum("ki,ki->k", normal, self.normal[contact]) > ALIGNED
        chosen = (self.pairs[which] == key) & gone[contact] & aligned
        return self.joint[contact[chosen]], place[chosen], acts[chosen]

    def _stress(self, gone: np.ndarray, joint: np.ndarray, along: np.ndarray, place: np.ndarray) -> np.ndarray:
        """(C,) Pa, linear over the pressed contacts of each joint, with the forces along (K,) N at places (K, 3) m."""
        joints, count = self.model.joints, len(self.across)
        thrust = np.bincount(joint, along, count)
        bears = np.where(thrust < 0.0, thrust, 1.0)
        centre = np.column_stack([np.bincount(joint, along * x, count) / bears for x in place.T])
        area = np.where(gone & (thrust < 0.0)[self.joint], joints.area, 0.0)
        sigma = np.zeros(len(area))
        for _ in range(ROUNDS):
            arm, middle, second = self._about_middle(area)
            off = centre - middle
            slope = self._slope(*second, *(np.einsum("ji,ji->j", off, axis) for axis in (self.along, self.beside)))
            mean = thrust / np.maximum(np.bincount(self.joint, area, count), 1e-300)
            linear = mean[self.joint] + thrust[self.joint] * np.einsum("ci,ci->c", slope[self.joint], arm)
            sigma = np.where(area > 0.0, linear, 0.0)
            pulls = (area > 0.0) & (sigma > -ROUND_OFF * mean[self.joint])
            pulls &= (np.bincount(self.joint, np.where(pulls, 0.0, area), count) > 0.0)[self.joint]
            if not pulls.any():
                break
            area[pulls] = 0.0
        return np.minimum(sigma, 0.0)

    def _about_middle(
        self, area: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """Of areas (C,) of contacts: their arms (C, 3) from the middle of their joint, the middles (J, 3), and the
        second moments (J,) along both axes of the joint, and between them."""
        count, point = len(self.across), self.model.joints.point
        whole = np.maximum(np.bincount(self.joint, area, count), 1e-300)
        middle = np.column_stack([np.bincount(self.joint, area * x, count) for x in point.T]) / whole[:, None]
        arm = point - middle[self.joint]
        s, t = (np.einsum("ci,ci->c", arm, axis[self.joint]) for axis in (self.along, self.beside))
        moments = (np.bincount(self.joint, area * x * y, count) for x, y in ((s, s), (s, t), (t, t)))
        return arm, middle, tuple(moments)  # type: ignore[return-value]

    def _slope(self, ss: np.ndarray, st: np.ndarray, tt: np.ndarray, s: np.ndarray, t: np.ndarray) -> np.ndarray:
        """(J, 3) the inverse of the second moments times (s, t); where contacts lie in a row, along it, and else 0."""
        trace, determinant = ss + tt, ss * tt - st * st
        flat = determinant > ROUND_OFF * trace**2
        d, square = np.where(flat, determinant, 1.0), np.maximum(trace, 1e-150) ** 2
        one = np.where(flat, (tt * s - st * t) / d, (ss * s + st * t) / square)
        two = np.where(flat, (ss * t - st * s) / d, (st * s + tt * t) / square)
        return np.asarray(one[:, None] * self.along + two[:, None] * self.beside)


def forces_on_blocks(model: Model, large: Large, points: Points) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """All that acts between blocks now, in large displacement: the block (K,), the force (3, K) N on it, and its arm
    (3, K) m from the centroid, along x, y and z; of blocks of tets from where that was.

    points  of patches, those that bear
    """
    bonds, joints, layout = large.bonds, model.joints, model.layout
    whole = bonds.alive
    pair = np.column_stack([joints.block_a, joints.block_b])[whole]
    block, force = (
        np.concatenate([points.block, pair]),
        np.concatenate([points.force, bond_forces(model, large, whole)]),
    )
    place = np.concatenate([points.place, joints.point[whole] + moved(model, large, joints.point[whole], pair[:, 1])])
    now = layout.centroid + large.near.motion.moved[: len(layout.centroid), :3]
    sides, force, place = block.T.ravel(), np.concatenate([force, -force]), np.concatenate([place, place])
    if (acting := acting_on_blocks(model.elements)) is not None:
        sides = np.concatenate([sides, acting.block])
        force, place = np.concatenate([force, acting.force]), np.concatenate([place, acting.place])
    return sides, force.T.copy(), (place - now[sides]).T.copy()


def forces_of_pairs(model: Model, large: Large, points: Points) -> tuple[np.ndarray, np.ndarray]:
    """Two blocks (K, 2) and the force (K, 3) N between them, in large displacement: of each patch and each joint.

    points  of patches, those that bear
    """
    whole, joints = large.bonds.alive, model.joints
    pair = np.column_stack([joints.block_a, joints.block_b])[whole]
    of_patches, of_bonds = (
        summed_in_runs(points.block, points.force),
        summed_in_runs(pair, bond_forces(model, large, whole)),
    )
    return np.concatenate([of_patches[0], of_bonds[0]]), np.concatenate([of_patches[1], of_bonds[1]])


def summed_in_runs(pair: np.ndarray, force: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pairs (K, 2) that follow each other, and the sum (K, 3) of the forces of each run of one pair."""
    if not len(pair):
        return pair, force
    first = np.flatnonzero(np.append(True, np.any(pair[1:] != pair[:-1], axis=1)))
    return pair[first], np.add.reduceat(force, first)


def bond_forces(model: Model, large: Large, which: np.ndarray) -> np.ndarray:
    """(K, 3) N on side a of some bonds, along x, y and z."""
    if large.members is not None:
        return large.bonds.force[which]
    frame = large.bonds.frames[model.joints.block_a[which]]
    return np.einsum("cij,cj->ci", frame, model.contacts.force[which])


def moved(model: Model, large: Large, point: np.ndarray, block: np.ndarray) -> np.ndarray:
    """(K, 3) m, how far points (K, 3) of some rigid or affine blocks have moved."""
    motion, arm = large.near.motion, point - model.layout.centroid[block]
    return np.asarray(motion.moved[block, :3] + np.einsum("kij,kj->ki", motion.frame[block], arm) - arm)
