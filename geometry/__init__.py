"""Geometry: blocks, meshes and joints as plain arrays. Knows no mechanics; imports no `masonry`."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from geometry.blocks import Blocks, Joints, Specimen
    from geometry.errors import GeometryError
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


def __getattr__(name: str) -> Any:
    """Looked up when it is asked for: it brings numpy with it, which what asks of the system alone does not need."""
    if name not in __all__:
        raise AttributeError(f"module 'geometry' has no attribute '{name}'")
    if name == "GeometryError":
        module = "geometry.errors"
    else:
        module = "geometry.blocks" if name[0].isupper() else "geometry.polyhedra.construct"
    return getattr(import_module(module), name)
