"""Supports as hatching and rollers, drive and tractions as arrows, on the picture of a specimen."""

from typing import Any

import numpy as np

from geometry.blocks import Specimen
from masonry.drawings.condition_marks import Mark, box_of, nearer_side, spread
from masonry.pictures.camera import Camera
from masonry.pictures.hidden_surfaces import Piece, hidden

COLOURS = {"support": "#1e7a4c", "drive": "#c0392b", "traction": "#1f5fa8"}
ARROW = 0.09
"""Length of an arrow over the size of the picture."""
LETTER = 0.016
"""Width of a letter of the words at an arrow over the size of the picture, with some to spare."""
PAPER = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.5}
"""Behind words, so that they can be read on joints and hatching."""


def draw_mark(axes: Any, specimen: Specimen, mark: Mark, pieces: list[Piece], camera: Camera, size: float) -> None:
    """Draw one support, drive or traction; size (m) of the picture, pieces as from visible_pieces."""
    colour = COLOURS[mark.kind]
    if mark.kind == "support":
        _draw_support(axes, specimen, mark, pieces, camera, size)
    for base, vector, presses in mark.arrows:
        _draw_arrows(axes, camera, pieces, (base, vector, presses), colour, size)
    if (words := place_of_value(mark, camera, size)) is not None:
        _draw_value(axes, mark, *words, size)


def stands_left(specimen: Specimen, mark: Mark) -> bool:
    """Whether arrows of a mark stand out of the low end of a specimen along x."""
    low = specimen.blocks.points[:, 0].min()
    for base, vector, presses in mark.arrows:
        out = -vector[0] if presses else vector[0]
        if out < -0.5 and base[:, 0].min() < low + 1e-6:
            return True
    return False


def place_of_value(mark: Mark, camera: Camera, size: float) -> tuple[np.ndarray, np.ndarray] | None:
    """Where the words of a mark stand (2,), and in which direction (2,) from its specimen; None without words.

    That is the free end of the last arrow of the first group.
    """
    if not (mark.arrows and mark.value):
        return None
    base, vector, presses = mark.arrows[0]
    out = (-1.0 if presses else 1.0) * _flat(camera, vector)
    return camera.project(base[-1]) + 1.1 * ARROW * size * out, out


def _draw_value(axes: Any, mark: Mark, at: np.ndarray, out: np.ndarray, size: float) -> None:
    """The words of a mark; in lines of their own where they stand beside the specimen."""
    ha = "center" if abs(out[0]) < 0.3 else "left" if out[0] > 0 else "right"
    va = "center" if abs(out[1]) < 0.3 else "bottom" if out[1] > 0 else "top"
    words = mark.value if ha == "center" else mark.value.replace(", ", ",\n")
    axes.annotate(words, at, ha=ha, va=va, fontsize=10, color=COLOURS[mark.kind], zorder=9, bbox=PAPER)
    wide = LETTER * size * max(map(len, words.split("\n")))
    left = {"center": 0.5, "left": 0.0, "right": 1.0}[ha] * wide
    axes.update_datalim([at + (wide - left, 0.05 * size), at - (left, 0.05 * size)])


def _flat(camera: Camera, vector: np.ndarray) -> np.ndarray:
    """Direction on the paper; zero where it runs along the line of sight."""
    direction = camera.project(vector)
    length = np.linalg.norm(direction)
    return direction / length if length > 0.2 else np.zeros(2)


