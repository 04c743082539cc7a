"""From a scene's words to the places that its gauges look at: selectors, points and lines through the specimen."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import Joints, Specimen, TetMesh
from geometry.joints.boundary import surface_nodes
from geometry.polyhedra.line_cuts import TOUCH, LinePieces, pieces, planes_of
from geometry.polyhedra.measures import extent, face_areas_normals_centroids
from masonry.assembly.conditions import select
from masonry.errors import SceneError
from masonry.model.gauges import Gauge, Place, gauge
from masonry.model.layout import Layout, tet_gradients, tet_volumes
from masonry.scene import Scene
from masonry.scene.tables.gauge import Coordinates


def gauges_of(scene: Scene, specimen: Specimen, joints: Joints, layout: Layout) -> tuple[Gauge, ...]:
    """The gauges of a scene; raises SceneError for a place where there is nothing."""
    gauges = []
    for k, table in enumerate(scene.gauge):
        at = _place(specimen, joints, layout, table.at, f"gauge.{k}.at")
        base = table.relative_to
        still = None if base is None else _place(specimen, joints, layout, base, f"gauge.{k}.relative_to")
        axis = "xyz".index(table.direction[-1])
        gauges.append(gauge(table.name, layout, at, still, axis, table.sign, table.quantity))
    return tuple(gauges)


def _place(specimen: Specimen, joints: Joints, layout: Layout, where: str | Coordinates, key: str) -> Place:
    if isinstance(where, Coordinates):
        return _on_line(specimen, layout, where, key)
    chosen, faces = select(specimen, joints, where, key)
    blocks = specimen.blocks
    if faces is None:
        point, weight, owner = layout.centroid[chosen], layout.volume[chosen], chosen
    else:
        area, _, centre = face_areas_normals_centroids(blocks)
        point, weight, owner = centre[faces], area[faces], blocks.face_block()[faces]
    meshed = layout.meshed[owner]
    node, node_weight = np.zeros(0, dtype=np.int64), np.zeros(0)
    if layout.mesh is not None and meshed.any():
        if faces is None:
            node, node_weight = _nodes_of(layout.mesh, owner[meshed])
        else:
            node, node_weight = surface_nodes(layout.mesh, blocks, faces[meshed])
    whole = weight[~meshed].sum() + node_weight.sum()
    return Place(owner[~meshed], point[~meshed], weight[~meshed] / whole, node, node_weight / whole)


def _nodes_of(mesh: TetMesh, chosen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Nodes of meshed blocks, and the volume (m3) of each: a quarter of its tets."""
    own = np.repeat(np.isin(np.arange(len(mesh.tet_start) - 1), chosen), np.diff(mesh.tet_start))
    volume = np.where(own, tet_volumes(mesh), 0.0) / 4
    weight = np.bincount(mesh.tets.ravel(), np.repeat(volume, 4), minlength=len(mesh.nodes))
    node = np.flatnonzero(weight > 0.0)
    return node, weight[node]


def _on_line(specimen: Specimen, layout: Layout, where: Coordinates, key: str) -> Place:
    """The mean over what blocks hold of a line, or at a point; half of each where two blocks meet there."""
    blocks, mesh = specimen.blocks, layout.mesh
    corners = blocks.points[blocks.face_points]
    low, high = corners.min(axis=0), corners.max(axis=0)
    place = [
        float(0.5 * (low + high)[i]) if value == "middle" else None if value is None else float(value)
        for i, value in enumerate(where)
    ]
    width = TOUCH * extent(blocks)
    cut = pieces(*planes_of(blocks), place, width)
    solid = ~layout.meshed[cut.body]
    if len(cut.body) == 0:
        raise SceneError(f"{key}: no block lies at {_said(place)}; the specimen reaches over {_said(low, high)}")
    node, node_weight = np.zeros(0, dtype=np.int64), np.zeros(0)
    if mesh is not None and not solid.all():
        node, node_weight = _between_nodes(mesh, place, width)
        node_weight = node_weight * cut.fraction[~solid].sum()
    return Place(cut.body[solid], cut.middle[solid], cut.fraction[solid], node, node_weight)


def _said(*places: Sequence[float | None]) -> str:
    """Coordinates in words: "x = 1 mm", or "x 1 to 2 mm" from the first place to the second."""
    word = " " if len(places) > 1 else " = "
    numbers = [[f"{c * 1e3:.6g}" for c in ends if c is not None] for ends in zip(*places, strict=True)]
    return ", ".join(f"{axis}{word}{' to '.join(text)} mm" for axis, text in zip("xyz", numbers, strict=True) if text)


def _between_nodes(mesh: TetMesh, place: list[float | None], width: float) -> tuple[np.ndarray, np.ndarray]:
    """The nodes of the tets that a line or a point lies in, and the share of each; adds up to 1."""
    gradient, corner = tet_gradients(mesh), mesh.nodes[mesh.tets]
    steep = np.linalg.norm(gradient, axis=2)
    normal = -gradient / steep[:, :, None]
    level = np.einsum("tki,tki->tk", normal, np.roll(corner, 1, axis=1))
    cut: LinePieces = pieces(normal, level, place, width)
    arm = cut.middle[:, None] - corner[cut.body]
    weight = 1.0 + np.einsum("nki,nki->nk", gradient[cut.body], arm)
    return mesh.tets[cut.body].ravel(), (cut.fraction[:, None] * weight).ravel()
