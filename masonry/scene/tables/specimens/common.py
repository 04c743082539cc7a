"""Common keys of the tables of all specimens, and the division of their units."""

from typing import Any, Literal

from pydantic import model_validator

from masonry.scene.tables.cells import CellsTable, exclude
from masonry.scene.tables.point_counts import (
    PatchPointsPerEdge,
    PerAxis,
    PointsPerEdge,
    PointsPerFace,
    fewest,
    one_density,
)
from masonry.scene.tables.types import Area, Count, KeyedError, Length, Position, SetName, SignedAngle, Table


class TurnTable(Table):
    """The whole specimen turned by an angle (rad, right-hand rule) about an axis through a point (m)."""

    about: Literal["x", "y", "z"]
    angle: SignedAngle
    through: tuple[Position, Position, Position] = (0.0, 0.0, 0.0)


class SlabTable(Table):
    """A box besides the blocks of a specimen: a floor that rests on walls, a lintel, a wall plate."""

    name: SetName
    origin: tuple[Position, Position, Position]
    size: tuple[Length, Length, Length]
    group: SetName = "slabs"


class SpecimenTable(Table):
    """Keys of all specimens; `section`, if given, takes the place of the specimen's own."""

    kind: str
    section: Area | None = None
    contact_points: Literal["gauss", "vertex"] | None = None
    points_per_edge: PointsPerEdge = PerAxis()
    points_per_face: PointsPerFace | None = None
    contact_spacing: Length | None = None
    patch_points: Literal["corners", "spread"] | None = None
    patch_points_per_edge: PatchPointsPerEdge | None = None
    mesh: Literal["gmsh", "fan"] = "gmsh"
    mesh_size: Length | None = None
    turned: TurnTable | None = None
    slab: tuple[SlabTable, ...] = ()

    @model_validator(mode="before")
    @classmethod
    def _one_density(cls, data: Any) -> Any:
        return one_density(data)

    @property
    def chooses_patch_points(self) -> bool:
        """Whether a scene says where points of patches lie."""
        return self.patch_points is not None or self.patch_points_per_edge is not None

    @model_validator(mode="after")
    def _has_one_kind_of_patch_points(self) -> "SpecimenTable":
        if self.patch_points is not None and self.patch_points_per_edge is not None:
            raise KeyedError(
                "patch_points_per_edge", "patch_points and patch_points_per_edge exclude each other; keep one of them"
            )
        return self

    @model_validator(mode="after")
    def _has_corners(self) -> "SpecimenTable":
        if self.contact_points == "vertex":
            for key, number in (("points_per_edge", 2), ("points_per_face", 4)):
                points = getattr(self, key)
                if points is not None and fewest(points) < number:
                    raise KeyedError(key, f"must be {number} or more with contact_points = 'vertex'")
        return self


class Divided(Table):
    """A grid of blocks (nx, ny, nz), or cells."""

    divisions: tuple[Count, Count, Count] = (1, 1, 1)
    cells: CellsTable | None = None

    @property
    def is_divided(self) -> bool:
        """Whether units are cut up."""
        return self.cells is not None or any(n > 1 for n in self.divisions)

    @model_validator(mode="after")
    def _is_divided_once(self) -> "Divided":
        exclude(self)
        return self
