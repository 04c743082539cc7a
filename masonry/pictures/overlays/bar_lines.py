"""Bars over the blocks of a specimen, from end to end, in any view; those that yielded in another colour."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from geometry.blocks import Blocks
from geometry.polyhedra.line_cuts import TOUCH, pieces, planes_of
from geometry.polyhedra.measures import extent
from masonry.pictures.camera import Camera
from masonry.pictures.hidden_surfaces import Piece, behind
from masonry.results.deformation import BlockCorners, Deformation
from masonry.rows.history import Frame
from masonry.scene import Scene
from masonry.scene.tables.specimens.bar import BarTable

if TYPE_CHECKING:
    from masonry.results.data import ResultData

ELASTIC, YIELDED = "#08519c", "#d95f02"
PARTS = 40
"""Of a bar, each of which is hidden or seen."""
Moves = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""By how much (n, 3) m points (n, 3) of blocks (n,) are moved in a picture."""


def draw_bars(
    axes: Any,
    bars: Sequence[BarTable],
    blocks: Blocks,
    camera: Camera,
    moves: Moves | None = None,
    yielded: np.ndarray | None = None,
    seen: list[Piece] | None = None,
) -> None:
    """The bars of a scene, where it has any; yielded (K,) which of them have. Seen from a corner, with the pieces that
    are seen, they are dashed where these hide them."""
    if not bars:
        return
    ends = np.array([place for bar in bars for place in bar.places])
    places = ends.reshape(-1, 3)
    if moves is not None:
        fixed = np.array([[bar.fixed_end == end for end in ("first", "second")] for bar in bars])
        which = np.flatnonzero(~np.repeat(fixed, [bar.repeat for bar in bars], axis=0).ravel())
        planes, width = planes_of(blocks), TOUCH * extent(blocks)
        block = [int(pieces(*planes, place, width).body[0]) for place in places[which].tolist()]
        places[which] = places[which] + moves(np.array(block), places[which])
    flat, lines = camera.project(places), places.reshape(-1, 2, 3)
    colours = np.where(np.zeros(len(ends), dtype=bool) if yielded is None else yielded, YIELDED, ELASTIC)
    hidden = _hidden_parts(lines, camera, seen)
    for style, is_drawn in (("solid", ~hidden), ((0, (3.0, 2.0)), hidden)):
        _draw_parts(axes, lines, is_drawn, camera, colours, style)
    axes.scatter(*flat.T, s=16.0, marker="s", c=np.repeat(colours, 2).tolist(), linewidths=0.0, zorder=3.9)


def _hidden_parts(lines: np.ndarray, camera: Camera, seen: list[Piece] | None) -> np.ndarray:
    """(K, PARTS) whether pieces hide a part of bars between ends (K, 2, 3); nothing does along an axis."""
    if not seen or camera.along_an_axis:
        return np.zeros((len(lines), PARTS), dtype=bool)
    middle = (np.arange(PARTS)[:, None] + 0.5) / PARTS
    inner = lines[:, :1] + middle * (lines[:, 1:] - lines[:, :1])
    return np.asarray(behind(inner.reshape(-1, 3), seen, camera).any(axis=1).reshape(-1, PARTS))


def _draw_parts(
    axes: Any, lines: np.ndarray, is_drawn: np.ndarray, camera: Camera, colours: np.ndarray, style: Any
) -> None:
    from matplotlib.collections import LineCollection

    runs = [(bar, *ends) for bar, row in enumerate(is_drawn) for ends in stretches(row)]
    if not runs:
        return
    shares = np.array([ends for _, *ends in runs]) / PARTS
    owner = np.array([bar for bar, *_ in runs])
    first, second = lines[owner, :1], lines[owner, 1:]
    segments = camera.project(first + shares[:, :, None] * (second - first))
    axes.add_collection(
        LineCollection(list(segments), colors=colours[owner].tolist(), linewidths=1.6, linestyles=style, zorder=3.8)
    )


def stretches(row: np.ndarray) -> list[tuple[int, int]]:
    """Begin and end of each run of true values (n,)."""
    change = np.flatnonzero(np.diff(np.concatenate([[False], row, [False]]).astype(np.int8)))
    return list(zip(change[::2].tolist(), change[1::2].tolist(), strict=True))


def draw_in_scene(axes: Any, scene: Scene, blocks: Blocks, camera: Camera, seen: list[Piece]) -> None:
    """Those of a scene."""
    draw_bars(axes, scene.bar, blocks, camera, seen=seen)


def draw_in_run(
    axes: Any, result: "ResultData", frame: Frame, camera: Camera, times: float, seen: list[Piece] | None
) -> None:
    """Those of a run where they are in a frame, displacements `times` larger."""
    if not (bars := bars_in(result)):
        return
    blocks = result.specimen.blocks
    field = Deformation(BlockCorners(blocks), frame)

    def moves(block: np.ndarray, point: np.ndarray) -> np.ndarray:
        return times * field.at(block, point, np.full(len(block), -1))

    draw_bars(axes, bars, blocks, camera, moves, yielded_in(result), seen)


def bars_in(result: "ResultData") -> list[BarTable]:
    """The bars of the scene of a run."""
    return [BarTable.model_validate(table) for table in result.scene_table.get("bar", ())]


def yielded_in(result: "ResultData") -> np.ndarray | None:
    """(K,) which bars of a run were longer or shorter for good at its end; None where it does not say."""
    bars = result.summary["bars"]
    return None if not bars or bars["plastic_m"] is None else np.array(bars["plastic_m"]) != 0.0


def segments_of(scene: Scene) -> list[tuple[np.ndarray, str, str]]:
    """Ends (2, 3) m, name and colour of each of a scene."""
    return [
        (np.array(ends), bar.name or f"bar {number}", ELASTIC)
        for number, bar in enumerate(scene.bar)
        for ends in bar.places
    ]


def bar_keys(bars: Sequence[BarTable], yielded: np.ndarray | None = None) -> list[Any]:
    """Entries of a key: of bars, and of those that yielded; of what occurs."""
    if not bars:
        return []
    from matplotlib.lines import Line2D

    count, many = sum(bar.repeat for bar in bars), 0 if yielded is None else int(yielded.sum())
    words = [(ELASTIC, "bar"), (YIELDED, "bar that yielded")]
    drawn = [word for word, number in zip(words, (count - many, many), strict=True) if number]
    return [Line2D([], [], color=colour, lw=1.6, marker="s", ms=4.0, label=label) for colour, label in drawn]


def keys_of_scene(scene: Scene) -> list[Any]:
    """Entries of a key of those of a scene."""
    return bar_keys(scene.bar)


def keys_of_run(result: "ResultData") -> list[Any]:
    """Entries of a key of those of a run."""
    return bar_keys(bars_in(result), yielded_in(result))
