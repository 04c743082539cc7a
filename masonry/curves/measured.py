"""The measured curve that a scene names, in the picture of the computed one."""

from typing import TYPE_CHECKING, Any

from masonry.curves.curve_axes import CurveAxes
from masonry.errors import SceneError
from masonry.pictures.style import MILLI
from masonry.rows.measured_curve import cycles, envelope
from masonry.scene.tables.gauge import Curve

if TYPE_CHECKING:
    from masonry.results.data import ResultData

COLOUR = "#3a8f5c"


def draw_measured(axes: Any, result: "ResultData", drawn: CurveAxes) -> None:
    """Draw it, with its envelopes where it turns back; nothing where there is none, or its file is gone."""
    table = result.scene_table.get("curve")
    if not isinstance(table, dict) or table.get("measured") is None:
        return
    try:
        path = Curve.model_validate(table).measurement(result.specimen.section)
    except (SceneError, ValueError):
        return
    if path is None:
        return
    up = drawn.factor / result.specimen.section
    axes.plot(MILLI * path.place, up * path.force, color=COLOUR, linewidth=1.4, label="measured", zorder=1.5)
    if cycles(path):
        for side in (1.0, -1.0):
            front = envelope(path, side)
            axes.plot(MILLI * front.place, up * front.force, ":", color=COLOUR, linewidth=1.2)
