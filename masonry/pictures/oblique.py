"""A specimen from the front, the right and above: its displaced faces, and its cracks where they come out on them.

The damaged parts of the joints themselves are drawn first: they show where the faces before them have parted.
"""

from abc import abstractmethod
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from geometry.blocks import Blocks, Joints
from geometry.joints.tributary_areas import tiles
from geometry.polyhedra.indexing import following, ranges
from geometry.polyhedra.measures import face_areas_normals_centroids
from masonry.pictures.camera import iso_view
from masonry.pictures.crack_style import crack_colours, crack_widths, drawing_order
from masonry.pictures.drawing import Drawing
from masonry.pictures.faces import FaceDrawing
from masonry.pictures.hidden_surfaces import Piece, visible_pieces
from masonry.pictures.overlays.axle_arrows import draw_axles_of
from masonry.pictures.overlays.element_lines import draw_elements_of
from masonry.results.deformation import BlockCorners, Deformation
from masonry.results.dry_joints import LEAST_DAMAGE, NARROW, as_it_stands, crushed, moved_undamaged
from masonry.rows.history import Frame

if TYPE_CHECKING:
    from masonry.results.data import ResultData

ALONG = 0.9
"""A face whose normal makes a larger cosine with that of a joint is the joint's own, not one that it comes out on."""
AT_ONCE = 500_000
"""Edges of tiles whose faces are looked for together: of all at once a wall of 50,000 bricks would need gigabytes."""


@dataclass(frozen=True)
class JointCracks:
    """The contacts to draw (n,): numbers, damage, how far the faces moved apart or along each other, or towards each
    other where they crushed (m), whether they moved for good without damage, and whether they crushed."""

    contact: np.ndarray
    damage: np.ndarray
    tension_led: np.ndarray
    opening: np.ndarray
    dry: np.ndarray
    crushed: np.ndarray


class FacesDrawing(Drawing):
    """Draws faces from the farthest to the nearest, each with the cracks that come out on it.

    start, tile  the corners (m) of the tiles of all contacts, and where those of each begin
    """

    shape: BlockCorners
    start: np.ndarray
    tile: np.ndarray

    @abstractmethod
    def pieces(self, frame: Frame, times: float) -> list[Piece]:
        """The faces to draw, farthest first, displacements `times` larger."""

    @abstractmethod
    def last_pieces(self, frame: Frame, times: float, pieces: list[Piece]) -> np.ndarray:
        """(E,) for the edge after each corner of a tile the number of the piece that it is drawn after, -1 for none."""

    def canvas(self) -> FaceDrawing:
        """Drawing to which pieces are added."""
        return FaceDrawing(self.result.specimen.blocks, self.camera)

    def draw(self, axes: Any, frame: Frame, cracks: JointCracks, times: float, scale: float) -> None:
        pieces, faces = self.pieces(frame, times), self.canvas()
        owner, corner = ranges(self.start[cracks.contact], np.diff(self.start)[cracks.contact])
        sides = Deformation(self.shape, frame).sides(self.result.joints, cracks.contact[owner], self.tile[corner])
        places = self.tile[corner] + 0.5 * times * (sides[0] + sides[1])
        starts = np.searchsorted(owner, np.arange(len(cracks.contact) + 1))
        self.draw_joints(faces, cracks, np.split(places, starts[1:-1]))
        lines = crack_edges(cracks, places, starts, self.last_pieces(frame, times, pieces)[corner], scale)
        for number, piece in enumerate(pieces):
            faces.add_piece(piece)
            for line in lines.get(number, ()):
                faces.add_line(*line)
        faces.draw(axes)
        draw_elements_of(axes, self.result, frame, self.camera, times, pieces)
        draw_axles_of(axes, self.result, frame, self.camera)
        self.draw_thrust(axes, frame, times, pieces)

    def draw_joints(self, faces: FaceDrawing, cracks: JointCracks, tiles: list[np.ndarray]) -> None:
        """Visible part of the joints of some cracks, whose tiles are given, behind all faces: none."""

    def draw_thrust(self, axes: Any, frame: Frame, times: float, pieces: list[Piece]) -> None:
        """Draw the thrust line in front of these faces: none."""


class SolidDrawing(FacesDrawing):
    """Of small displacement: which face hides which is found once."""

    def __init__(self, result: "ResultData") -> None:
        blocks, joints = result.specimen.blocks, result.joints
        self.result, self.camera = result, iso_view(blocks.points)
        size = self.camera.size
        self.shape = BlockCorners(blocks)
        self.visible = visible_pieces(blocks, joints, self.camera)
        self.piece_block = blocks.face_block()[[piece.face for piece in self.visible]]
        self.start, self.tile = tiles(joints)
        last = _last_beside(blocks, self.visible, 1e-5 * size)
        self.after = edges_on_faces(blocks, joints, self.start, self.tile, last, 1e-6 * size)

    def cracks(self, frame: Frame) -> JointCracks:
        return joint_cracks(self.result, frame)

    def pieces(self, frame: Frame, times: float) -> list[Piece]:
        sizes = [len(piece.corners) for piece in self.visible]
        corners = np.concatenate([piece.corners for piece in self.visible])
        block = np.repeat(self.piece_block, sizes)
        moved = corners + times * Deformation(self.shape, frame).at(block, corners, np.full(len(block), -1))
        parts = np.split(moved, np.cumsum(sizes)[:-1])
        return [replace(piece, corners=part) for piece, part in zip(self.visible, parts, strict=True)]

    def last_pieces(self, frame: Frame, times: float, pieces: list[Piece]) -> np.ndarray:
        return self.after

    def draw_joints(self, faces: FaceDrawing, cracks: JointCracks, tiles: list[np.ndarray]) -> None:
        colours = crack_colours(cracks)
        for k in np.argsort(cracks.damage, kind="stable").tolist():
            faces.add_polygon(tiles[k], colours[k])


