"""Tets inside blocks by gmsh, matching node to node across joints."""

import math
from itertools import pairwise
from typing import Any

import numpy as np

from geometry.blocks import Blocks, GeometryError, Joints, TetMesh
from geometry.checks import require_lengths
from geometry.meshes.gmsh_session import gmsh_model
from geometry.meshes.mesh_joints import PatchTriangles, mesh_joints
from geometry.meshes.skeleton import Imprint, imprint

OPTIONS = {
    "Mesh.RandomSeed": 1,
    "Mesh.Algorithm": 6,
    "Mesh.Algorithm3D": 10,  # HXT: the default leaves flat slivers in thin walls, worst radius ratio 0.000 against 0.3
    "Mesh.ElementOrder": 1,
    "Mesh.MeshSizeMax": 1.0,
}
TRIANGLE, TET = 2, 4


def mesh_blocks(blocks: Blocks, meshed: np.ndarray, size: float, joints: Joints) -> tuple[TetMesh, Joints]:
    """Tets of about the given edge length (m) in the meshed blocks (B,), and the joints with points at their nodes.

    A joint polygon between two meshed blocks has one surface mesh for both, so their nodes coincide there. Each of its
    triangles gives a third of its area to each of its corners. Polygons with no meshed side keep their points.
    Raises GeometryError if gmsh cannot be loaded or cannot mesh a block.
    """
    require_lengths("mesh", {"size": size})
    meshed = np.asarray(meshed, dtype=bool)
    if not meshed.any():
        return _no_tets(blocks.count), joints
    skeleton = imprint(blocks, meshed, joints)
    scale = 2.0 ** round(math.log2(size))  # a power of two: scaling to the mesh size and back changes no digit
    with gmsh_model(OPTIONS) as gmsh:
        volumes = _build(gmsh, skeleton, scale, size / scale)
        name_groups(gmsh, blocks, joints, skeleton, volumes)
        _generate(gmsh, volumes)
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
        nodes = np.empty((int(tags.max()) + 1, 3))
        nodes[tags.astype(np.int64)] = coordinates.reshape(-1, 3) * scale
        tets = {block: _elements(gmsh, 3, tag, TET) for block, tag in volumes.items()}
        triangles = {
            int(patch): _elements(gmsh, 2, int(skeleton.patch_surface[patch]) + 1, TRIANGLE)
            for patch in np.flatnonzero(skeleton.patch_surface >= 0)
        }
    mesh, block_tags = _assemble(blocks.count, nodes, tets)
    return mesh, mesh_joints(joints, PatchTriangles(nodes, triangles, block_tags))


def _build(gmsh: Any, skeleton: Imprint, scale: float, size: float) -> dict[int, int]:
    """The skeleton as a gmsh model, in units of scale; the volume's tag for each block. Surface s has tag s + 1."""
    geo = gmsh.model.geo
    for v, point in enumerate(skeleton.vertices / scale):
        geo.addPoint(*point, size, v + 1)
    lines: dict[tuple[int, int], int] = {}
    loops = skeleton.loops.lists()
    for s, (first, last) in enumerate(pairwise(skeleton.surface_start.tolist())):
        loop_tags = []
        for loop in loops[first:last]:
            curves = []
            for start, end in zip(loop, loop[1:] + loop[:1], strict=True):
                key = (min(start, end), max(start, end))
                if key not in lines:
                    lines[key] = geo.addLine(key[0] + 1, key[1] + 1)
                curves.append(lines[key] if start < end else -lines[key])
            loop_tags.append(geo.addCurveLoop(curves))
        geo.addPlaneSurface(loop_tags, s + 1)
    volumes = {}
    for block, surfaces in enumerate(skeleton.block_surfaces.lists()):
        if surfaces:
            volumes[block] = geo.addVolume([geo.addSurfaceLoop([s + 1 for s in surfaces])])
    geo.synchronize()
    return volumes


def name_groups(gmsh: Any, blocks: Blocks, joints: Joints, skeleton: Imprint, volumes: dict[int, int]) -> None:
    """Physical groups: the volumes of each group of blocks by its name, joint surfaces as "joint units mortar"."""
    for number, name in enumerate(blocks.groups):
        tags = [tag for block, tag in volumes.items() if blocks.group[block] == number]
        if tags:
            gmsh.model.addPhysicalGroup(3, tags, name=name)
    first = np.searchsorted(joints.patch, np.arange(len(joints.patch_start) - 1))
    between: dict[str, list[int]] = {}
    for patch in np.flatnonzero(skeleton.patch_surface >= 0).tolist():
        sides = sorted({int(blocks.group[side[first[patch]]]) for side in (joints.block_a, joints.block_b)})
        name = " ".join(["joint", *(blocks.groups[g] for g in sides)])
        between.setdefault(name, []).append(int(skeleton.patch_surface[patch]) + 1)
    for name, tags in between.items():
        gmsh.model.addPhysicalGroup(2, tags, name=name)


def _generate(gmsh: Any, volumes: dict[int, int]) -> None:
    try:
        gmsh.model.mesh.generate(3)
    except Exception as error:  # gmsh raises bare Exception
        raise GeometryError(f"gmsh could not mesh the blocks: {error}; try another mesh size") from error
    for block, tag in volumes.items():
        if len(gmsh.model.mesh.getElements(3, tag)[0]) == 0:
            raise GeometryError(f"gmsh left block {block} without tets; try another mesh size")


def _elements(gmsh: Any, dimension: int, tag: int, kind: int) -> np.ndarray:
    """Node tags (., 3) or (., 4) of the triangles or tets of one surface or volume."""
    return gmsh.model.mesh.getElementsByType(kind, tag)[1].astype(np.int64).reshape(-1, dimension + 1)


def _no_tets(count: int) -> TetMesh:
    empty = np.zeros(count + 1, dtype=np.int64)
    return TetMesh(np.zeros((0, 3)), empty, np.zeros((0, 4), dtype=np.int64), empty)


def _assemble(count: int, nodes: np.ndarray, tets: dict[int, np.ndarray]) -> tuple[TetMesh, dict[int, np.ndarray]]:
    """Nodes renumbered block by block; the gmsh tags of each block's nodes, rising, in that order."""
    node_count, tet_count = np.zeros(count, dtype=np.int64), np.zeros(count, dtype=np.int64)
    block_tags, numbered, start = {}, [], 0
    for block, corners in tets.items():
        block_tags[block], local = np.unique(corners, return_inverse=True)
        numbered.append(local.reshape(-1, 4) + start)
        node_count[block], tet_count[block] = len(block_tags[block]), len(corners)
        start += len(block_tags[block])
    points = nodes[np.concatenate(list(block_tags.values()))]
    tet = np.concatenate(numbered)
    edge = points[tet[:, 1:]] - points[tet[:, :1]]
    turned = np.einsum("ti,ti->t", edge[:, 0], np.cross(edge[:, 1], edge[:, 2])) < 0
    tet[turned] = tet[turned][:, [1, 0, 2, 3]]
    starts = [np.concatenate([[0], np.cumsum(number)]) for number in (node_count, tet_count)]
    return TetMesh(points, starts[0], tet, starts[1]), block_tags
