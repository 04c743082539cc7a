"""Specimens made by hand: any polyhedra, any mixture of kinematics, turned, mirrored, skewed and renumbered."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from geometry.blocks import Blocks, Joints, TetMesh
from geometry.joints import find_joints
from geometry.mesher import mesh_blocks
from geometry.shapes import from_boxes, from_faces
from masonry.bodies import KINDS
from masonry.model import sort_by_group


@dataclass(frozen=True)
class Setup:
    """Blocks, how each moves (an index into KINDS), their contacts and tets."""

    blocks: Blocks
    kind: np.ndarray
    joints: Joints
    mesh: TetMesh | None


def setup(blocks: Blocks, kinds: Sequence[str], mesh_size: float = 0.1, **points) -> Setup:
    """Find the contacts and mesh what is to be meshed; every block is a unit of its own in one group of contacts."""
    count = blocks.count
    blocks = replace(blocks, unit=np.arange(count), group=np.zeros(count, dtype=np.int64), groups=("units",))
    kind = np.array([KINDS.index(k) for k in kinds])
    joints = find_joints(blocks, **points)
    mesh = None
    if "tets" in kinds:
        mesh, joints = mesh_blocks(blocks, kind == KINDS.index("tets"), mesh_size, joints)
    return Setup(blocks, kind, sort_by_group(blocks, joints)[2], mesh)


def boxes(corners: Sequence[tuple]) -> Blocks:
    """Boxes from pairs (low, high)."""
    low, high = (np.array([pair[side] for pair in corners], dtype=float) for side in (0, 1))
    count = len(low)
    return from_boxes(low, high, np.arange(count), np.zeros(count), ("units",))


def stack(heights: Sequence[float], size: tuple[float, float] = (0.2, 0.1)) -> Blocks:
    """Boxes one above the other."""
    level = np.concatenate([[0.0], np.cumsum(heights)])
    return boxes([((0, 0, a), (*size, b)) for a, b in zip(level[:-1], level[1:], strict=True)])


def wall(columns: int = 2, courses: int = 2, size: tuple[float, float, float] = (0.2, 0.1, 0.08)) -> Blocks:
    """Running bond: every second course is shifted by half a unit."""
    corners = []
    for course in range(courses):
        for k in range(columns):
            low = np.array([(k + 0.5 * (course % 2)) * size[0], 0.0, course * size[2]])
            corners.append((low, low + size))
    return boxes(corners)


def faces_of(blocks: Blocks, b: int) -> list[np.ndarray]:
    """Corners (n, 3) m of each face of block b."""
    return [blocks.face(f) for f in blocks.faces_of(b)]


def skewed(blocks: Blocks, shear: np.ndarray) -> Blocks:
    """Every point x goes to shear @ x: boxes become parallelepipeds."""
    count = blocks.count
    moved = [[face @ np.asarray(shear).T for face in faces_of(blocks, b)] for b in range(count)]
    return from_faces(moved, range(count), [0] * count, ("units",))


def mapped(s: Setup, turn: np.ndarray, shift=(0.0, 0.0, 0.0)) -> Setup:
    """The same set-up turned or mirrored (orthogonal `turn`) and shifted; tets and contact points go with it."""
    mirrored = np.linalg.det(turn) < 0
    polyhedra = [
        [(f[::-1] if mirrored else f) @ turn.T + shift for f in faces_of(s.blocks, b)] for b in range(s.blocks.count)
    ]
    blocks = from_faces(polyhedra, s.blocks.unit.tolist(), s.blocks.group.tolist(), s.blocks.groups)
    mesh = s.mesh
    if mesh is not None:
        tets = mesh.tets[:, [1, 0, 2, 3]] if mirrored else mesh.tets
        mesh = replace(mesh, nodes=mesh.nodes @ turn.T + shift, tets=tets)
    joints = replace(
        s.joints,
        point=s.joints.point @ turn.T + shift,
        normal=s.joints.normal @ turn.T,
        patch_points=s.joints.patch_points @ turn.T + shift,
    )
    return Setup(blocks, s.kind, joints, mesh)


def renumbered(s: Setup, order: np.ndarray) -> tuple[Setup, np.ndarray]:
    """The same set-up with its blocks in another order, and the old number of each tet node."""
    number = np.argsort(order)
    blocks = from_faces([faces_of(s.blocks, b) for b in order], range(len(order)), [0] * len(order), ("units",))
    mesh, nodes = s.mesh, np.zeros(0, dtype=np.int64)
    new_node = np.zeros(1, dtype=np.int64)
    if mesh is not None:
        nodes = np.concatenate([np.arange(mesh.node_start[b], mesh.node_start[b + 1]) for b in order])
        new_node = np.argsort(nodes)
        tets = np.concatenate([mesh.tets[mesh.tet_start[b] : mesh.tet_start[b + 1]] for b in order])
        starts = [np.concatenate([[0], np.cumsum(np.diff(s)[order])]) for s in (mesh.node_start, mesh.tet_start)]
        mesh = TetMesh(mesh.nodes[nodes], starts[0], new_node[tets], starts[1])
    a, b = number[s.joints.block_a], number[s.joints.block_b]
    node_a, node_b = (np.where(n >= 0, new_node[n], -1) for n in (s.joints.node_a, s.joints.node_b))
    swap = a > b
    joints = replace(
        s.joints,
        block_a=np.where(swap, b, a),
        block_b=np.where(swap, a, b),
        node_a=np.where(swap, node_b, node_a),
        node_b=np.where(swap, node_a, node_b),
        normal=np.where(swap[:, None], -s.joints.normal, s.joints.normal),
    )
    return Setup(blocks, s.kind[order], joints, mesh), nodes