def _draw_arrows(
    axes: Any,
    camera: Camera,
    pieces: list[Piece],
    arrows: tuple[np.ndarray, np.ndarray, bool],
    colour: str,
    size: float,
) -> None:
    """Arrows onto or away from their places; a dot or a cross in a ring where they run along the line of sight."""
    base, vector, presses = arrows
    direction = _flat(camera, vector)
    if not direction.any():
        nearer = vector @ camera.toward > 0
        for x, z in camera.project(base):
            axes.plot(x, z, "o", ms=11, mfc="white", mec=colour, mew=1.6, zorder=8)
            axes.plot(x, z, "o" if nearer else "x", ms=4 if nearer else 7, color=colour, mew=1.6, zorder=8)
        return
    for point in base:
        place = camera.project(point)
        start, end = (place - ARROW * size * direction, place) if presses else (place, place + ARROW * size * direction)
        behind = hidden(point + (-1e-3 if presses else 1e-3) * size * vector, pieces, camera, 1e-4 * size)
        style = {"arrowstyle": "-|>", "color": colour, "lw": 1.8, "mutation_scale": 14, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", end, start, zorder=0.5 if behind else 8, arrowprops=style)
        axes.update_datalim([start, end])


def _in_sight(faces: list[Piece], pieces: list[Piece], camera: Camera, width: float) -> list[Piece]:
    """Those of some pieces whose middle no piece hides; only pieces that lie over it in the picture are looked at."""
    flat = [camera.project(piece.corners) for piece in pieces]
    low, high = (np.array([at(corners, axis=0) for corners in flat]).reshape(-1, 2) for at in (np.min, np.max))
    seen = []
    for piece in faces:
        middle = piece.corners.mean(axis=0)
        place = camera.project(middle[None])[0]
        over = np.flatnonzero(((low <= place + width) & (place <= high + width)).all(axis=1))
        if not len(over) or not hidden(middle, [pieces[n] for n in over], camera, width):
            seen.append(piece)
    return seen


def _draw_support(axes: Any, specimen: Specimen, mark: Mark, pieces: list[Piece], camera: Camera, size: float) -> None:
    """Hatched where nothing moves; else triangles with a line, as rollers, against each direction that is held."""
    from matplotlib.collections import PolyCollection

    colour = COLOURS["support"]
    owner = specimen.blocks.face_block()
    if mark.all_held:
        own = np.isin([owner[p.face] for p in pieces], mark.blocks)
        if mark.faces is not None:
            own = np.isin([p.face for p in pieces], mark.faces)
        faces = [piece for piece, mine in zip(pieces, own, strict=True) if mine]
        shown = [camera.project(piece.corners) for piece in _in_sight(faces, pieces, camera, 1e-4 * size)]
        axes.add_collection(
            PolyCollection(shown, facecolors="none", edgecolors=colour, hatch="////", linewidths=0.0, zorder=5)
        )
        if shown and mark.faces is None:
            return
    for part in mark.parts:
        low, high = box_of(specimen, part, mark.faces)
        for axis in mark.axes:
            at_high = nearer_side(specimen, low, high, axis)
            vector = (1.0 if at_high else -1.0) * np.eye(3)[axis]
            direction = _flat(camera, vector)
            if not direction.any():
                continue
            for place in spread(
                low, high, axis, high[axis] if at_high else low[axis], 3 if camera.along_an_axis else 2, 0.08 * size
            ):
                behind = hidden(place + 1e-3 * size * vector, pieces, camera, 1e-4 * size)
                depth = 0.5 if behind else 7.0
                _draw_roller(axes, camera.project(place), direction, 0.028 * size, colour, mark.all_held, depth)


def _draw_roller(
    axes: Any, tip: np.ndarray, out: np.ndarray, size: float, colour: str, fixed: bool, depth: float
) -> None:
    from matplotlib.patches import Polygon

    along = np.array([-out[1], out[0]])
    base = tip + size * out
    axes.add_patch(
        Polygon(
            [tip, base + 0.6 * size * along, base - 0.6 * size * along], fc="white", ec=colour, lw=1.4, zorder=depth
        )
    )
    level = base + (0.0 if fixed else 0.25) * size * out
    ends = np.array([level - 0.8 * size * along, level + 0.8 * size * along])
    axes.plot(*ends.T, color=colour, lw=1.6, zorder=depth)
    axes.update_datalim(ends)
