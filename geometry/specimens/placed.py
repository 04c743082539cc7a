"""A specimen where it stands: turned about an axis, with slabs on it, and on a floor."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from geometry.blocks import Blocks, GeometryError, Specimen, TetMesh
from geometry.checks import require_lengths
from geometry.polyhedra.construct import concatenate, from_boxes
from geometry.polyhedra.overlaps import check_overlaps

FLOOR = "floor"
"""The name of the floor: of its group and of its set."""
MARGIN, THICKNESS = 2.0, 0.25
"""Of the specimen's longest side: how far a floor reaches beyond it on each side, and how thick it is."""
BELOW = 1e-9
"""Of that side: by how much blocks may be lower than the floor, as numbers are rounded."""


def rotation(axis: Sequence[float], angle: float) -> np.ndarray:
    """(3, 3) matrix of a turn by an angle (rad, right-hand rule) about an axis (3,) of length 1; Rodrigues' formula."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross)


def turned(points: np.ndarray, axis: Sequence[float], angle: float, through: Sequence[float]) -> np.ndarray:
    """Points (n, 3) m turned by an angle (rad) about an axis (3,) of length 1 through a point (3,) m."""
    middle = np.asarray(through, dtype=float)
    return np.asarray((points - middle) @ rotation(axis, angle).T + middle)


def on_floor(
    specimen: Specimen,
    level: float | None = None,
    size: Sequence[float] | None = None,
    thickness: float | None = None,
    travel: float = 0.0,
) -> Specimen:
    """The specimen and below it one block more, the last: group, set and unit of its own, "floor".

    level      m, z of its upper face; the lowest point of the specimen where it is None
    size       (2,) m along x and y, its middle below that of the specimen; None: 2 longest sides beyond each side,
               and the travel (m) of the ground besides
    thickness  m; None: a quarter of the longest side
    Raises GeometryError where a block lies below the level, or the specimen has a floor already.
    """
    blocks = specimen.blocks
    if FLOOR in (*blocks.groups, *specimen.sets):
        raise GeometryError(
            f"floor: the specimen has a group or a set '{FLOOR}' already; rename it, or leave [floor] out"
        )
    corners = blocks.points[blocks.face_points]
    low, high = corners.min(axis=0), corners.max(axis=0)
    longest = float((high - low).max())
    top = float(low[2]) if level is None else level
    if top > low[2] + BELOW * longest:
        raise GeometryError(
            f"floor.level: {top:.6g} m is above the lowest corner of the specimen, at z = {low[2]:.6g} m; no block may "
            f"reach below the floor: allowed is {low[2]:.6g} m or less, or leave it out"
        )
    thick = THICKNESS * longest if thickness is None else thickness
    extent = high[:2] - low[:2] + 2.0 * (MARGIN * longest + travel) if size is None else np.asarray(size, dtype=float)
    require_lengths("floor", {"size along x": extent[0], "size along y": extent[1], "thickness": thick})
    middle = 0.5 * (low + high)[:2]
    bottom, upper = np.append(middle - 0.5 * extent, top - thick), np.append(middle + 0.5 * extent, top)
    floor = from_boxes(bottom, upper, np.array([blocks.unit.max() + 1]), np.zeros(1), (FLOOR,))
    both = concatenate([blocks, floor])
    check_overlaps(both)
    return replace(specimen, blocks=both, sets={**specimen.sets, FLOOR: np.array([blocks.count])})


Slab = tuple[str, Sequence[float], Sequence[float], str]
"""Name, lowest corner (3,) m, size (3,) m, and group."""


def with_slabs(specimen: Specimen, slabs: Sequence[Slab]) -> Specimen:
    """The specimen and behind its blocks more boxes, such as floors that rest on walls: each a unit and a set of its
    name; all that there are make the sets of their groups.

    Raises GeometryError where a set has the name already, a size is not positive, or one overlaps another block.
    """
    if not slabs:
        return specimen
    blocks, count = specimen.blocks, specimen.blocks.count
    if specimen.joints is not None:
        raise GeometryError("slab: the joints of this file bridge gaps; a slab would have none")
    names = [slab[0] for slab in slabs]
    for name in names:
        if name in specimen.sets or names.count(name) > 1:
            raise GeometryError(f"slab: there is a set '{name}' already; each slab needs a name of its own")
    for name, _, size, _ in slabs:
        require_lengths(f"slab {name!r}", {f"size along {axis}": s for axis, s in zip("xyz", size, strict=True)})
    groups = tuple(dict.fromkeys(group for *_, group in slabs))
    low = np.array([origin for _, origin, _, _ in slabs], dtype=float)
    unit = blocks.unit.max() + 1 + np.arange(len(slabs))
    group = np.array([groups.index(slab[3]) for slab in slabs])
    added = from_boxes(low, low + np.array([size for _, _, size, _ in slabs]), unit, group, groups)
    both = concatenate([blocks, added])
    check_overlaps(both)
    none = np.zeros(0, dtype=np.int64)
    members = {name: count + np.flatnonzero(group == k) for k, name in enumerate(groups)}
    sets = {name: np.concatenate([specimen.sets.get(name, none), which]) for name, which in members.items()}
    own = {name: np.array([count + k]) for k, name in enumerate(names)}
    return replace(specimen, blocks=both, sets={**specimen.sets, **sets, **own})


def with_empty_blocks(mesh: TetMesh, blocks: Blocks) -> TetMesh:
    """A mesh with ranges for blocks that came after its own, which have no tets."""
    more = blocks.count + 1 - len(mesh.node_start)
    ends = (np.append(start, np.full(more, start[-1])) for start in (mesh.node_start, mesh.tet_start))
    return replace(mesh, **dict(zip(("node_start", "tet_start"), ends, strict=True)))
