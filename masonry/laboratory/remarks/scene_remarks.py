"""What a user should know of the values of a scene: those that no masonry has, and a drive that shakes more than it
should."""

from itertools import pairwise
from typing import Any

import numpy as np

from geometry.polyhedra.measures import volumes
from masonry.assembly.assemble import Assembly
from masonry.scene import Scene
from masonry.scene.unit_weights import DIVIDED

HEAVIEST = 30_000.0
"""kg/m3; the heaviest matter there is has 22,600."""
ROUGHEST = 10.0
"""Coefficient of friction; the roughest joints of stone have 1.5."""
FASTEST = 100.0
"""m/s; what falls by 500 m comes down as fast."""
LARGEST = 1e6
"""Volume of a block over that of another."""
MORE, FELT = 1.2, 0.1
"""Accelerations of a drive over those of its record from which on that is told; and m/s2, a hundredth of gravity, below
which no block feels them."""


def unit_weights(scene: Scene) -> list[str]:
    """A line for each density that was given as a unit weight."""
    keys = [key for key, why in scene.assumptions.items() if why.endswith(DIVIDED)]
    return [f"{key}: {scene.assumptions[key]}, which is {_at(scene, key):.4g} kg/m3" for key in keys]


def _at(scene: Scene, key: str) -> Any:
    """The value of a dotted key that ends in a table of the scene by name or number."""
    table, name, last = key.split(".", 1)[0], key.split(".", 1)[1].rpartition(".")[0], key.rpartition(".")[2]
    tables = getattr(scene, table)
    return getattr(tables[int(name)] if isinstance(tables, tuple) else tables[name], last)


def scene_remarks(assembly: Assembly) -> list[str]:
    """One line for each value that cannot be meant, and for a drive that shakes too much."""
    scene = assembly.scene
    found = [
        f"{key} = {value:.4g} {unit}: {why}" if unit else f"{key} = {value:.4g}: {why}"
        for key, value, most, unit, why in _values(scene)
        if value > most
    ]
    return [*found, *_shaken(assembly)]


def _values(scene: Scene) -> list[tuple[str, float, float, str, str]]:
    """Key, value, the most that makes sense, unit, and what is said beyond it."""
    heavy = "heavier than any matter; is the unit right?"
    rough = f"no joint is as rough: above {ROUGHEST:g} it cannot slide, and says nothing of friction"
    fast = f"faster than {FASTEST:g} m/s; is the unit right?"
    found = [(f"material.{name}.density", m.density, HEAVIEST, "kg/m3", heavy) for name, m in scene.material.items()]
    found += [(f"fill.{k}.density", fill.density, HEAVIEST, "kg/m3", heavy) for k, fill in enumerate(scene.fill)]
    for name, contact in scene.contact.items():
        key = "friction_angle" if contact.tan_friction_angle is None else "tan_friction_angle"
        words = rough if contact.tan_friction_angle is not None else f"the tangent of this angle; {rough}"
        found.append((f"contact.{name}.{key}", contact.tan_friction or 0.0, ROUGHEST, "", words))
    for k, motion in enumerate(scene.motion):
        found.append((f"motion.{k}.velocity", float(np.linalg.norm(motion.velocity)), FASTEST, "m/s", fast))
    if scene.drive is not None and scene.drive.rate is not None:
        found.append(("drive.rate", scene.drive.rate, FASTEST, "m/s", fast))
    return found


def size_remarks(assembly: Assembly) -> list[str]:
    """Of blocks so unlike in size that one of them may be a mistake, the two extremes; the floor is not one of them. A
    run of them is no less right: `masonry check` asks."""
    blocks, scene = assembly.specimen.blocks, assembly.scene
    floor = [number for number, name in enumerate(blocks.groups) if scene.is_floor(name)]
    size = np.where(np.isin(blocks.group, floor), np.nan, volumes(blocks))
    if np.isnan(size).all() or np.nanmax(size) <= LARGEST * np.nanmin(size):
        return []
    large, small = int(np.nanargmax(size)), int(np.nanargmin(size))
    return [
        f"specimen: block {large} has {size[large]:.3g} m3, block {small} {size[small]:.3g} m3, "
        f"{size[large] / size[small]:.2g} times less: is the smaller one a splinter, or the unit of one of them wrong?"
    ]


def _shaken(assembly: Assembly) -> list[str]:
    """Of a drive along a table in real time, whose interpolant stands still at each row where it turns."""
    drive, model = assembly.scene.drive, assembly.model
    if drive is None or model.scaled or drive.accuracy is not None or drive.path is None:
        return []
    if isinstance(drive.history, str):
        return []
    made, meant = accelerations(np.array(drive.history))
    stretch = drive.path.duration / (drive.steps * model.dt) if drive.steps else 1.0
    made, meant = made * stretch**2, meant * stretch**2
    if made < FELT or made < MORE * meant:
        return []
    return [
        f"drive.history: in real time the drive stands still at each row where it turns, and accelerates by up to "
        f"{made:.3g} m/s2, where the second differences of its rows reach {meant:.3g} m/s2: what it shakes is shaken "
        f"{_times(made, meant)} too hard; give more rows between turns, or an expression of t"
    ]


def _times(made: float, meant: float) -> str:
    return f"{made / meant:.2g} times" if meant > 0.0 else "far"


def accelerations(table: np.ndarray) -> tuple[float, float]:
    """m/s2: the largest acceleration of the cubics (PCHIP) through rows (n, 2) of times (s) and places (m), and the
    largest second difference of the rows."""
    from scipy.interpolate import PchipInterpolator

    time, place = table[:, 0], table[:, 1]
    curve = PchipInterpolator(time, place)
    a, b = curve.c[:2]
    step = np.diff(time)
    made = max(float(np.abs(2.0 * b).max()), float(np.abs(6.0 * a * step + 2.0 * b).max()))
    speed = np.diff(place) / step
    second = [
        2.0 * (after - before) / (h + g)
        for (before, after), (h, g) in zip(pairwise(speed), pairwise(step), strict=True)
    ]
    return made, float(np.abs(second).max(initial=0.0)) if second else 0.0
