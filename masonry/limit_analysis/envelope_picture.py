"""The factor of a vehicle over its position, above the structure on the same scale, as a picture and as a table."""

from typing import Any

import numpy as np

from masonry.drawings.road_drawing import draw_road
from masonry.limit_analysis.limit_data import LimitData
from masonry.limit_analysis.positions import FactorEnvelope
from masonry.pictures.camera import Camera
from masonry.pictures.faces import FaceDrawing
from masonry.pictures.hidden_surfaces import visible_pieces
from masonry.pictures.style import plain, tidy

WIDTH = 9.0
"""Of the picture, inches."""
BESIDE = 0.9
"""Of its width, beside the axes, inches."""
SHOWN = 4.0
"""How many times the least factor the picture reaches up to."""
COLOURS = {"x": "#1f5fa8", "-x": "#c0392b"}
HEADER = "direction,position_m,factor\n"


def envelope_figure(result: LimitData) -> Any:
    """A matplotlib figure: factors over positions (m), and the structure below, with the vehicle at the least."""
    from matplotlib.figure import Figure

    envelope = result.envelope
    assert envelope is not None
    points = result.specimen.blocks.points
    size = float(np.ptp(points, axis=0).max())
    low, high = points.min(axis=0), points.max(axis=0)
    ends = min(low[0], envelope.position.min()) - 0.02 * size, max(high[0], envelope.position.max()) + 0.02 * size
    top = result.scene.vehicle.level if result.scene.vehicle is not None else high[2]
    levels = low[2] - 0.02 * size, top + 0.18 * size
    tall = (WIDTH - BESIDE) * (levels[1] - levels[0]) / (ends[1] - ends[0])
    figure = Figure(figsize=(WIDTH, min(4.6 + tall, 12.0)), layout="constrained")
    figure.suptitle(plain(result.title), fontsize=13, wrap=True)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[3.0, tall])
    _draw_factors(above, envelope)
    camera = Camera(np.eye(3)[0], np.eye(3)[2], -np.eye(3)[1], size)
    faces = FaceDrawing(result.specimen.blocks, camera)
    floors = [result.scene.is_floor(name) for name in result.specimen.blocks.groups]
    owner = result.specimen.blocks.group[result.specimen.blocks.face_block()]
    for piece in visible_pieces(result.specimen.blocks, result.joints, camera):
        if not floors[owner[piece.face]]:
            faces.add_piece(piece)
    faces.draw(below)
    draw_road(below, result.scene, result.specimen, result.joints, camera)
    below.margins(0.0)
    below.update_datalim(np.column_stack([ends, levels]))
    below.autoscale_view()
    below.set_aspect("equal", adjustable="datalim")
    below.set_xlabel("x, m")
    below.set_ylabel("z, m")
    below.spines[["top", "right"]].set_visible(False)
    return figure


def envelope_table(envelope: FactorEnvelope) -> str:
    """Lines of a CSV file: direction, position (m), factor, under HEADER."""
    rows = zip(envelope.direction, envelope.position.tolist(), envelope.factor.tolist(), strict=True)
    return HEADER + "".join(f"{way},{x!r},{factor!r}\n" for way, x, factor in rows)


def _draw_factors(axes: Any, envelope: FactorEnvelope) -> None:
    ways = list(dict.fromkeys(envelope.direction))
    for way in ways:
        position, factor = envelope.along(way)
        label = f"leads along {way}" if len(ways) > 1 else None
        axes.plot(position, np.where(np.isfinite(factor), factor, np.nan), "-", color=COLOURS[way], lw=1.6, label=label)
    minimum, x = float(envelope.factor.min()), float(envelope.position[envelope.least])
    axes.plot(x, minimum, "o", color="black", ms=6, zorder=5)
    axes.annotate(
        f"{minimum:.4g} at {x:.4g} m",
        (x, minimum),
        (0, -8),
        textcoords="offset points",
        ha="center",
        va="top",
        fontsize=10,
    )
    finite = envelope.factor[np.isfinite(envelope.factor)]
    axes.set_ylim(0.0, min(SHOWN * max(minimum, 1e-300), 1.05 * float(finite.max())) or None)
    axes.set_ylabel("load factor")
    axes.tick_params(labelbottom=True)
    axes.set_xlabel("position of the middle of the vehicle, m")
    tidy(axes)
    if len(ways) > 1:
        axes.legend(frameon=False)
