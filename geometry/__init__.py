"""What stands where: blocks, meshes and joints as plain arrays. Knows no mechanics; imports no `masonry`."""

from geometry.blocks import Blocks, GeometryError, Joints, Specimen
from geometry.polyhedra.construct import concatenate, extrude, from_boxes, from_faces

__all__ = [
    "Blocks",
    "GeometryError",
    "Joints",
    "Specimen",
    "concatenate",
    "extrude",
    "from_boxes",
    "from_faces",
]
