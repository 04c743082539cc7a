"""Tet meshes put together and taken apart block by block."""

import numpy as np

from geometry.blocks import TetMesh


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
