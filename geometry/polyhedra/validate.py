"""Is what came from outside a specimen at all? Shapes, indices, numbers, flat faces, closed blocks, whole tets."""

import numpy as np

from geometry.blocks import Blocks, GeometryError, JointPolygons, TetMesh
from geometry.polyhedra.convexity import outside
from geometry.polyhedra.indexing import ranges
from geometry.polyhedra.measures import extent, face_areas_normals_centroids, volumes
from geometry.polyhedra.polygons import areas_normals_centroids, pad

FLAT = 1e-9
"""How far a corner may stand off its face, over the specimen's longest side."""
CLOSED = 1e-7
"""What the area vectors of a block's faces may add up to, over the block's surface."""
FARTHEST = 1e8
"""m from the origin; beyond, areas and volumes lose themselves in rounding, and at last overflow."""
PADDED = 5e7
"""Faces times the corners of the largest: the size of the tables that measures work on."""
FILLED = 1e-6
"""By how much the tets of a block may miss its volume, over the volume."""


def require_sound(blocks: Blocks) -> None:
    """Raise GeometryError, naming the block or face, unless numbers are sane, faces flat and convex, blocks closed."""
    require_whole(blocks)
    _require_flat(blocks)
    _require_convex(blocks)
    _require_closed(blocks)


def require_whole(blocks: Blocks) -> None:
    """Raise GeometryError unless all tables fit together and all numbers are sane, whatever shape the blocks have."""
    _require_table("points", blocks.points, (None, 3), float)
    require_near(blocks)
    for name in ("face_start", "face_points", "block_face_start", "unit", "group"):
        _require_table(name, getattr(blocks, name), (None,), int)
    if blocks.count == 0:
        raise GeometryError("there are no blocks")
    _require_starts("block_face_start", blocks.block_face_start, blocks.count, len(blocks.face_start) - 1, minimum=4)
    _require_starts("face_start", blocks.face_start, len(blocks.face_start) - 1, len(blocks.face_points), minimum=3)
    maximum = int(np.diff(blocks.face_start).max())
    if maximum * (len(blocks.face_start) - 1) > PADDED:
        raise GeometryError(f"a face has {maximum} corners: too many for {len(blocks.face_start) - 1} faces")
    _require_range("face_points", blocks.face_points, len(blocks.points))
    if len(blocks.group) != blocks.count:
        raise GeometryError(f"group has {len(blocks.group)} entries, there are {blocks.count} blocks")
    _require_range("group", blocks.group, len(blocks.groups))


def require_near(blocks: Blocks) -> None:
    """Raise GeometryError for points too far from the origin to be a building."""
    reach = float(np.abs(blocks.points).max(initial=0.0))
    if not reach <= FARTHEST:
        raise GeometryError(
            f"points lie up to {reach:.3g} m from the origin, allowed: {FARTHEST:.0e} m; is the unit right?"
        )


def require_sound_mesh(blocks: Blocks, mesh: TetMesh) -> None:
    """Raise GeometryError unless the tets of each block are its own, turned the right way round, and fill it."""
    _require_table("nodes", mesh.nodes, (None, 3), float)
    _require_table("tets", mesh.tets, (None, 4), int)
    for name in ("node_start", "tet_start"):
        _require_table(name, getattr(mesh, name), (None,), int)
    _require_starts("node_start", mesh.node_start, blocks.count, len(mesh.nodes), minimum=0)
    _require_starts("tet_start", mesh.tet_start, blocks.count, len(mesh.tets), minimum=0)
    owner = np.repeat(np.arange(blocks.count), np.diff(mesh.tet_start))
    inside = (mesh.tets >= mesh.node_start[owner, None]) & (mesh.tets < mesh.node_start[owner + 1, None])
    if not inside.all():
        tet = int(np.argmin(inside.all(axis=1)))
        raise GeometryError(f"tet {tet} of block {owner[tet]} has a node that is not the block's")
    edge = mesh.nodes[mesh.tets[:, 1:]] - mesh.nodes[mesh.tets[:, :1]]
    volume = np.linalg.det(edge) / 6
    if np.any(volume <= 0):
        tet = int(np.argmin(volume))
        raise GeometryError(f"tet {tet} of block {owner[tet]} has a volume of {volume[tet]:.3g} m3, it must be above 0")
    filled = np.bincount(owner, volume, minlength=blocks.count)
    whole = volumes(blocks)
    wrong = (np.diff(mesh.tet_start) > 0) & (np.abs(filled - whole) > FILLED * whole)
    if wrong.any():
        b = int(np.argmax(wrong))
        raise GeometryError(f"the tets of block {b} fill {filled[b]:.6g} m3 of its {whole[b]:.6g} m3")


