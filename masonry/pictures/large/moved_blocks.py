"""Blocks that have moved far, from any side: what is seen of them, farthest first, is found anew in every frame."""

from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from geometry.blocks import Blocks
from geometry.joints.covered import covered_fractions
from geometry.joints.find import patch_faces
from geometry.joints.tributary_areas import tiles
from geometry.polyhedra.indexing import ranges
from geometry.polyhedra.measures import face_areas_normals_centroids
from geometry.polyhedra.polygons import pad
from masonry.pictures.camera import Camera, camera_of
from masonry.pictures.faces import FaceDrawing
from masonry.pictures.hidden_surfaces import COVERED, Piece, behind_others
from masonry.pictures.large.depth_order import farthest_first
from masonry.pictures.large.edges import Continued, continued
from masonry.pictures.large.nearness import reach
from masonry.pictures.oblique import FacesDrawing, JointCracks, faces_beside, joint_cracks, last_piece
from masonry.pictures.thrust_line import thrust_line
from masonry.results.deformation import BlockCorners, Deformation
from masonry.rows.history import Frame

if TYPE_CHECKING:
    from masonry.results.data import ResultData

EDGE_ON = 1e-3
"""Faces whose normal makes a smaller cosine with the line of sight are not seen."""
CLOSED = 0.01
"""Share of the reach of a joint up to which its two sides are drawn as one."""
GRAZED = 0.1
"""On faces whose normal makes a smaller one no crack is drawn: it would look like an edge."""


class MovedDrawing(FacesDrawing):
    """Of large displacement: which face hides which is found in every frame."""

    def __init__(self, result: "ResultData", view: str) -> None:
        blocks, joints = result.specimen.blocks, result.joints
        self.result = result
        self.camera = camera_of(view, result.specimen, [frame.corners for frame in result.history.frames])
        self.thrust = thrust_line(result, self.camera) if view != "iso" else None
        self.shape, self.edges, self.reach = BlockCorners(blocks), continued(blocks), reach(result)
        self.covered = covered_fractions(blocks, joints) >= COVERED
        self.faces = patch_faces(blocks, joints)[joints.patch]
        self.start, self.tile = tiles(joints)
        self.beside = faces_beside(blocks, joints, self.start, self.tile, 1e-6 * self.camera.size)

    def cracks(self, frame: Frame) -> JointCracks:
        """The contacts to draw: those whose two sides are still near, and come out on a face toward the viewer."""
        cracks = joint_cracks(self.result, frame)
        near = (self._gaps(frame) <= self.reach)[cracks.contact]
        blocks = self.moved(frame, 1.0)
        after = self._after(blocks, _toward(blocks, self.camera))
        comes_out = np.maximum.reduceat(after, self.start[:-1]) >= 0 if len(after) else near
        shown = near & comes_out[cracks.contact]
        return JointCracks(**{entry.name: getattr(cracks, entry.name)[shown] for entry in fields(cracks)})

    def moved(self, frame: Frame, times: float) -> Blocks:
        """The blocks of a frame, displacements `times` larger."""
        blocks = self.result.specimen.blocks
        return replace(blocks, points=blocks.points + times * frame.corners)

    def canvas(self) -> FaceDrawing:
        return FaceDrawing(self.result.specimen.blocks, self.camera, lamp_of(self.camera))

    def last_pieces(self, frame: Frame, times: float, pieces: list[Piece]) -> np.ndarray:
        return self._after(self.moved(frame, times), np.array([piece.face for piece in pieces], dtype=np.int64))

    def draw_thrust(self, axes: Any, frame: Frame, times: float, pieces: list[Piece]) -> None:
        if self.thrust is not None:
            self.thrust.draw(axes, self.camera.project(self._uncovered(frame, times, pieces)))

    def forces_at(self, frame: Frame, times: float) -> np.ndarray:
        return self._uncovered(frame, times, self.pieces(frame, times))

    def pieces(self, frame: Frame, times: float) -> list[Piece]:
        """The faces to draw, farthest first: those toward the viewer but for those in joints that are closed."""
        is_open = self.faces[times * self._gaps(frame) > CLOSED * self.reach]
        hidden = self.covered.copy()
        hidden[is_open[is_open >= 0]] = False
        return seen_pieces(self.moved(frame, times), self.camera, self.edges, hidden)

    def _gaps(self, frame: Frame) -> np.ndarray:
        """(C,) m, how far apart the two sides of each contact are."""
        joints = self.result.joints
        first, second = Deformation(self.shape, frame).sides(joints, np.arange(len(joints.area)), joints.point)
        return np.asarray(np.linalg.norm(first - second, axis=1))

    def _uncovered(self, frame: Frame, times: float, pieces: list[Piece]) -> np.ndarray:
        """(J, 3) m, the places of the thrust line without those that other units than their own two hide."""
        if self.thrust is None:
            return np.zeros((0, 3))
        place = self.thrust.displaced(self.result, frame, times)
        if pieces and len(place):
            units = self.thrust.joints.units[self.thrust.order]
            place[behind_others(place, units, pieces, self.result.specimen.blocks, self.camera)] = np.nan
        return place

    def _after(self, blocks: Blocks, seen: np.ndarray) -> np.ndarray:
        """(E,) for each edge of a tile the place in `seen`, faces (n,) in the order of drawing, of the last that it
        comes out on; -1 where there is none."""
        normal = face_areas_normals_centroids(blocks)[1]
        rank = np.full(len(normal), -1)
        rank[seen] = np.arange(len(seen))
        rank[normal @ self.camera.toward < GRAZED] = -1
        return last_piece(rank, len(self.tile), *self.beside)


def seen_pieces(blocks: Blocks, camera: Camera, edges: Continued, hidden: np.ndarray | None = None) -> list[Piece]:
    """The faces toward the viewer of blocks that have moved, whole and farthest first, without the hidden ones (F,)."""
    seen = _toward(blocks, camera)
    if hidden is not None:
        seen = seen[~hidden[seen]]
    if len(seen) == 0:
        return []
    sides = np.diff(blocks.face_start)[seen]
    start = np.concatenate([[0], np.cumsum(sides)])
    index = ranges(blocks.face_start[seen], sides)[1]
    order = farthest_first(pad(blocks.points, start, blocks.face_points[index])[0], camera)
    unit, block = edges.kinds(blocks)
    pieces = []
    for face in seen[order].tolist():
        corners = slice(blocks.face_start[face], blocks.face_start[face + 1])
        pieces.append(Piece(face, blocks.points[blocks.face_points[corners]], unit[corners], block[corners]))
    return pieces


def _toward(blocks: Blocks, camera: Camera) -> np.ndarray:
    """Numbers of the faces that look toward the viewer."""
    area, normal, _ = face_areas_normals_centroids(blocks)
    return np.flatnonzero((area > 0.0) & (normal @ camera.toward > EDGE_ON))


def lamp_of(camera: Camera) -> np.ndarray:
    """From where light falls: over the left shoulder of the viewer, so that what turned has a shade from any side."""
    return np.asarray(0.91 * camera.toward - 0.27 * camera.right + 0.23 * camera.up)
