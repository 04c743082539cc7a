"""A specimen of the user's own boxes."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import GeometryError, Specimen
from geometry.checks import require_counts, require_lengths
from geometry.polyhedra.construct import divide, from_boxes
from geometry.polyhedra.overlaps import check_overlaps

Box = tuple[str, Sequence[float], Sequence[float], str, int, Sequence[int]]


def boxes(box: Sequence[Box], section: float) -> Specimen:
    """Boxes (name, origin, size, group, unit, divisions), lengths in m; section in m2.

    There is a set for each box's name and one for each group's. Raises GeometryError for sizes that are not positive,
    names used twice, and boxes that overlap (naming both).
    """
    if not box:
        raise GeometryError("boxes: there is no box; give at least 1")
    if not (np.isfinite(section) and section > 0):
        raise GeometryError(f"boxes: section is {section:g} m^2, it must be greater than 0 m^2")
    _require_clear_names(box)
    groups = tuple(dict.fromkeys(group for _, _, _, group, _, _ in box))
    lows, highs, owner = [], [], []
    for number, (name, origin, size, _, _, divisions) in enumerate(box):
        if len(origin) != 3 or len(size) != 3 or not np.all(np.isfinite(np.asarray(origin, dtype=float))):
            raise GeometryError(f"boxes: box {name!r} must have an origin and a size of 3 numbers each (x, y, z)")
        require_lengths(f"boxes: box {name!r}", {f"size along {axis}": s for axis, s in zip("xyz", size, strict=True)})
        require_counts(f"boxes: box {name!r}", "divisions", divisions, "xyz")
        low, high = divide(origin, np.add(origin, size).tolist(), divisions)
        lows.append(low)
        highs.append(high)
        owner += [number] * len(low)
    of = np.array(owner)
    unit = np.array([b[4] for b in box])[of]
    group = np.array([groups.index(b[3]) for b in box])[of]
    blocks = from_boxes(np.concatenate(lows), np.concatenate(highs), unit, group, groups)
    check_overlaps(blocks, [box[number][0] for number in owner])
    sets = {name: np.flatnonzero(group == g) for g, name in enumerate(groups)}
    sets |= {b[0]: np.flatnonzero(of == number) for number, b in enumerate(box)}
    return Specimen(blocks, sets, section=section, shape="boxes")


def _require_clear_names(box: Sequence[Box]) -> None:
    """A name stands for one box; it may be a group's name only where the group is that box alone."""
    names = [b[0] for b in box]
    for name in names:
        if names.count(name) > 1:
            raise GeometryError(f"boxes: {names.count(name)} boxes are called {name!r}; each needs a name of its own")
        members = [b[0] for b in box if b[3] == name]
        if members and members != [name]:
            raise GeometryError(
                f"boxes: {name!r} is the name of a box and of the group of {', '.join(map(repr, members))}; rename one"
            )