def require_sound_joints(blocks: Blocks, joints: JointPolygons) -> None:
    """Raise GeometryError unless stated joints are flat polygons between two different blocks that there are."""
    _require_table("joints/points", joints.points, (None, 3), float)
    _require_table("joints/gap", joints.gap, (len(joints.block_a), 2), float)
    for name in ("block_a", "block_b", "start"):
        _require_table(f"joints/{name}", getattr(joints, name), (None,), int)
    _require_starts("joints/start", joints.start, len(joints.block_a), len(joints.points), minimum=3)
    _require_table("joints/block_b", joints.block_b, (len(joints.block_a),), int)
    for name in ("block_a", "block_b"):
        _require_range(f"joints/{name}", getattr(joints, name), blocks.count)
    if np.any(joints.block_a >= joints.block_b):
        raise GeometryError(f"joints: entry {int(np.argmax(joints.block_a >= joints.block_b))} has block_a >= block_b")
    maximum = int(np.diff(joints.start).max(initial=0))
    if maximum * len(joints.block_a) > PADDED:
        raise GeometryError(f"a joint has {maximum} corners: too many for {len(joints.block_a)} joints")
    if not np.all(np.abs(joints.points) <= FARTHEST):
        raise GeometryError(f"joints/points lie farther than {FARTHEST:.0e} m from the origin")
    corners, _ = pad(joints.points, joints.start, np.arange(len(joints.points)))
    area, normal, middle = areas_normals_centroids(corners)
    distance = np.abs(np.einsum("nki,ni->nk", corners - middle[:, None], normal)).max(axis=1, initial=0.0)
    wrong = ~(area > 0) | (distance > FLAT * extent(blocks))
    if wrong.any():
        raise GeometryError(f"joints: polygon {int(np.argmax(wrong))} has no area, or is not flat")


def _require_table(name: str, values: np.ndarray, shape: tuple, kind: type) -> None:
    required = " x ".join("n" if n is None else str(n) for n in shape)
    fits = values.ndim == len(shape) and all(n is None or n == m for n, m in zip(shape, values.shape, strict=True))
    if not fits:
        raise GeometryError(f"{name} has the shape {values.shape}, it must be {required}")
    if values.dtype.kind != ("f" if kind is float else "i"):
        raise GeometryError(f"{name} holds {values.dtype}, it must hold {'numbers' if kind is float else 'integers'}")
    if kind is float and not np.isfinite(values).all():
        row = int(np.argmin(np.isfinite(values).all(axis=1)))
        raise GeometryError(f"{name}: row {row} is not finite")


def _require_starts(name: str, start: np.ndarray, count: int, last: int, minimum: int) -> None:
    if len(start) != count + 1 or count < 0:
        raise GeometryError(f"{name} has {len(start)} entries, it must have {count + 1}")
    if start[0] != 0 or start[-1] != last:
        raise GeometryError(f"{name} runs from {start[0]} to {start[-1]}, it must run from 0 to {last}")
    steps = np.diff(start)
    if np.any(steps < minimum):
        row = int(np.argmin(steps))
        raise GeometryError(f"{name}: entry {row} holds {steps[row]}, at least {minimum} are needed")


def _require_range(name: str, index: np.ndarray, count: int) -> None:
    wrong = (index < 0) | (index >= count)
    if wrong.any():
        row = int(np.argmax(wrong))
        raise GeometryError(f"{name}: entry {row} is {index[row]}, allowed: 0 to {count - 1}")


def _require_flat(blocks: Blocks) -> None:
    area, normal, centroid = face_areas_normals_centroids(blocks)
    owner = blocks.face_block()
    if not np.all(area > 0):
        face = int(np.argmin(area))
        raise GeometryError(f"face {face} of block {owner[face]} has no area")
    of, corner = ranges(blocks.face_start[:-1], np.diff(blocks.face_start))
    arm = blocks.points[blocks.face_points[corner]] - centroid[of]
    height = np.abs(np.einsum("ni,ni->n", arm, normal[of]))
    worst = int(np.argmax(height))
    if height[worst] > FLAT * extent(blocks):
        f = of[worst]
        raise GeometryError(
            f"face {f} of block {owner[f]} is not flat: a corner stands {height[worst]:.3g} m off it, "
            f"allowed: {FLAT * extent(blocks):.3g} m"
        )


def _require_convex(blocks: Blocks) -> None:
    corners, count = pad(blocks.points, blocks.face_start, blocks.face_points)
    distance = outside(corners, count)
    f = int(np.argmax(distance))
    if distance[f] > FLAT * extent(blocks):
        raise GeometryError(
            f"face {f} of block {blocks.face_block()[f]} is not convex: a corner lies {distance[f]:.3g} m outside of "
            f"an edge next to it, allowed: {FLAT * extent(blocks):.3g} m; give it as several convex faces"
        )


def _require_closed(blocks: Blocks) -> None:
    area, normal, _ = face_areas_normals_centroids(blocks)
    vector = np.add.reduceat(area[:, None] * normal, blocks.block_face_start[:-1])
    surface = np.add.reduceat(area, blocks.block_face_start[:-1])
    open_by = np.linalg.norm(vector, axis=1) / surface
    if np.any(open_by > CLOSED):
        b = int(np.argmax(open_by))
        raise GeometryError(f"block {b} is not closed: a face is missing or looks inward")
    volume = volumes(blocks)
    if np.any(volume <= 0):
        b = int(np.argmin(volume))
        raise GeometryError(f"block {b} has a volume of {volume[b]:.3g} m3: its faces look inward")
