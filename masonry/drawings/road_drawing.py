"""Earth on blocks, the road above it, and the axles of a vehicle with what they spread on, in any view."""

from collections.abc import Callable
from typing import Any

import numpy as np

from geometry.blocks import Joints, Specimen
from geometry.polyhedra.polygons import pad
from masonry.assembly.conditions import select
from masonry.assembly.growing_loads import bed_of
from masonry.assembly.road.fill import open_faces
from masonry.pictures.camera import Camera
from masonry.pictures.overlays.axle_arrows import AXLE, draw_axle, draw_road_line, far_side
from masonry.scene import Scene

EARTH, BESIDE = "#d9c9a8", "0.6"
"""Of earth, and of an axle that does not press on the structure."""
Moves = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""By how much points (n, 3) of blocks (n,) are moved in a picture."""


def draw_road(
    axes: Any, scene: Scene, specimen: Specimen, joints: Joints, camera: Camera, moves: Moves | None = None
) -> None:
    """Fill, road and vehicle of a scene, where it has them; a vehicle that travels stands in the middle of its way."""
    moves = moves or (lambda block, points: np.zeros_like(points))
    surface = [np.zeros((0, 2))]
    for fill in scene.fill:
        chosen = select(specimen, joints, fill.on, "fill")[0]
        faces = open_faces(specimen.blocks, joints, chosen, "fill")
        surface.append(_draw_earth(axes, specimen, faces, fill.level, camera, moves))
    if scene.vehicle is not None:
        tops = np.concatenate(surface)
        _draw_vehicle(axes, scene, specimen, joints, camera, tops[np.argsort(tops[:, 0], kind="stable")])


def road_keys(scene: Scene) -> list[tuple[str, str]]:
    """Colour and words of what `draw_road` draws, for the list below a picture."""
    keys = [
        (EARTH, f"fill {k}: on {fill.on}, up to {fill.level:.4g} m, {fill.density:.4g} kg/m3")
        for k, fill in enumerate(scene.fill)
    ]
    if (vehicle := scene.vehicle) is None:
        return keys
    axles = "1 axle" if len(vehicle.axles) == 1 else f"{len(vehicle.axles)} axles"
    where = "travels" if vehicle.position is None else f"at x = {vehicle.position:.4g} m"
    spread = f"spreads by {np.degrees(vehicle.spread):.3g} deg"
    return [*keys, (AXLE, f"vehicle: {axles}, {vehicle.total * 1e-3:.4g} kN, {where}; {spread}")]


def _draw_earth(
    axes: Any, specimen: Specimen, faces: np.ndarray, level: float, camera: Camera, moves: Moves
) -> np.ndarray:
    """Columns above faces, as a strip on the far side, each moving with the block below it; returns the line through
    the middles of their tops (n, 2), x and z in m, from left to right."""
    from matplotlib.collections import PolyCollection

    blocks, y = specimen.blocks, far_side(specimen, camera)
    corners, count = (array[faces] for array in pad(blocks.points, blocks.face_start, blocks.face_points))
    strips, tops = [], []
    for polygon, number, block in zip(corners, count.tolist(), blocks.face_block()[faces].tolist(), strict=True):
        x, z = polygon[:number, 0], polygon[:number, 2]
        left, right = x.min(), x.max()
        ends = [(at, min(z[np.isclose(x, at)].max(), level)) for at in (left, right)]
        outline = np.array([[a, y, b] for a, b in [*ends, (right, level), (left, level)]])
        outline = outline + moves(np.full(len(outline), block), outline)
        outline[:, 1] = y
        strips.append(camera.project(outline))
        tops.append(outline[[3, 2]][:, [0, 2]])
    axes.add_collection(PolyCollection(strips, facecolors=EARTH, edgecolors=EARTH, linewidths=0.8, zorder=0.4))
    tops.sort(key=lambda top: float(top[:, 0].sum()))
    return np.array([tops[0][0], *(top.mean(axis=0) for top in tops), tops[-1][1]])


def _draw_vehicle(
    axes: Any, scene: Scene, specimen: Specimen, joints: Joints, camera: Camera, surface: np.ndarray
) -> None:
    """Road and axles on the surface (n, 2) of the earth, x and z in m; without any, at the level of the road."""
    from matplotlib.collections import PolyCollection

    vehicle, bed, y = scene.vehicle, bed_of(scene, specimen, joints), far_side(specimen, camera)
    assert vehicle is not None
    level = vehicle.level

    def place(x: float, z: float) -> np.ndarray:
        return camera.project(np.array([x, y, z]))

    middle = 0.5 * sum(vehicle.between or bed.reach(vehicle)) if vehicle.position is None else vehicle.position
    places = vehicle.places(middle, vehicle.directions[0])
    shares = bed.shares(vehicle, middle, vehicle.directions[0])
    ends = min(bed.low, *places) - 0.5 * vehicle.patch, max(bed.high, *places) + 0.5 * vehicle.patch
    rises = lambda x: float(np.interp(x, *surface.T)) if len(surface) else level  # noqa: E731
    draw_road_line(axes, [*sorted({*ends, *surface[:, 0].tolist()})], rises, specimen, camera)
    spreads = []
    colours = [AXLE if share > 0.0 else BESIDE for share in shares]
    for load, x, colour in zip(vehicle.axles, places.tolist(), colours, strict=True):
        low, high = bed.width_at(x, vehicle)
        top, half = rises(x), 0.5 * vehicle.patch
        below = top - bed.depth_at(x)
        spreads.append(np.array([place(x - half, top), place(x + half, top), place(high, below), place(low, below)]))
        draw_axle(axes, load, (x, top), colour, specimen, camera)
    axes.add_collection(PolyCollection(spreads, facecolors=colours, alpha=0.22, edgecolors="none", zorder=0.6))