def joint_cracks(result: "ResultData", frame: Frame) -> JointCracks:
    """The contacts of a frame that are damaged, or have moved for good without damage, by NARROW or more."""
    frame = as_it_stands(result, frame)
    dry = moved_undamaged(result, frame)
    crushing = crushed(frame)
    moved = frame.parted if frame.crushing is None else np.where(crushing, frame.crushing, frame.parted)
    c = np.flatnonzero(((frame.damage > LEAST_DAMAGE) | dry | crushing) & (moved >= NARROW))
    led = frame.damage_tension[c] >= frame.damage_shear[c]
    return JointCracks(c, frame.damage[c], led, moved[c], dry[c], crushing[c])


def crack_edges(
    cracks: JointCracks, moved: np.ndarray, starts: np.ndarray, after: np.ndarray, scale: float
) -> dict[int, list[tuple[np.ndarray, Any, float]]]:
    """Ends, colour and width of the edges that are drawn after a piece, by its number.

    moved   (n, 3) m, the displaced corners of the tiles of all cracks; starts  where those of each crack begin
    after   (n,) the piece that the edge from each corner is drawn after, -1 for none
    """
    colours, wide = crack_colours(cracks), crack_widths(cracks, scale)
    lines: dict[int, list[tuple[np.ndarray, Any, float]]] = {}
    for k in drawing_order(cracks).tolist():
        part, piece = moved[starts[k] : starts[k + 1]], after[starts[k] : starts[k + 1]].tolist()
        for side in range(len(part)):
            if piece[side] >= 0:
                ends = part[[side, (side + 1) % len(part)]]
                lines.setdefault(piece[side], []).append((ends, colours[k], float(wide[k])))
    return lines


def _last_beside(blocks: Blocks, pieces: list[Piece], width: float) -> np.ndarray:
    """(F,) the last piece that follows those of a face in the same plane, -1 for faces of no piece.

    Planes within width (m) are one. A line drawn after it is hidden by what stands before the plane, not by what is in
    it.
    """
    _, normal, middle = face_areas_normals_centroids(blocks)
    face = np.array([piece.face for piece in pieces], dtype=np.int64)
    height = np.einsum("ni,ni->n", middle[face], normal[face])
    other = (np.abs(np.diff(normal[face], axis=0)).max(axis=1) > 1e-5) | (np.abs(np.diff(height)) > width)
    ends = np.append(np.flatnonzero(other), len(face) - 1)
    last = np.full(len(normal), -1)
    last[face] = ends[np.searchsorted(ends, np.arange(len(face)))]
    return last


def edges_on_faces(
    blocks: Blocks, joints: Joints, start: np.ndarray, tile: np.ndarray, last: np.ndarray, width: float
) -> np.ndarray:
    """(E,) for the edge after each corner of a tile: the last piece of the visible faces that it is on, -1 if on none.

    last   (F,) the last piece of each face in the order of drawing, -1 where none is seen
    width  m, how far from a face counts as on it
    """
    return last_piece(last, len(tile), *faces_beside(blocks, joints, start, tile, width))


def last_piece(last: np.ndarray, edges: int, edge: np.ndarray, face: np.ndarray) -> np.ndarray:
    """(E,) the last piece of all faces (n,) that an edge (n,) is on, -1 where none is seen."""
    after = np.full(edges, -1)
    np.maximum.at(after, edge, last[face])
    return after


def faces_beside(
    blocks: Blocks, joints: Joints, start: np.ndarray, tile: np.ndarray, width: float
) -> tuple[np.ndarray, np.ndarray]:
    """Edges of tiles (n,) and faces of their two blocks (n,) on which they come out, within width (m)."""
    contact, after = np.repeat(np.arange(len(start) - 1), np.diff(start)), following(start)
    faces = np.diff(blocks.block_face_start)
    _, normal, middle = face_areas_normals_centroids(blocks)
    pairs = []
    for some in np.split(np.arange(len(tile)), range(AT_ONCE, len(tile), AT_ONCE)):
        for block in (joints.block_a[contact[some]], joints.block_b[contact[some]]):
            k, face = ranges(blocks.block_face_start[block], faces[block])
            edge = some[k]
            other = np.abs(np.einsum("ni,ni->n", normal[face], joints.normal[contact[edge]])) < ALONG
            edge, face = edge[other], face[other]
            ends = [np.abs(np.einsum("ni,ni->n", tile[e] - middle[face], normal[face])) for e in (edge, after[edge])]
            on = np.maximum(*ends) <= width
            pairs.append((edge[on], face[on]))
    edges, beside = zip(*pairs, strict=True)
    return np.concatenate(edges), np.concatenate(beside)
