"""Load, rotation and work of each joint face in a frame of a run: all faces at once."""

from typing import Any, NamedTuple

import numpy as np

from geometry.blocks import Joints
from geometry.joints.contact_points import contact_points
from geometry.joints.point_density import Density
from geometry.joints.second_moments import lacking_flexibility, of_polygons
from masonry.assembly.assemble import Assembly
from masonry.assembly.contact_pairs import points_along
from masonry.detection.spread import AT_CORNERS, rounds_of
from masonry.laws.state import JointProperties
from masonry.results.deformation import BlockCorners, Deformation
from masonry.results.dry_joints import LEAST_DAMAGE
from masonry.rows.history import Frame

FLAT = 1e-9
"""Of the largest second moment of the points of a face: a smaller one is that of points in one row. Of the square of
its area: where all are smaller, its points are at one place."""

MOST = 50
"""Joint faces that are looked at closely, those that matter most."""

SPREAD = np.array([[1.0, AT_CORNERS], [1.0, 1.0 - AT_CORNERS]])
"""Rounds of patches with points inside, of which the second lies as far inwards as their polar moment asks."""


class Faces(NamedTuple):
    """The J joint faces with contact points.

    patch      (J,) the number of the first of their polygons
    polygons   (J,) corners (K, 3) m of their convex polygons
    of         (C,) the face of each contact
    order      (C,) contacts sorted by face
    start      (J + 1,) where each face begins there
    area       (J,) m2
    middle     (J, 3) m
    normal     (J, 3)
    group      (J,) contact group
    stiffness  (J,) Pa/m, normal
    softness   (J, 3, 3) rad/(N m), by how much more each would bend and twist by a stress spread over its area than by
               its contact points, as long as it is elastic
    glued      (J,) whether it has a tensile strength
    arm        (C, 3) m, from the middle of its face to each point
    inverse    (J, 3, 3) 1/m4, of the second moments of area of the points; 0 where they are in one row
    tears_at   (C,) m, the opening beyond which a contact softens; infinite without a tensile strength
    """

    patch: np.ndarray
    polygons: list[list[np.ndarray]]
    of: np.ndarray
    order: np.ndarray
    start: np.ndarray
    area: np.ndarray
    middle: np.ndarray
    normal: np.ndarray
    group: np.ndarray
    stiffness: np.ndarray
    softness: np.ndarray
    glued: np.ndarray
    arm: np.ndarray
    inverse: np.ndarray
    tears_at: np.ndarray

    def sums(self, values: np.ndarray) -> np.ndarray:
        """(J, ...) of values (C, ...)."""
        return np.add.reduceat(values[self.order], self.start[:-1], axis=0)

    def contacts(self, face: int) -> np.ndarray:
        """The contacts of a face."""
        return self.order[self.start[face] : self.start[face + 1]]


class Look(NamedTuple):
    """The faces in a frame: normal force (J,) N, moment (J, 3) N m, turn (J, 3) rad, both as vectors towards where it
    opens; whether a contact has torn or softens (J,); twice the work (J,) J of bending with pulling, and of sliding, by
    the forces and movements of this frame: `bends` and `slides` all of it, `bent` and `slid` without what is elastic.
    """

    force: np.ndarray
    moment: np.ndarray
    turn: np.ndarray
    torn: np.ndarray
    bends: np.ndarray
    slides: np.ndarray
    bent: np.ndarray
    slid: np.ndarray


class Shear(NamedTuple):
    """How the faces are sheared in a frame: force (J, 3) N; twist (J,) N m and turn (J,) rad about the normals."""

    force: np.ndarray
    twist: np.ndarray
    turn: np.ndarray


def faces_of(assembly: Assembly) -> Faces:
    """The joint faces of a specimen."""
    joints, model = assembly.joints, assembly.model
    lacks = lacking_flexibility(joints)
    patch, of = np.unique(lacks.face, return_inverse=True)
    order = np.argsort(of, kind="stable")
    start = np.searchsorted(of[order], np.arange(len(patch) + 1))
    area = np.add.reduceat(joints.area[order], start[:-1])
    middle = np.add.reduceat((joints.area[:, None] * joints.point)[order], start[:-1]) / area[:, None]
    arm = joints.point - middle[of]
    second = np.add.reduceat(np.einsum("c,ca,cb->cab", joints.area, arm, arm)[order], start[:-1])
    group, properties = model.group[order[start[:-1]]], model.groups.properties
    stiffness, shear = (
        np.array([np.mean(getattr(joint, name)) for joint in properties])[group]
        for name in ("normal_stiffness", "shear_stiffness")
    )
    glued = np.array([is_glued(joint) for joint in properties], dtype=bool)[group]
    second *= (np.trace(second, axis1=1, axis2=2) > FLAT * area**2)[:, None, None]
    inverse = np.linalg.pinv(second, rcond=FLAT, hermitian=True)
    normal = joints.normal[order[start[:-1]]]
    tears_at, bounds = np.full(len(joints.area), np.inf), model.groups.bounds
    for joint, first, end in zip(properties, bounds[:-1], bounds[1:], strict=True):
        if is_glued(joint):
            tears_at[first:end] = np.asarray(joint.tensile_strength) / np.asarray(joint.normal_stiffness)
    softness = lacks.over(stiffness, shear, patch)
    own = _polygons(joints, lacks.whole, patch)
    return Faces(
        patch, own, of, order, start, area, middle, normal, group, stiffness, softness, glued, arm, inverse, tears_at
    )


