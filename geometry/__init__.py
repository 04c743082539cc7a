"""What stands where: blocks, meshes and joints as plain arrays. Knows no mechanics; imports no `masonry`.

Specimens of other packages import from here.
"""

from geometry.blocks import Blocks, GeometryError, Joints, Specimen
from geometry.polyhedra.construct import concatenate, extrude, from_boxes, from_faces
from geometry.specimens.kinds import Angle, Area, Count, Length, Number, Position

__all__ = [
    "Angle",
    "Area",
    "Blocks",
    "Count",
    "GeometryError",
    "Joints",
    "Length",
    "Number",
    "Position",
    "Specimen",
    "concatenate",
    "extrude",
    "from_boxes",
    "from_faces",
]
