"""Round the picture of a specimen: axes in mm, and the names of its sets beside it."""

from collections.abc import Iterable, Sequence
from itertools import product
from typing import Any

import numpy as np

from geometry.blocks import Blocks, Specimen
from masonry.pictures.camera import Camera
from masonry.pictures.hidden_surfaces import Piece
from masonry.pictures.style import plain

MOST_LONE = 12
"""Sets of one block; where there are more of them, as every stone has a name, none of them is written."""
MOST_SETS = 24
"""More names than this are not written into the picture."""
MOST_IN_A_ROW = 6
"""Of longer rows of numbered names the first and the last are written."""
OUT = 0.055
"""How far the edges with coordinates stand from the specimen, over its size."""
DIGITS, LONGEST = 10, 7
"""Digits of a coordinate in mm, and letters beyond which two of them have room at an axis: far from the origin."""
AWAY = 0.25
"""How far names stand from the box round the specimen, over the size of the picture."""


def draw_sets(
    axes: Any,
    specimen: Specimen,
    pieces: list[Piece],
    camera: Camera,
    size: float,
    words: Sequence[tuple[np.ndarray, np.ndarray]] = (),
    left_taken: bool = False,
) -> None:
    """Names of the sets to the left and the right, each with a line to a visible face of it.

    words       places (2,) of other words, and directions (2,) from the specimen: names beside it keep clear of them
    left_taken  arrows stand on the left; what may go to either side then goes to the right
    """
    ends = specimen.blocks.points.min(axis=0), specimen.blocks.points.max(axis=0)
    box = camera.project(np.array(list(product(*np.transpose(ends)))))
    low, high = box.min(axis=0), box.max(axis=0)
    sides = _names_by_side(specimen, pieces, camera, 0.5 * float(low[0] + high[0]), size, left_taken)
    for to_right, entries in sides.items():
        beside = [place[1] for place, out in words if (out[0] > 0.5 if to_right else out[0] < -0.5)]
        levels = _clear([entry[0] for entry in sorted(entries, key=_level)], beside, 0.05 * size)
        x = high[0] + AWAY * size if to_right else low[0] - AWAY * size
        for level, (_, name, anchor) in zip(levels, sorted(entries, key=_level), strict=True):
            axes.annotate(
                plain(name),
                anchor,
                (x, level),
                ha="left" if to_right else "right",
                va="center",
                fontsize=9,
                zorder=9,
                color="0.15",
                arrowprops={"arrowstyle": "-", "color": "0.45", "lw": 0.7, "shrinkB": 0},
            )
            axes.plot(*anchor, "o", ms=3, color="0.3", zorder=9)
            axes.update_datalim([(x + (0.24 if to_right else -0.24) * size, level)])


def _shown(names: Iterable[str]) -> list[str]:
    """Names of sets, of a long row of numbered ones ("course 1", "course 2", ...) the first and the last."""
    rows: dict[str, list[str]] = {}
    for name in names:
        stem, _, number = name.rpartition(" ")
        rows.setdefault(stem if number.isdigit() else name, []).append(name)
    return [name for row in rows.values() for name in (row if len(row) <= MOST_IN_A_ROW else [row[0], row[-1]])]


def _names_by_side(
    specimen: Specimen, pieces: list[Piece], camera: Camera, centre: float, size: float, left_taken: bool
) -> dict[bool, list[tuple[float, str, np.ndarray]]]:
    """Names that stand on the right (True) and on the left: level, name, and the place on a visible face of the set."""
    block = specimen.blocks.face_block()[[piece.face for piece in pieces]] if pieces else np.zeros(0, dtype=np.int64)
    middle = np.array([camera.project(piece.corners).mean(axis=0) for piece in pieces])
    sides: dict[bool, list[tuple[float, str, np.ndarray]]] = {False: [], True: []}
    lone = sum(len(members) == 1 for members in specimen.sets.values())
    shown = {name: m for name in _shown(specimen.sets) if len(m := specimen.sets[name]) > 1 or lone <= MOST_LONE}
    for name, members in list(shown.items())[:MOST_SETS]:
        own = middle[np.isin(block, members)]
        if len(own) == 0 or name in specimen.blocks.groups:  # groups are told by colour
            continue
        to_right = bool(own[:, 0].mean() >= centre)
        if abs(own[:, 0].mean() - centre) < 0.05 * size:
            to_right = left_taken or len(sides[True]) <= len(sides[False])
        nearest = own[np.argmax(own[:, 0] if to_right else -own[:, 0])]
        row = own[np.abs(own[:, 0] - nearest[0]) <= 0.02 * size]
        anchor = row[np.argmin(np.abs(row[:, 1] - own[:, 1].mean()))]
        sides[to_right].append((float(anchor[1]), name, anchor))
    return sides