def _polygons(joints: Joints, first_patch: np.ndarray, patch: np.ndarray) -> list[list[np.ndarray]]:
    """Corners (K, 3) m of the polygons of each face, which are those with the same first one."""
    polygons: dict[int, list[np.ndarray]] = {number: [] for number in patch.tolist()}
    bounds = joints.patch_start.tolist()
    for first, begin, end in zip(first_patch.tolist(), bounds[:-1], bounds[1:], strict=True):
        if first in polygons:
            polygons[first].append(joints.patch_points[begin:end])
    return list(polygons.values())


def is_glued(joint: JointProperties) -> bool:
    """Whether contacts of a group have a tensile strength, be it one that scatters."""
    return joint.tensile_strength is not None and bool(np.any(np.asarray(joint.tensile_strength) > 0.0))


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
    return Look(
        force,
        moment,
        turn,
        faces.sums(((frame.damage_tension > LEAST_DAMAGE) | (frame.opening > faces.tears_at)).astype(float)) > 0.0,
        _work(moment, turn) + tension * np.maximum(opening, 0.0),
        faces.sums(shear * frame.slip),
        _work(moment, turn - elastic) + tension * np.maximum(opening - elastic_opening, 0.0),
        faces.sums(shear * np.maximum(frame.slip - back, 0.0)),
    )


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


def law_of(assembly: Assembly, faces: Faces, face: int) -> tuple[Any, JointProperties]:
    """Parameters and properties of a face: those of one of its contacts, where they scatter; of patches in its place
    what blocks do that meet."""
    groups, group = assembly.model.groups, faces.group[face]
    if are_patches(assembly, faces, face):
        assert assembly.pairs is not None
        return assembly.pairs.laws[assembly.model.group_names[group]]
    contact = faces.contacts(face)[0] - groups.bounds[group]
    return _of(groups[0][group], contact), _of(groups[1][group], contact)


def are_patches(assembly: Assembly, faces: Faces, face: int) -> bool:
    """Whether patches bear in the place of a face that never had a bond."""
    unbound = assembly.pairs is not None and not faces.glued[face]
    return unbound and not assembly.model.alive[faces.contacts(face)].any()


def _of(fields: Any, contact: int) -> Any:
    """The same NamedTuple with numbers of one contact of its group, where they scatter."""
    return type(fields)(*(value if np.ndim(value) == 0 else value[contact] for value in fields))


def corners_of(faces: Faces, face: int) -> np.ndarray:
    """(K, 3) m of the polygons of a joint face."""
    return np.concatenate(faces.polygons[face])


def points_of(polygons: list[np.ndarray], density: Density) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 3) m and areas (n,) m2 of contact points of a density on convex polygons (K, 3) m."""
    each = [contact_points(corners[None], np.array([len(corners)]), density)[1:] for corners in polygons]
    point, area = zip(*each, strict=True)
    return np.concatenate(point), np.concatenate(area)


def own_points(assembly: Assembly, faces: Faces, face: int) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 3) m and areas (n,) m2 at which a face bears: its contact points, or those of the patch in their place
    that has not moved."""
    joints, contacts = assembly.joints, faces.contacts(face)
    meshed = (joints.node_a[contacts] >= 0).any() or (joints.node_b[contacts] >= 0).any()
    if meshed or not are_patches(assembly, faces, face):
        return joints.point[contacts], joints.area[contacts]
    return patch_points(faces, face, _rounds(assembly))


def patch_points(faces: Faces, face: int, rounds: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 3) m and areas (n,) m2 of the patch of a face that has not moved, in rounds (m, 2)."""
    normal, parts = faces.normal[face], []
    for corners in faces.polygons[face]:
        point, area = contact_points(corners[None], np.array([len(corners)]), Density("vertex", 2))[1:]
        middle = area @ point / area.sum()
        polar = float(np.trace(of_polygons(corners[None], normal[None], middle[None])[0]))
        parts.append(_of_patch(point, area, middle, polar, rounds))
    places, areas = zip(*parts, strict=True)
    return np.concatenate(places), np.concatenate(areas)


def _rounds(assembly: Assembly) -> np.ndarray:
    """(m, 2) of `rounds_of` for the patches of a scene."""
    if assembly.scene.specimen.patch_points == "spread":
        return SPREAD
    return rounds_of(points_along(assembly.scene, assembly.model.crushes))


def _of_patch(
    corner: np.ndarray, area: np.ndarray, middle: np.ndarray, polar: float, rounds: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Points and areas as `detection/spread.py` puts them from corners (K, 3) m with areas (K,) m2, of a polygon with
    this polar moment (m4)."""
    arm = corner - middle
    share = polar / float(area @ (arm**2).sum(axis=1))
    place, weight = rounds.T
    inside = float(weight[1:] @ place[1:] ** 2)
    if inside > 0.0:
        place = np.append(1.0, place[1:] * min(np.sqrt(max(share - weight[0], 0.0) / inside), 1.0 / place[1]))
    point = middle + place[:, None, None] * arm
    return point.reshape(-1, 3), np.outer(weight, area).ravel()
