"""Load, rotation and work of each joint face in a frame of a run: all faces at once."""

from typing import NamedTuple

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.estimates.joint_faces import Faces
from masonry.results.deformation import BlockCorners, Deformation
from masonry.results.dry_joints import LEAST_DAMAGE
from masonry.rows.history import Frame


class JointWork(NamedTuple):
    """(J,) J, twice the work of joint faces by the forces and movements of a frame: of bending with pulling, and of
    sliding."""

    bending: np.ndarray
    sliding: np.ndarray

    @property
    def total(self) -> float:
        """J, of all faces."""
        return float((self.bending + self.sliding).sum())


class Look(NamedTuple):
    """The joint faces in a frame.

    force      (J,) N, normal, above 0 where it pulls
    moment     (J, 3) N m, a vector towards where a face opens
    turn       (J, 3) rad, a vector towards where a face opens
    torn       (J,) whether a contact has torn or softens
    work       all of it
    inelastic  the part of the work that is not elastic
    """

    force: np.ndarray
    moment: np.ndarray
    turn: np.ndarray
    torn: np.ndarray
    work: JointWork
    inelastic: JointWork


class Shear(NamedTuple):
    """How the faces are sheared in a frame: force (J, 3) N; twist (J,) N m and turn (J,) rad about the normals."""

    force: np.ndarray
    twist: np.ndarray
    turn: np.ndarray


def look_at(assembly: Assembly, faces: Faces, frame: Frame) -> Look:
    """The joint faces in a frame."""
    area, model = assembly.joints.area, assembly.model
    stiffness = np.array([np.mean(joint.shear_stiffness) for joint in model.groups.properties])[model.group]
    normal = area * frame.normal_stress
    force, moment = faces.sums(normal), faces.sums(normal[:, None] * faces.arm)
    opening = faces.sums(area * frame.opening) / faces.area
    turn = np.einsum("jab,jb->ja", faces.inverse, faces.sums((area * frame.opening)[:, None] * faces.arm))
    elastic = np.einsum("jab,jb->ja", faces.inverse, moment) / faces.stiffness[:, None]
    tension, elastic_opening = np.maximum(force, 0.0), force / (faces.stiffness * faces.area)
    shear = area * frame.shear_stress
    with np.errstate(invalid="ignore", divide="ignore"):  # a glue without shear stiffness has no shear stress
        back = np.nan_to_num(frame.shear_stress / stiffness)
    torn = faces.sums(((frame.damage_tension > LEAST_DAMAGE) | (frame.opening > faces.tears_at)).astype(float)) > 0.0
    work = JointWork(_work(moment, turn) + tension * np.maximum(opening, 0.0), faces.sums(shear * frame.slip))
    inelastic = JointWork(
        _work(moment, turn - elastic) + tension * np.maximum(opening - elastic_opening, 0.0),
        faces.sums(shear * np.maximum(frame.slip - back, 0.0)),
    )
    return Look(force, moment, turn, torn, work, inelastic)


def shear_of(assembly: Assembly, faces: Faces, frame: Frame) -> Shear:
    """How joint faces are sheared in a frame: the shear stress of each contact acts along its slip, if no patches take
    its place."""
    joints = assembly.joints
    field, every = Deformation(BlockCorners(assembly.specimen.blocks), frame), np.arange(len(joints.area))
    a, b = field.sides(joints, every, joints.point)
    back = np.linalg.inv(np.eye(3) + field.gradient)
    slip = np.einsum("cij,cj->ci", back[joints.block_a], b - a)
    slip -= np.einsum("ci,ci->c", slip, joints.normal)[:, None] * joints.normal
    length = np.linalg.norm(slip, axis=1)[:, None]
    along = np.divide(slip, length, out=np.zeros_like(slip), where=length > 0.0)
    force = (joints.area * frame.shear_stress)[:, None] * along if frame.shear is None else frame.shear
    twist = np.einsum("ci,ci->c", joints.normal, np.cross(faces.arm, force))
    first = faces.order[faces.start[:-1]]
    spin = back[joints.block_a[first]] @ (np.eye(3) + field.gradient[joints.block_b[first]])
    axial = 0.5 * np.stack([spin[:, j, i] - spin[:, i, j] for i, j in ((1, 2), (2, 0), (0, 1))], axis=1)
    return Shear(faces.sums(force), faces.sums(twist), np.einsum("fi,fi->f", axial, faces.normal))


def _work(moment: np.ndarray, turn: np.ndarray) -> np.ndarray:
    return np.maximum(np.einsum("ja,ja->j", moment, turn), 0.0)
