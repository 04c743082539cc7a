"""The faces of a CAD model as triangles: exact where faces are flat and edges straight, else within a chord height."""

from typing import Any

import numpy as np

from geometry.blocks import GeometryError
from geometry.polyhedra.weld import weld

TRIANGLE = 2
SAME = 1e-6  # mm, corners of neighbouring faces nearer than this are one
LARGEST_ANGLE = 1.0  # rad between neighbouring facets
MOST_TRIANGLES = 5_000_000


def facet_options(chord: float) -> dict[str, float]:
    """Options under which the kernel divides faces into triangles off the faces by no more than chord (mm)."""
    return {
        "Mesh.StlLinearDeflection": chord,
        "Mesh.StlLinearDeflectionRelative": 0.0,
        "Mesh.StlAngularDeflection": LARGEST_ANGLE,
    }


def triangulate(gmsh: Any, extent: float) -> tuple[np.ndarray, dict[int, np.ndarray]]:
    """Corners (P, 3) mm, each once, and for each face of the model its triangles (T, 3); extent mm, of the model.

    This is the kernel's own triangulation for pictures. gmsh's mesher leaves the surface where triangles are long.
    """
    try:
        gmsh.model.mesh.importStl()
    except Exception as error:  # gmsh raises bare Exception
        raise GeometryError(f"the faces of the solids cannot be divided into triangles: {str(error)[:200]}") from error
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    if len(tags) == 0 or len(tags) > MOST_TRIANGLES:
        raise GeometryError(f"the faces of the solids make {len(tags)} corners of facets; take a larger --facet")
    if not np.isfinite(coordinates).all():
        raise GeometryError("the file holds corners at infinity; is it damaged?")
    points = coordinates.reshape(-1, 3)
    kept, number = weld(points, max(SAME, 1e-9 * extent))
    of_tag = np.zeros(int(tags.max()) + 1, dtype=np.int64)
    of_tag[tags.astype(np.int64)] = number
    triangles = {}
    for _, surface in gmsh.model.getEntities(2):
        found = of_tag[gmsh.model.mesh.getElementsByType(TRIANGLE, surface)[1].astype(np.int64).reshape(-1, 3)]
        flat = (found[:, 0] == found[:, 1]) | (found[:, 1] == found[:, 2]) | (found[:, 2] == found[:, 0])
        triangles[surface] = found[~flat]
    return points[kept], triangles
