"""Where supports, drive and tractions are drawn on a specimen: arrows and symbols, in metres, and their words."""

from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from geometry.blocks import Joints, Specimen
from masonry.assembly.conditions import select
from masonry.scene import Scene

AXES = "xyz"
MOST_PARTS = 6
"""Sets of more separate parts than this are marked as a whole."""


@dataclass(frozen=True)
class Mark:
    """Mark of one support, drive or traction.

    kind    "support", "drive", "traction"        words   a line for the list below the picture
    blocks  numbers of the blocks it acts on, rising; faces of them, or None
    parts   the blocks by what hangs together
    axes    those along which a support holds; all_held: no movement and no turn is left
    arrows  (base (n, 3) m on the specimen, unit direction (3,), whether the arrow presses onto the base), one or more
    value   words beside the arrows
    """

    kind: str
    words: str
    blocks: np.ndarray
    faces: np.ndarray | None
    parts: list[np.ndarray]
    axes: tuple[int, ...] = ()
    all_held: bool = False
    arrows: list[tuple[np.ndarray, np.ndarray, bool]] = field(default_factory=list)
    value: str = ""


def marks(scene: Scene, specimen: Specimen, joints: Joints) -> list[Mark]:
    """All supports, the drive and all tractions of a scene, in this order. Raises SceneError for a wrong selector."""
    all_marks = []
    for k, support in enumerate(scene.support):
        blocks, faces = _selected(specimen, joints, support.on, f"support.{k}.on")
        axes = tuple(a for a in range(3) if AXES[a] in support.fix)
        everything = axes == (0, 1, 2) and (faces is not None or "rotation" in support.fix)
        what = "everything" if everything else ", ".join(support.fix)
        all_marks.append(
            Mark(
                "support",
                f"support {k}: {support.on}, held: {what}",
                blocks,
                faces,
                parts_of(joints, blocks, faces),
                axes,
                everything,
            )
        )
    if scene.drive is not None:
        drive = scene.drive
        blocks, faces = _selected(specimen, joints, drive.on, "drive.on")
        monotonic = len(drive.reversals) == 1
        value = (
            f"{drive.reversals[0] * 1e3:.4g} mm"
            if monotonic
            else f"{drive.farthest * 1e3:.4g} mm at most, back and forth"
        )
        direction = drive.sign * (np.sign(drive.reversals[0]) if monotonic else 1.0) * np.eye(3)[drive.axis]
        arrows = [_push_or_pull(specimen, part, faces, direction) for part in parts_of(joints, blocks, faces)]
        words = f"drive: {drive.on}, {value} along {drive.direction}"
        all_marks.append(Mark("drive", words, blocks, faces, [], arrows=arrows, value=value))
    for k, traction in enumerate(scene.traction):
        blocks, faces = _selected(specimen, joints, traction.on, f"traction.{k}.on")
        parts = [(a, s) for a, s in enumerate(traction.stress) if s != 0.0]
        value = ", ".join(f"{AXES[a]} {s * 1e-6:.4g} MPa" for a, s in parts)
        arrows = [_push_or_pull(specimen, blocks, faces, np.sign(s) * np.eye(3)[a], True) for a, s in parts]
        value += "" if traction.history is None else ", times its history"
        words = f"traction {k}: {traction.on}, {value or 'none'}"
        all_marks.append(Mark("traction", words, blocks, faces, [], arrows=arrows, value=value))
    return all_marks


def _selected(specimen: Specimen, joints: Joints, on: str, where: str) -> tuple[np.ndarray, np.ndarray | None]:
    blocks, faces = select(specimen, joints, on, where)
    return np.unique(blocks), faces


def parts_of(joints: Joints, blocks: np.ndarray, faces: np.ndarray | None) -> list[np.ndarray]:
    """The blocks parted where they do not hang together, if there are few parts; faces stay together."""
    inside = np.isin(joints.block_a, blocks) & np.isin(joints.block_b, blocks)
    a, b = np.searchsorted(blocks, joints.block_a[inside]), np.searchsorted(blocks, joints.block_b[inside])
    link = coo_array((np.ones(len(a)), (a, b)), shape=(len(blocks),) * 2)
    count, label = connected_components(link, directed=False)
    if faces is not None or count > MOST_PARTS:
        return [blocks]
    return [blocks[label == part] for part in range(count)]


def box_of(specimen: Specimen, blocks: np.ndarray, faces: np.ndarray | None) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest corner (3,) m of some blocks, or of the faces alone where there are some."""
    b = specimen.blocks
    which = np.isin(b.face_block(), blocks) if faces is None else np.isin(np.arange(len(b.face_start) - 1), faces)
    corners = b.points[b.face_points[np.repeat(which, np.diff(b.face_start))]]
    return corners.min(axis=0), corners.max(axis=0)


def nearer_side(specimen: Specimen, low: np.ndarray, high: np.ndarray, axis: int) -> bool:
    """Whether a box lies nearer to the specimen's high end along an axis than to its low end."""
    points = specimen.blocks.points
    return bool(points[:, axis].max() - high[axis] < low[axis] - points[:, axis].min())


def spread(low: np.ndarray, high: np.ndarray, axis: int, at: float, most: int, least: float) -> np.ndarray:
    """(n, 3) places on the side of a box across an axis, at a level; up to `most` along its longer edge.

    No two are closer than about `least` (m).
    """
    size = high - low
    a, b = (k for k in range(3) if k != axis)
    longest = max(size[a], size[b])
    numbers = {k: max(1, round(most * size[k] / longest)) if longest > 0 else 1 for k in (a, b)}
    numbers = {k: min(n, max(1, int(size[k] / least))) for k, n in numbers.items()}
    place = {k: low[k] + size[k] * (np.arange(n) + 0.5) / n for k, n in numbers.items()}
    points = np.full((numbers[a] * numbers[b], 3), at)
    points[:, a], points[:, b] = (grid.ravel() for grid in np.meshgrid(place[a], place[b], indexing="ij"))
    return points


def _push_or_pull(
    specimen: Specimen, blocks: np.ndarray, faces: np.ndarray | None, direction: np.ndarray, load: bool = False
) -> tuple[np.ndarray, np.ndarray, bool]:
    """Arrows that stand on the side of the box where there is room: they pull away from it, or press on it."""
    low, high = box_of(specimen, blocks, faces)
    axis = int(np.argmax(np.abs(direction)))
    at_high = nearer_side(specimen, low, high, axis) if low[axis] < high[axis] else _looks_up(specimen, faces, axis)
    presses = at_high == (direction[axis] < 0)
    level = high[axis] if at_high else low[axis]
    size = float(np.ptp(specimen.blocks.points, axis=0).max())
    return spread(low, high, axis, level, 7 if load else 3, 0.05 * size), direction, presses


def _looks_up(specimen: Specimen, faces: np.ndarray | None, axis: int) -> bool:
    """Whether a flat set of faces is the high side of its blocks."""
    blocks = specimen.blocks
    assert faces is not None
    face = int(faces[0])
    block = blocks.points[
        np.concatenate(
            [
                blocks.face_points[blocks.face_start[f] : blocks.face_start[f + 1]]
                for f in blocks.faces_of(int(blocks.face_block()[face]))
            ]
        )
    ]
    return bool(blocks.face(face)[:, axis].mean() > block[:, axis].mean())
