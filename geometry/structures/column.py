"""The column: drums of many sides one above the other, straight or tapered, on a base and under a capital."""

import numpy as np

from geometry.blocks import Blocks, GeometryError, Specimen
from geometry.checks import require_counts, require_lengths
from geometry.polyhedra.construct import from_faces
from geometry.structures.gathering import Gathering


def column(
    diameter: float,
    height: float,
    drums: int,
    sides: int = 24,
    top_diameter: float | None = None,
    base: float | None = None,
    capital: float | None = None,
    overhang: float = 0.0,
) -> Specimen:
    """Equally high drums of regular outline from z = 0 to `height`, the axis at x = y = 0.

    diameter      m, of the circle round the corners at the foot      top_diameter  m, at the head; default the same
    drums         1 or more        sides  of a drum, 3 or more; with 4, 8, 12, ... one looks along x and one along y
    base, capital  heights (m) of a square block below and above       overhang  m, by which they reach beyond the drums

    Sets "units" (drums and capital), "drums", "drum 1" (the lowest), "drum 2", ..., "top" (the highest block), "base",
    "capital". The section is that of the foot. Raises GeometryError for what cannot be built.
    """
    head = diameter if top_diameter is None else top_diameter
    lengths = {"diameter": diameter, "height": height, "top_diameter": head, "overhang": overhang}
    lengths |= {name: value for name, value in (("base", base), ("capital", capital)) if value is not None}
    require_lengths("column", lengths, zero_allowed=("overhang",))
    require_counts("column", "number of drums", (drums,), "z")
    require_counts("column", "number of sides", (sides,), "x")
    if sides < 3:
        raise GeometryError(f"column: number of sides is {sides}, it must be 3 or more; nearest: 3")
    built = Gathering()
    level = height * np.arange(drums + 1) / drums
    radius = 0.5 * (diameter + (head - diameter) * np.arange(drums + 1) / drums)
    for k in range(drums):
        built.add(_drum(radius[k : k + 2], level[k : k + 2], sides), "units", "drums", f"drum {k + 1}")
    if capital is not None:
        half = 0.5 * head + overhang
        built.add_boxes([(-half, -half, height)], [(half, half, height + capital)], "units", "units", "capital")
    built.sets["top"] = np.array([built.count - 1])
    if base is not None:
        half = 0.5 * diameter + overhang
        built.add_boxes([(-half, -half, -base)], [(half, half, 0.0)], "plates", "base")
    section = 0.5 * sides * radius[0] ** 2 * np.sin(2 * np.pi / sides)
    return Specimen(built.blocks(), built.sets, section=float(section), shape="column")


def _drum(radius: np.ndarray, level: np.ndarray, sides: int) -> Blocks:
    """A body between two regular polygons, of radius (2,) m at a level (2,) m."""
    angle = 2 * np.pi * (np.arange(sides) + 0.5) / sides
    direction = np.stack([np.cos(angle), np.sin(angle), np.zeros(sides)], axis=1)
    low, high = (r * direction + (0.0, 0.0, z) for r, z in zip(radius, level, strict=True))
    after = np.roll(np.arange(sides), -1)
    around = [np.stack([low[a], low[b], high[b], high[a]]) for a, b in enumerate(after)]
    return from_faces([[low[::-1], high, *around]], [0], [0], ("units",))
