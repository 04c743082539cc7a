"""Content of a picture of cracks, as plain arrays: the outlines of blocks, and the contacts seen edge-on."""

from dataclasses import dataclass, fields

import numpy as np

from geometry.blocks import Blocks, Joints
from geometry.polyhedra.measures import face_areas_normals_centroids
from masonry.pictures.camera import Camera
from masonry.pictures.hidden_surfaces import unit_edges
from masonry.results.deformation import Deformation
from masonry.results.dry_joints import crushed
from masonry.rows.history import Frame

EDGE_ON = 0.5
"""Contacts whose normal makes a smaller cosine with the line of sight are seen edge-on."""


@dataclass(frozen=True)
class Outlines:
    """The faces toward the viewer, farthest first.

    face   (n,) face numbers    layer  (n,) depth rank of each face, 0 the farthest
    outer  (E,) of their edges, face by face, whether it bounds the unit (true) or lies between cells of one unit
    """

    face: np.ndarray
    layer: np.ndarray
    outer: np.ndarray


def outlines(blocks: Blocks, camera: Camera, layers: int = 16) -> Outlines:
    """The faces that look toward the viewer, in at most `layers` steps of depth."""
    _, normal, middle = face_areas_normals_centroids(blocks)
    depth = middle @ camera.toward
    span = np.ptp(depth)
    layer = np.round((depth - depth.min()) / span * (layers - 1)).astype(int) if span > 0 else np.zeros(len(depth), int)
    face = np.flatnonzero(normal @ camera.toward > 0.1)
    face = face[np.argsort(layer[face], kind="stable")]
    return Outlines(face, layer[face], unit_edges(blocks, face, normal))


@dataclass(frozen=True)
class CrackLines:
    """Contacts seen edge-on: one straight piece per row of contact points through the thickness.

    start, end    (n, 3) m, where the piece stands before loading
    contact       (n,) a contact point on it
    damage        (n,) area-weighted mean damage, 0 .. 1
    tension_led   (n,) damage by tension at least as large as by shear
    opening       (n,) m, area-weighted mean of how far the two faces moved apart or along each other
    dry           (n,) moved for good without damage: see dry_joints.py; false until that is looked at
    crushed       (n,) closed for good, most of the row; the opening is then that closing
    """

    start: np.ndarray
    end: np.ndarray
    contact: np.ndarray
    damage: np.ndarray
    tension_led: np.ndarray
    opening: np.ndarray
    dry: np.ndarray
    crushed: np.ndarray

    def select(self, mask: np.ndarray) -> "CrackLines":
        return CrackLines(**{entry.name: getattr(self, entry.name)[mask] for entry in fields(self)})

    def displaced(self, joints: Joints, field: Deformation, magnification: float) -> np.ndarray:
        """(n, 2, 3) m, both ends of each piece midway between the two displaced sides."""
        ends = []
        for point in (self.start, self.end):
            first, second = field.sides(joints, self.contact, point)
            ends.append(point + 0.5 * magnification * (first + second))
        return np.stack(ends, axis=1)


def crack_lines(joints: Joints, frame: Frame, camera: Camera) -> CrackLines:
    """Every contact patch seen edge-on, cut midway between neighbouring rows of its contact points."""
    seen = np.flatnonzero(np.abs(joints.normal @ camera.toward) < EDGE_ON)
    along = np.cross(joints.normal[seen], camera.toward)
    along /= np.linalg.norm(along, axis=1)[:, None]
    patch = joints.patch[seen]
    low, high = _patch_ends(joints, patch, along)
    place = np.einsum("ij,ij->i", joints.point[seen], along)
    order = np.lexsort((place, patch))
    seen, along, patch, place, low, high = (a[order] for a in (seen, along, patch, place, low, high))
    fresh = np.ones(len(seen), dtype=bool)
    fresh[1:] = (patch[1:] != patch[:-1]) | (place[1:] - place[:-1] > 1e-6 * camera.size)
    row = np.cumsum(fresh) - 1
    weight = joints.area[seen]
    whole = np.bincount(row, weight)

    def mean(values: np.ndarray) -> np.ndarray:
        return np.bincount(row, weight * values) / whole

    patch, along, low, high = patch[fresh], along[fresh], low[fresh], high[fresh]
    middle = mean(place)
    same = patch[1:] == patch[:-1]
    between = 0.5 * (middle[1:] + middle[:-1])
    begin, finish = low.copy(), high.copy()
    begin[1:][same], finish[:-1][same] = between[same], between[same]
    centre = np.stack([mean(joints.point[seen, axis]) for axis in range(3)], axis=1)
    crushing = mean(crushed(frame)[seen].astype(float)) > 0.5
    parted = mean(frame.parted[seen])
    closing = mean(np.zeros(len(seen)) if frame.crushing is None else frame.crushing[seen])
    return CrackLines(
        start=centre + (begin - middle)[:, None] * along,
        end=centre + (finish - middle)[:, None] * along,
        contact=seen[fresh],
        damage=mean(frame.damage[seen]),
        tension_led=mean(frame.damage_tension[seen]) >= mean(frame.damage_shear[seen]),
        opening=np.where(crushing, closing, parted),
        dry=np.zeros(int(fresh.sum()), dtype=bool),
        crushed=crushing,
    )


def _patch_ends(joints: Joints, patch: np.ndarray, along: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where the patch of each contact point ends along the unit vector `along` (n, 3): lowest and highest place."""
    count = len(joints.patch_start) - 1
    axis = np.zeros((count, 3))
    axis[patch] = along
    owner = np.repeat(np.arange(count), np.diff(joints.patch_start))
    place = np.einsum("ij,ij->i", joints.patch_points, axis[owner])
    low, high = np.full(count, np.inf), np.full(count, -np.inf)
    np.minimum.at(low, owner, place)
    np.maximum.at(high, owner, place)
    return low[patch], high[patch]
