"""The axles of a vehicle above what bears them: arrows from the road, and the force of each."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from geometry.blocks import Specimen
from masonry.pictures.camera import Camera
from masonry.results.frame_choice import load_factor_at
from masonry.rows.history import Frame
from masonry.scene.tables.road.vehicle import Vehicle

if TYPE_CHECKING:
    from masonry.results.data import ResultData

ROAD, AXLE = "0.35", "#1f5fa8"
ARROW = 0.09
"""Length of an arrow over the size of the picture."""


def draw_axles_of(axes: Any, result: "ResultData", frame: Frame, camera: Camera) -> None:
    """The road, and the axles of a vehicle whose load grew in a run, with what they press in a frame."""
    vehicle, factor = vehicle_in(result), load_factor_at(result, frame)
    if vehicle is None or vehicle.position is None or factor is None:
        return
    places = vehicle.places(vehicle.position, vehicle.directions[0])
    x = [*result.specimen.blocks.points[:, 0], *places]
    draw_road_line(axes, (min(x), max(x)), lambda x: vehicle.level, result.specimen, camera)
    for load, place in zip(vehicle.axles, places.tolist(), strict=True):
        draw_axle(axes, factor * load, (place, vehicle.level), AXLE, result.specimen, camera)


def vehicle_in(result: "ResultData") -> Vehicle | None:
    """The vehicle of the scene of a run, where the run has its load."""
    table = result.scene_table
    if table.get("limit", {}).get("pattern") != "vehicle" or result.summary.collapse_load is None:
        return None
    return Vehicle.model_validate(table["vehicle"])


def draw_road_line(
    axes: Any, along: Sequence[float], level: Callable[[float], float], specimen: Specimen, camera: Camera
) -> None:
    """The road through places along x (m), from the first to the last, at its level (m) there."""
    flat = camera.project(np.array([[x, far_side(specimen, camera), level(x)] for x in along]))
    axes.plot(*flat.T, color=ROAD, lw=2.0, zorder=8.0)


def draw_axle(
    axes: Any, force: float, place: tuple[float, float], colour: str, specimen: Specimen, camera: Camera
) -> None:
    """An arrow down to the road at x and z (m), with a force (N) above it."""
    (x, level), y, arrow = place, far_side(specimen, camera), ARROW * camera.size
    tip, tail, above = camera.project(np.array([[x, y, level + times * arrow] for times in (0.0, 1.0, 1.6)]))
    style = {"arrowstyle": "-|>", "color": colour, "lw": 2.0, "mutation_scale": 14, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", tip, tail, zorder=9, arrowprops=style)
    axes.annotate(
        f"{force * 1e-3:.4g} kN", tail, (0, 3), textcoords="offset points", ha="center", va="bottom",
        fontsize=9, color=colour, zorder=9,
    )  # fmt: skip
    axes.update_datalim([tail, above])


def far_side(specimen: Specimen, camera: Camera) -> float:
    """m, y of the side of a specimen on which earth and roads are drawn: the far one, behind the blocks."""
    y = specimen.blocks.points[:, 1]
    return float(y.max() if camera.toward[1] < 0.0 else y.min())
