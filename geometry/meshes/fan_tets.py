"""Blocks filled with tets one by one, for other programs: nothing is moved, and neighbours need not match."""

import numpy as np

from geometry.blocks import Blocks, TetMesh
from geometry.joints.find import find_joints
from geometry.polyhedra.indexing import ranges
from geometry.polyhedra.measures import centroids, face_areas_normals_centroids, volumes

NOTHING = 1e-12
"""Of a block's volume: tets smaller than this are left out."""


def fan_tets(blocks: Blocks, which: np.ndarray) -> TetMesh:
    """Tets in the blocks which (B,): from the centroid of the block to the centroid of a face and an edge of it.

    Triangles have no centre of their own. Blocks that are not seen whole from their centroid are meshed by gmsh, with
    edges as long as the cube root of their volume. Raises GeometryError where gmsh does.
    """
    volume = volumes(blocks)
    fans = _fans(blocks, np.asarray(which, dtype=bool))
    owner = np.repeat(np.arange(blocks.count), np.diff(fans.tet_start))
    fraction = np.linalg.det(fans.nodes[fans.tets[:, 1:]] - fans.nodes[fans.tets[:, :1]]) / 6 / volume[owner]
    failed = np.unique(owner[fraction < -NOTHING])
    is_solid = fraction > NOTHING
    fans = TetMesh(
        fans.nodes, fans.node_start, fans.tets[is_solid], np.searchsorted(owner[is_solid], np.arange(blocks.count + 1))
    )
    if len(failed) == 0:
        return fans
    from geometry.meshes.tetrahedralise import mesh_blocks

    joints = find_joints(blocks)
    parts = {b: (fans, b) for b in np.flatnonzero(which).tolist()}
    for b in failed.tolist():
        alone = np.arange(blocks.count) == b
        parts[b] = mesh_blocks(blocks, alone, float(np.cbrt(volume[b])), joints)[0], b
    return gathered(blocks.count, parts)


def _fans(blocks: Blocks, mask: np.ndarray) -> TetMesh:
    faces = np.flatnonzero(mask[blocks.face_block()])
    size = np.diff(blocks.face_start)[faces]
    owner = blocks.face_block()[faces]
    middle = face_areas_normals_centroids(blocks)[2][faces]
    # points of all tets: corners of the faces, then face centroids, then block centroids; unique within a block
    of, corner = ranges(blocks.face_start[faces], size)
    place = np.concatenate([blocks.points[blocks.face_points[corner]], middle, centroids(blocks)])
    block = np.concatenate([owner[of], owner, np.arange(blocks.count)])
    _, first, number = np.unique(np.column_stack([block, place]), axis=0, return_index=True, return_inverse=True)
    number = number.ravel()
    here = np.arange(len(of))
    start = np.cumsum(size) - size
    after = start[of] + (here - start[of] + 1) % size[of]
    fanned = size[of] > 3
    apex = np.where(fanned, len(of) + of, start[of])
    is_fan = fanned | (here == start[of] + 1)
    centre = len(of) + len(faces) + owner[of]
    tets = number[np.stack([centre, apex, here, after], axis=1)[is_fan]]
    used, tets = np.unique(tets, return_inverse=True)
    nodes, node_block = place[first][used], block[first][used]
    every = np.arange(blocks.count + 1)
    return TetMesh(
        nodes, np.searchsorted(node_block, every), tets.reshape(-1, 4), np.searchsorted(owner[of][is_fan], every)
    )


def gathered(count: int, parts: dict[int, tuple[TetMesh, int]]) -> TetMesh:
    """One mesh for `count` blocks: in block b the tets that parts[b] = (mesh, block) has there, in others none."""
    nodes, tets = [np.zeros((0, 3))], [np.zeros((0, 4), dtype=np.int64)]
    node_count, tet_count = np.zeros(count, dtype=np.int64), np.zeros(count, dtype=np.int64)
    before = 0
    for b in sorted(parts):
        mesh, k = parts[b]
        first, last = mesh.node_start[k], mesh.node_start[k + 1]
        corner = mesh.tets[mesh.tet_start[k] : mesh.tet_start[k + 1]]
        nodes.append(mesh.nodes[first:last])
        tets.append(corner - first + before)
        node_count[b], tet_count[b] = last - first, len(corner)
        before += int(last - first)
    starts = [np.concatenate([[0], np.cumsum(number)]) for number in (node_count, tet_count)]
    return TetMesh(np.concatenate(nodes), starts[0], np.concatenate(tets), starts[1])


def within(mesh: TetMesh, which: np.ndarray) -> TetMesh:
    """The tets of some blocks (B,) alone."""
    return gathered(len(which), {b: (mesh, b) for b in np.flatnonzero(which).tolist()})