def _level(entry: tuple[float, str, np.ndarray]) -> tuple[float, str]:
    return entry[0], entry[1]


def _clear(levels: list[float], taken: list[float], least: float) -> list[float]:
    """Rising levels moved apart by `least`, and up out of the way of those that are taken."""
    moved = _apart(levels, least)
    for level in sorted(taken):
        for k, own in enumerate(moved):
            if abs(own - level) < 1.5 * least:
                moved[k] = level + 1.5 * least
        for k in range(1, len(moved)):
            moved[k] = max(moved[k], moved[k - 1] + least)
    return moved


def _apart(levels: list[float], least: float) -> list[float]:
    """Rising levels moved up and down until neighbours are apart by `least`, their middle kept."""
    if not levels:
        return []
    moved = [levels[0]]
    for level in levels[1:]:
        moved.append(max(level, moved[-1] + least))
    shift = (sum(levels) - sum(moved)) / len(levels)
    return [level + shift for level in moved]


def draw_axes(axes: Any, blocks: Blocks, camera: Camera, left_taken: bool = False) -> None:
    """Coordinates in mm: the axes of a front view, or three edges of the box round the specimen with marks on them.

    left_taken: arrows stand where the upright edge would be; that of the other side is drawn.
    """
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.margins(0.04)
    if camera.along_an_axis:
        names = ["xyz"[int(np.argmax(np.abs(direction)))] for direction in (camera.right, camera.up)]
        axes.set_xlabel(f"{names[0]} [mm]")
        axes.set_ylabel(f"{names[1]} [mm]")
        flat = camera.project(blocks.points)
        for spine, across, low, high in zip(("bottom", "left"), "xy", flat.min(axis=0), flat.max(axis=0), strict=True):
            ticks = _ticks(low, high, 6)
            axes.set(
                **{f"{across}ticks": ticks * 1e-3, f"{across}ticklabels": [f"{tick:.{DIGITS}g}" for tick in ticks]}
            )
            axes.spines[spine].set_bounds(low, high)
        axes.spines[["top", "right"]].set_visible(False)
        return
    axes.set_axis_off()
    low, high = blocks.points.min(axis=0), blocks.points.max(axis=0)
    upright = ([high[0], high[1], low[2]], [2.0, 0.0, 0.0]) if left_taken else (low, [-1.0, 0.0, 0.0])
    edges = ((low, [0.0, -1.0, 0.0]), ([high[0], low[1], low[2]], [1.0, 0.0, 0.0]), upright)
    for axis, (start, outward) in enumerate(edges):
        _draw_edge(axes, camera, np.array(start), np.array(outward), axis, low, high)


def _ticks(low: float, high: float, most: int) -> np.ndarray:
    """Round coordinates in mm between two in m."""
    from matplotlib.ticker import MaxNLocator

    ticks = np.asarray(MaxNLocator(most).tick_values(low * 1e3, high * 1e3))
    ticks = np.asarray(ticks[(ticks >= low * 1e3 - 1e-6) & (ticks <= high * 1e3 + 1e-6)])
    is_long = any(len(f"{tick:.{DIGITS}g}") > LONGEST for tick in ticks)
    return ticks[[0, -1]] if is_long and len(ticks) > 2 else ticks


def _draw_edge(
    axes: Any, camera: Camera, start: np.ndarray, outward: np.ndarray, axis: int, low: np.ndarray, high: np.ndarray
) -> None:
    """One edge of the box, shifted a little outward (twice as far by a vector of length 2), with ticks and numbers."""
    size, away = float(np.max(high - low)), OUT * np.linalg.norm(outward)
    out = camera.project(outward)
    out = out / np.linalg.norm(out)
    span = high[axis] - low[axis]
    ticks = _ticks(low[axis], high[axis], max(1, min(6, round(7 * span / size))))
    ticks = ticks[-1:] if span < 0.05 * size else ticks
    along = np.eye(3)[axis]
    ends = np.array([camera.project(start + s * span * along) + away * size * out for s in (0.0, 1.0)])
    axes.plot(*ends.T, color="0.3", lw=0.9)
    for tick in ticks:
        at = camera.project(start + (tick * 1e-3 - low[axis]) * along) + away * size * out
        axes.plot(*np.array([at, at + 0.012 * size * out]).T, color="0.3", lw=0.9)
        axes.annotate(f"{tick:.{DIGITS}g}", at + 0.042 * size * out, ha="center", va="center", fontsize=8, color="0.2")
    name = ends.mean(axis=0) + (0.11, 0.15)[axis] * size * out if axis < 2 else ends[1] + (0.0, 0.05 * size)
    axes.annotate(f"{'xyz'[axis]} [mm]", name, ha="center", va="center", fontsize=9)
    axes.update_datalim([name + 0.03 * size * out])
