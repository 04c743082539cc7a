"""Cameras: parallel projections of a specimen from the front, from behind, from the side, or from the front, the right
and above."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from geometry.blocks import Blocks, Specimen
from geometry.specimens.placed import FLOOR
from masonry.scene.tables.specimen import table_of

if TYPE_CHECKING:
    from masonry.results.data import ResultData

VIEWS = ("front", "back", "side", "iso")
AZIMUTH, ELEVATION = np.radians(-55.0), np.radians(25.0)
"""From where "iso" looks, as matplotlib counts these angles."""
FALLS = 0.1
"""Share of the size of a specimen: what moves by more falls."""
OUT = 4.0
"""The same: what moves by more, as it has left the floor, is out of the picture, where all else would be a point."""


@dataclass(frozen=True)
class Camera:
    """Unit vectors (3,) to the right, up and toward the viewer, and the largest extent (m) of what is seen."""

    right: np.ndarray
    up: np.ndarray
    toward: np.ndarray
    size: float

    @property
    def along_an_axis(self) -> bool:
        """Whether it looks along x, y or z."""
        return bool(np.count_nonzero(self.toward) == 1)

    def project(self, points: np.ndarray) -> np.ndarray:
        """(..., 2) of (..., 3)."""
        return np.stack([points @ self.right, points @ self.up], axis=-1)


def camera_of(view: str, specimen: Specimen, moved: Sequence[np.ndarray] = ()) -> Camera:
    """The camera of one of VIEWS for a specimen (a floor aside), whose corners move by (P, 3) m each."""
    points, shape = specimen.blocks.points[above_floor(specimen.blocks)], specimen.shape
    right = along_floor(specimen.blocks, moved)
    views = {"front": front_view, "back": back_view, "side": side_view, "iso": iso_view}
    return views[view](points, shape, right)


def usual_view(result: "ResultData") -> str:
    """The view of a result where none is asked for: the side, where it falls along what the front looks along, or
    swings that way as the ground shakes; else the front."""
    grown = result.summary.collapse_load
    gives_way = grown is not None and grown.falls is not None
    if not (result.is_large or gives_way):
        return "front"
    blocks, moved = result.specimen.blocks, [frame.corners for frame in result.history.frames]
    front = camera_of("front", result.specimen, moved)
    mask = above_floor(blocks)
    farthest = np.max([np.abs(corners[mask]).max(axis=0) for corners in moved], axis=0, initial=0.0)
    level = farthest * [1.0, 1.0, 0.0]
    along, across = (float(level @ np.abs(direction)) for direction in (front.right, front.toward))
    threshold = 0.0 if result.is_shaken or gives_way else FALLS * front.size
    return "side" if across > max(threshold, 2.0 * along) else "front"


def along_floor(blocks: Blocks, moved: Sequence[np.ndarray] = ()) -> int | None:
    """Of what stands on a floor: x (0) or y (1), whichever its corners move along most, by (P, 3) m each, or else the
    longer one; None without a floor."""
    if FLOOR not in blocks.groups:
        return None
    mask = above_floor(blocks)
    size = np.ptp(blocks.points[mask], axis=0)[:2]
    extent = np.max([np.abs(corners[mask, :2]).max(axis=0) for corners in moved], axis=0, initial=0.0)
    x, y = extent if extent.max() > 0.1 * size.min() else size
    return 0 if x >= y else 1


def above_floor(blocks: Blocks) -> np.ndarray:
    """Numbers of the corners of all blocks but a floor."""
    if FLOOR not in blocks.groups:
        return np.arange(len(blocks.points))
    group = np.repeat(blocks.group[blocks.face_block()], np.diff(blocks.face_start))
    return np.unique(blocks.face_points[group != blocks.groups.index(FLOOR)])


def with_less_floor(blocks: Blocks) -> Blocks:
    """The same for a picture: of a floor no more than half the size of what stands on it is left on each side, and a
    tenth of it below."""
    mask = above_floor(blocks)
    low, high = blocks.points[mask].min(axis=0), blocks.points[mask].max(axis=0)
    room = float(np.max(high - low)) * np.array([0.5, 0.5, 0.1])
    return replace(blocks, points=np.clip(blocks.points, low - room, high + room))


def box_of(camera: Camera, blocks: Blocks, moved: Sequence[np.ndarray], times: float = 1.0) -> np.ndarray:
    """Lowest and highest place (2, 2) that a corner above the floor comes to, with some room round them; corners move
    by (P, 3) m each, drawn `times` larger. Those that are OUT count where they began."""
    mask = above_floor(blocks)
    moves = [times * corners[mask] for corners in moved]
    stays = [np.linalg.norm(move, axis=1, keepdims=True) <= OUT * camera.size for move in moves]
    flat = [
        camera.project(blocks.points[mask] + np.where(stay, move, 0.0)) for stay, move in zip(stays, moves, strict=True)
    ]
    low, high = np.min(flat, axis=(0, 1)), np.max(flat, axis=(0, 1))
    room = 0.03 * float(np.max(high - low))
    return np.array([low - room, high + room])


def front_view(points: np.ndarray, shape: str = "", right: int | None = None) -> Camera:
    """Onto the two largest extents of points (P, 3); onto x and z where extents tie, and for shapes seen along y.

    right  the axis that is seen to the right, with z upwards; None for that of the extents
    """
    extent = np.ptp(points, axis=0)
    preference = np.array([2e-9, 0.0, 1e-9]) * extent.max()
    largest = sorted(np.argsort(-(extent + preference))[:2].tolist())
    across, up = np.eye(3)[[0, 2] if table_of(shape).seen_along_y else largest if right is None else [right, 2]]
    return Camera(across, up, np.cross(across, up), float(extent.max()))


def back_view(points: np.ndarray, shape: str = "", right: int | None = None) -> Camera:
    """The same plane from behind: coordinates grow to the left."""
    front = front_view(points, shape, right)
    return replace(front, right=-front.right, toward=-front.toward)


def side_view(points: np.ndarray, shape: str = "", right: int | None = None) -> Camera:
    """Along the other level axis than the front looks along, z upwards: it shows what falls out of the front."""
    front = front_view(points, shape, right)
    across, up = np.eye(3)[[0 if front.right[1] else 1, 2]]
    return Camera(across, up, np.cross(across, up), front.size)


def iso_view(points: np.ndarray, shape: str = "", right: int | None = None) -> Camera:
    """From the front, the right-hand side and above, whatever the shape."""
    level, rise = np.cos(ELEVATION), np.sin(ELEVATION)
    toward = np.array([level * np.cos(AZIMUTH), level * np.sin(AZIMUTH), rise])
    across = np.array([-np.sin(AZIMUTH), np.cos(AZIMUTH), 0.0])
    return Camera(across, np.cross(toward, across), toward, float(np.ptp(points, axis=0).max()))
