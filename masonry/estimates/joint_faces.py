"""The joint faces of a specimen, all at once: where they are, how stiff, what holds them, and their laws."""

from typing import Any, NamedTuple

import numpy as np

from geometry.joints.faces.second_moments import lacking_flexibility
from geometry.joints.faces.whole_faces import polygons_by_face
from masonry.assembly.assemble import Assembly
from masonry.laws.state import JointProperties

FLAT = 1e-9
"""Of the largest second moment of the points of a face: a smaller one is that of points in one row. Of the square of
its area: where all are smaller, its points are at one place."""

MOST = 50
"""Joint faces that are looked at closely, those that matter most."""


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
    dry        (J,) whether it has friction, or a strength of 0, and no tension
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
    dry: np.ndarray
    arm: np.ndarray
    inverse: np.ndarray
    tears_at: np.ndarray

    def sums(self, values: np.ndarray) -> np.ndarray:
        """(J, ...) of values (C, ...)."""
        return np.add.reduceat(values[self.order], self.start[:-1], axis=0)

    def contacts(self, face: int) -> np.ndarray:
        """The contacts of a face."""
        return self.order[self.start[face] : self.start[face + 1]]


def faces_of(assembly: Assembly) -> Faces:
    """The joint faces of a specimen."""
    joints, model = assembly.joints, assembly.model
    lacks = lacking_flexibility(joints)
    points = lacks.points
    patch, of = np.unique(points.face, return_inverse=True)
    order = np.argsort(of, kind="stable")
    start = np.searchsorted(of[order], np.arange(len(patch) + 1))
    area, middle, second = points.area[patch], points.middle[patch], points.second[patch]
    group, properties = model.group[order[start[:-1]]], model.groups.properties
    stiffness, shear = (
        np.array([np.mean(getattr(joint, name)) for joint in properties])[group]
        for name in ("normal_stiffness", "shear_stiffness")
    )
    glued = np.array([is_glued(joint) for joint in properties], dtype=bool)[group]
    dry = dry_groups(assembly)[group]
    second *= (np.trace(second, axis1=1, axis2=2) > FLAT * area**2)[:, None, None]
    inverse = np.linalg.pinv(second, rcond=FLAT, hermitian=True)
    normal = joints.normal[order[start[:-1]]]
    tears_at, bounds = np.full(len(joints.area), np.inf), model.groups.bounds
    for joint, first, end in zip(properties, bounds[:-1], bounds[1:], strict=True):
        if is_glued(joint):
            tears_at[first:end] = np.asarray(joint.tensile_strength) / np.asarray(joint.normal_stiffness)
    softness = lacks.over(stiffness, shear, patch)
    polygons = polygons_by_face(joints, points.whole, patch)
    return Faces(
        *(patch, polygons, of, order, start, area, middle, normal, group, stiffness, softness, glued, dry),
        *(points.arm, inverse, tears_at),
    )


def is_glued(joint: JointProperties) -> bool:
    """Whether contacts of a group have a tensile strength, be it one that scatters."""
    return joint.tensile_strength is not None and bool(np.any(np.asarray(joint.tensile_strength) > 0.0))


def is_elastic(joint: JointProperties) -> bool:
    """Whether contacts of a group bear whatever comes, as their law has no strength."""
    return joint.tensile_strength is None and joint.tan_friction is None


def dry_groups(assembly: Assembly) -> np.ndarray:
    """(G,) which contact groups have a strength, and no tension; of patches in their place what blocks do that meet."""
    model, pairs, dry = assembly.model, assembly.pairs, []
    for name, joint in zip(model.group_names, model.groups.properties, strict=True):
        if pairs is not None and is_elastic(joint):
            joint = pairs.laws.get(name, (None, joint))[1]
        dry.append(not is_elastic(joint) and not is_glued(joint))
    return np.array(dry, dtype=bool)


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
