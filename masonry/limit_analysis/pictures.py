"""Pictures of a limit analysis: how the blocks begin to move, and the thrust in each joint."""

from dataclasses import replace
from typing import Any

import numpy as np

from geometry.blocks import Joints
from masonry.drawings.road_drawing import draw_road
from masonry.limit_analysis.limit_data import LimitData
from masonry.limit_analysis.limit_text import factor_words, head_of
from masonry.pictures.camera import Camera, camera_of
from masonry.pictures.faces import FaceDrawing
from masonry.pictures.hidden_surfaces import Piece, behind_others, visible_pieces
from masonry.pictures.style import plain
from masonry.pictures.thrust_line import COLOUR, ROW, row_of
from masonry.results.joint_resultants import UnitJoints, unit_joints

WIDTH = 6.75
"""Of a picture, inches."""
SHOWN = 0.06
"""Displacement of the fastest corner in the picture, over the size of the specimen."""
TINT = (0.85, 0.25, 0.15, 0.32)
"""Laid over what moves."""
INSIDE = 1e-6
"""How far beyond an edge, over its distance from the middle, a force counts as at the edge."""
LONGEST, LEAST = 0.12, 0.01
"""Length of the largest thrust in the picture over the size; share of it below which a thrust is not drawn."""


def view_of(result: LimitData) -> str:
    """Front where nothing moves through the thickness, else iso."""
    camera = camera_of("front", result.specimen)
    velocity = result.corner_velocities()[1]
    across = np.abs(velocity @ camera.toward).max(initial=0.0)
    return "front" if across <= 1e-3 * np.abs(velocity).max(initial=0.0) else "iso"


def mechanism_figure(result: LimitData, view: str | None = None) -> Any:
    """A matplotlib figure of the blocks a little after they began to move; what moves is tinted."""
    camera, blocks = camera_of(view or view_of(result), result.specimen), result.specimen.blocks
    top = max(float(result.speeds().max(initial=0.0)), 1e-300)
    times = SHOWN * camera.size / top if result.moving.any() else 0.0
    faces = FaceDrawing(blocks, camera)
    owner, moving = blocks.face_block(), result.moving
    pieces = _pieces(result, camera)
    block = np.repeat([owner[piece.face] for piece in pieces], [len(piece.corners) for piece in pieces])
    velocity = result.velocity_at(block, np.concatenate([piece.corners for piece in pieces]))
    ends = np.cumsum([len(piece.corners) for piece in pieces])[:-1]
    speeds = np.split(velocity, ends)
    pieces = [replace(piece, corners=piece.corners + times * v) for piece, v in zip(pieces, speeds, strict=True)]
    for piece in pieces:
        faces.add_piece(piece)
        if moving[owner[piece.face]]:
            faces.add_polygon(piece.corners, TINT)
    figure, axes = _figure(result, f"mechanism at {_factor(result)}: what begins to move is tinted")
    faces.draw(axes)
    moves = lambda block, points: times * result.velocity_at(block, points)  # noqa: E731
    draw_road(axes, result.scene, result.specimen, result.joints, camera, moves)
    for element in result.elements:
        element.draw(axes, result.scene, blocks, camera, moves, pieces)
    return _fitted(figure, axes)


def thrust_figure(result: LimitData, view: str | None = None) -> Any:
    """A matplotlib figure of the force in each joint between units, where its normal force acts.

    Along it a line: its length is in proportion to the force. Units in one row have a thrust line from joint to joint.
    Where a joint pulls at one edge and presses at another, the force passes outside: it is drawn in the middle, hollow.
    Seen from a corner, joints that other units hide are left out.
    """
    camera, blocks = camera_of(view or view_of(result), result.specimen), result.specimen.blocks
    between, table = unit_joints(blocks, result.joints), result.thrust()
    force, place = (np.column_stack([table[f"{name}_{axis}"] for axis in "xyz"]) for name in ("force", "place"))
    size = np.linalg.norm(force, axis=1)
    largest = float(size.max(initial=0.0))
    outside = ~(table["eccentricity"] <= 1.0 + INSIDE)
    place[outside] = _middles(result.joints, between)[outside]
    faces = FaceDrawing(blocks, camera)
    pieces = _pieces(result, camera)
    for piece in pieces:
        faces.add_piece(piece)
    figure, axes = _figure(result, f"thrust at {_factor(result)}: the largest is {largest * 1e-3:.4g} kN")
    faces.draw(axes)
    draw_road(axes, result.scene, result.specimen, result.joints, camera)
    for element in result.elements:
        element.draw(axes, result.scene, blocks, camera, None, pieces)
    shown = size > LEAST * largest
    if not camera.along_an_axis:
        shown &= ~behind_others(place, between.units, pieces, blocks, camera)
    half = 0.5 * LONGEST * camera.size / max(largest, 1e-300)
    ends = np.stack([camera.project(place + sign * half * force) for sign in (-1.0, 1.0)], axis=1)
    for k in np.flatnonzero(shown):
        axes.plot(*ends[k].T, color=COLOUR, lw=1.2, zorder=4.0)
    for which, fill in ((shown & ~outside, COLOUR), (shown & outside, "white")):
        axes.plot(*camera.project(place[which]).T, "o", color=COLOUR, mfc=fill, ms=3.0, mew=0.8, zorder=4.1)
    row = row_of(between.units)
    if row is not None and len(row) >= ROW and not outside.any():
        axes.plot(*camera.project(place[row]).T, "--", color=COLOUR, lw=0.9, zorder=4.0)
    return _fitted(figure, axes)


def _middles(joints: Joints, between: UnitJoints) -> np.ndarray:
    """(J, 3) m the centroid of each joint between units."""
    area = joints.area[between.contact]
    moment = np.add.reduceat(area[:, None] * joints.point[between.contact], between.start[:-1], axis=0)
    return np.asarray(moment / np.add.reduceat(area, between.start[:-1])[:, None])


def _factor(result: LimitData) -> str:
    ending = " (no bound)" if result.with_dilation is not None else ""
    return f"{head_of(result)} {factor_words(result)}{ending}"


def _is_floor(result: LimitData) -> np.ndarray:
    """(B,) blocks that are left out of a picture, since they would fill it."""
    groups = result.specimen.blocks.groups
    return np.array([result.scene.is_floor(name) for name in groups])[result.specimen.blocks.group]


def _pieces(result: LimitData, camera: Camera) -> list[Piece]:
    blocks = result.specimen.blocks
    floor = _is_floor(result)[blocks.face_block()]
    return [piece for piece in visible_pieces(blocks, result.joints, camera) if not floor[piece.face]]


def _figure(result: LimitData, words: str) -> tuple[Any, Any]:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(WIDTH, WIDTH), layout="constrained")
    figure.suptitle(plain(result.title), fontsize=13, wrap=True)
    axes = figure.subplots()
    axes.set_title(words, fontsize=10, color="0.3")
    return figure, axes


def _fitted(figure: Any, axes: Any) -> Any:
    """Equal scales, no frame, and a height that fits."""
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.autoscale_view()
    axes.margins(0.02)
    low, high = axes.dataLim.min, axes.dataLim.max
    aspect = float((high[1] - low[1]) / max(high[0] - low[0], 1e-300))
    figure.set_size_inches(WIDTH, min(max((WIDTH - 0.5) * aspect, 1.5), 8.5) + 0.9)
    return figure
