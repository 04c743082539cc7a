"""Supports, drive and loads of a specimen, as arrows of a page: each load that the model bears."""

from typing import Any

import numpy as np

from geometry.polyhedra.measures import centroids
from masonry.assembly.assemble import Fabric
from masonry.assembly.conditions import conditions_of
from masonry.assembly.growing_loads import let_grow
from masonry.drawings.condition_marks import marks
from masonry.drawings.mark_drawing import COLOURS
from masonry.model.layout import KINDS, Layout
from masonry.model.loads import Conditions, Load
from masonry.scene import Scene
from masonry.viewing.buffers import Buffers

GROWS, WEIGHT = "#8e44ad", "#7a6a4f"
"""Of the load that grows, and of what weighs."""
NOTHING = 1e-9
"""Fraction of the largest force of a load, below which a block bears none of it."""


def loads_part(scene: Scene, fabric: Fabric, origin: np.ndarray, into: Buffers) -> list[dict[str, Any]]:
    """A list of what acts: its words, its colour, and arrows as tips (n, 3) m, directions (n, 3) and forces (n,) N; of
    supports and the drive the arrows have no force, and begin at their tips where they pull. Raises SceneError."""
    specimen, joints, layout = fabric.specimen, fabric.joints, fabric.layout
    listed = marks(scene, specimen, joints)
    entries = [
        _entry(mark.words, COLOURS[mark.kind], *_arrows_of_mark(mark), origin, into)
        | {"kind": mark.kind, "blocks": mark.blocks.tolist(), "pulls": not all(presses for *_, presses in mark.arrows)}
        for mark in listed
        if mark.kind != "traction"
    ]
    conditions = conditions_of(scene, specimen, layout, joints, fabric.density, fabric.moving_density)
    grows = _add_growing(scene, fabric, conditions)
    for name, load in conditions.each_load.items():
        tip, force = forces_of(layout, load, centroids(specimen.blocks))
        size = np.linalg.norm(force, axis=1)
        bears = size > NOTHING * size.max(initial=0.0)
        if not bears.any():
            continue
        words = f"{_words(name, scene)}: {_resultant(force)}"
        colour = GROWS if name in grows else WEIGHT if name.startswith(("gravity", "fill")) else COLOURS["traction"]
        direction = force[bears] / size[bears, None]
        entries.append(_entry(words, colour, tip[bears], direction, size[bears], origin, into))
    return entries + _axles(scene, specimen.blocks.points, origin, into)


def forces_of(layout: Layout, load: Load, middle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places (B, 3) m and forces (B, 3) N of a load on each block: of a rigid block on the line of action nearest to
    its centroid, of other blocks where the forces are, weighted by their size, or in the middle (B, 3)."""
    count = len(layout.kind)
    force, weighted, size = np.zeros((count, 3)), np.zeros((count, 3)), np.zeros(count)
    for kind in KINDS:
        rows = load[kind]
        if rows is None:
            continue
        owner, part = layout.owner[kind], np.linalg.norm(rows[:, :3], axis=1)
        np.add.at(force, owner, rows[:, :3])
        np.add.at(size, owner, part)
        np.add.at(weighted, owner, part[:, None] * layout.place[kind])
    place = np.where(size[:, None] > 0.0, weighted / np.maximum(size, 1e-300)[:, None], middle)
    rigid = load["rigid"]
    if rigid is not None:
        which = layout.members["rigid"]
        moment = np.einsum("bij,bj->bi", layout.axes[which], rigid[:, 3:])
        square = np.einsum("bi,bi->b", rigid[:, :3], rigid[:, :3])
        lever = np.cross(rigid[:, :3], moment) / np.where(square > 0.0, square, 1.0)[:, None]
        place[which] += lever
    return place, force


def _add_growing(scene: Scene, fabric: Fabric, into: Conditions) -> set[str]:
    """Add the load of [limit] at a factor of 1, whether or not a run lets it grow; the names of what was added."""
    limit = scene.limit
    stands_nowhere = (
        limit is not None and limit.pattern == "vehicle" and getattr(scene.vehicle, "position", None) is None
    )
    if limit is None or limit.pattern == "drive" or stands_nowhere:
        return set()
    before = set(into.each_load)
    let_grow(scene, fabric.specimen, fabric.joints, fabric.layout, fabric.density, into)
    return set(into.each_load) - before


def _words(name: str, scene: Scene) -> str:
    """A load in words for people, from its name in the model."""
    kind, _, number = name.partition(".")
    if kind == "limit" or name.startswith("limit "):
        assert scene.limit is not None
        return f"{scene.limit.words}, at a factor of 1" + (" (part that turns)" if name == "limit cos" else "")
    if kind == "traction":
        traction = scene.traction[int(number)]
        return f"traction {number} on {traction.on}" + (", times its history" if traction.history is not None else "")
    if kind == "fill":
        return f"fill {number} on {scene.fill[int(number)].on}"
    return {"gravity": "weight"}.get(name, name)


def _resultant(force: np.ndarray) -> str:
    """The sum (N) of forces (B, 3), by direction, in kN."""
    total, largest = force.sum(axis=0), float(np.abs(force).sum(axis=0).max())
    parts = [f"{axis} {1e-3 * x:.4g} kN" for axis, x in zip("xyz", total, strict=True) if abs(x) > 1e-6 * largest]
    return ", ".join(parts) or "no resultant"


def _arrows_of_mark(mark: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Tips, directions and no forces: of a drive where it pushes or pulls; of a support none, it is drawn on its
    blocks."""
    if not mark.arrows:
        return np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0)
    tips = np.concatenate([base for base, _, _ in mark.arrows])
    directions = np.concatenate([np.tile(direction, (len(base), 1)) for base, direction, _ in mark.arrows])
    return tips, directions, np.zeros(len(tips))


def _axles(scene: Scene, points: np.ndarray, origin: np.ndarray, into: Buffers) -> list[dict[str, Any]]:
    """Axles of a vehicle on its road; one that travels stands in the middle of its way."""
    vehicle = scene.vehicle
    if vehicle is None:
        return []
    low, high = vehicle.between or (float(points[:, 0].min()), float(points[:, 0].max()))
    middle = 0.5 * (low + high) if vehicle.position is None else vehicle.position
    places = vehicle.places(middle, vehicle.directions[0])
    y = 0.5 * (points[:, 1].min() + points[:, 1].max())
    tips = np.array([[x, y, vehicle.level] for x in np.asarray(places).tolist()])
    force = np.array(vehicle.axles, dtype=float)
    words = f"vehicle: {len(force)} axles, {1e-3 * vehicle.total:.4g} kN"
    words += ", travels; drawn in the middle of its way" if vehicle.position is None else ""
    down = np.tile([0.0, 0.0, -1.0], (len(force), 1))
    return [_entry(words, COLOURS["traction"], tips, down, force, origin, into)]


def _entry(
    words: str,
    colour: str,
    tip: np.ndarray,
    direction: np.ndarray,
    force: np.ndarray,
    origin: np.ndarray,
    into: Buffers,
) -> dict[str, Any]:
    return {
        "kind": "load",
        "words": words,
        "colour": colour,
        "tip": into.add(tip - origin),
        "direction": into.add(direction),
        "force": into.add(force),
    }
