"""Common keys of the tables of all specimens, what each kind answers for itself, and the division of its units."""

from collections.abc import Callable
from inspect import signature
from math import prod
from typing import Any, ClassVar, Literal

from pydantic import model_validator

from geometry.blocks import Blocks, Specimen, TetMesh
from masonry.scene.tables.cells import CellsTable, exclude, filling_of
from masonry.scene.tables.point_counts import (
    PatchPointsPerEdge,
    PerAxis,
    PointsPerEdge,
    PointsPerFace,
    fewest,
    one_density,
)
from masonry.scene.tables.types import (
    Area,
    Count,
    KeyedError,
    Length,
    Position,
    SetName,
    SignedAngle,
    Table,
    refuse_both,
)


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
    """Keys of all specimens; `section`, if given, takes the place of the specimen's own.

    The table of a kind answers for it. `kind` is also the shape of what `builder` makes, and the keys of the table are
    the parameters of that function.
    """

    builder: ClassVar[Callable[..., Specimen]]
    seen_along_y: ClassVar[bool] = False
    """Whether its front is the plane x-z, however deep it is."""
    usual_view: ClassVar[Literal["front", "iso"]] = "front"
    """The view of a picture in which nothing pushes or leans."""
    placed_by_hand: ClassVar[bool] = False
    """Whether its blocks are numbered in an order of the user's."""
    made_elsewhere: ClassVar[bool] = False
    """Whether its blocks are of any shape, were not looked at for overlaps, and may hold tets."""

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

    def build(self) -> Specimen:
        """The blocks with named sets; raises GeometryError for what cannot be built."""
        builder = type(self).builder
        return builder(**{name: self.argument(name) for name in signature(builder).parameters})

    def argument(self, name: str) -> Any:
        """The argument of a parameter of the builder."""
        return getattr(self, name)

    @property
    def amount(self) -> tuple[float, float, float]:
        """About how many units, their volume (m3), and how deep they are along y (m)."""
        raise NotImplementedError

    @property
    def blocks_and_volume(self) -> tuple[float, float]:
        """About how many blocks, and the volume (m3) of the units."""
        units, volume, depth = self.amount
        return count_of_parts(self, units, volume, depth), volume

    @property
    def key_of_amount(self) -> str:
        """The key to blame for too many blocks."""
        return "specimen.cells" if self.has_cells else "specimen.divisions"

    @property
    def course_height(self) -> float | None:
        """m, of a unit and a bed joint; None where there are no courses of units."""
        height = getattr(self, "unit_height", None)
        return None if height is None else height + getattr(self, "joint_thickness", 0.0)

    @property
    def has_cells(self) -> bool:
        """Whether units are divided into cells."""
        return getattr(self, "cells", None) is not None

    @property
    def is_divided(self) -> bool:
        """Whether units are cut up."""
        return self.has_cells or any(n > 1 for n in getattr(self, "divisions", ()))

    @property
    def all_cells(self) -> tuple[CellsTable, ...]:
        """The tables of cells of all its parts that have one."""
        return tuple(cells for cells in (getattr(self, "cells", None),) if cells is not None)

    @property
    def bridges_gaps(self) -> bool:
        """Whether its joints are stated, between blocks that only nearly meet."""
        return False

    @property
    def own_mesh(self) -> tuple[TetMesh, Blocks] | None:
        """The tets that its blocks brought with them, and these blocks; None without."""
        return None

    @property
    def chooses_patch_points(self) -> bool:
        """Whether a scene says where points of patches lie."""
        return self.patch_points is not None or self.patch_points_per_edge is not None

    @model_validator(mode="after")
    def _has_one_kind_of_patch_points(self) -> "SpecimenTable":
        refuse_both(self, "patch_points", "patch_points_per_edge")
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

    @model_validator(mode="after")
    def _is_divided_once(self) -> "Divided":
        exclude(self)
        return self


class Structure(SpecimenTable, Divided):
    """A structure that people build, whose units may be divided."""

    def build(self) -> Specimen:
        """The blocks with named sets, the units divided; raises GeometryError for what cannot be built."""
        return divided_as_asked(super().build(), self)

    @property
    def key_of_amount(self) -> str:
        """The key to blame for too many blocks."""
        return super().key_of_amount if self.is_divided else "specimen"


def divided_as_asked(specimen: Specimen, table: Any) -> Specimen:
    """A specimen with its units divided as its table asks."""
    if not table.is_divided:
        return specimen
    from geometry.specimens.divided import divided

    return divided(specimen, filling_of(table))


def count_of_parts(table: Any, units: float, volume: float, depth: float) -> float:
    """About how many blocks a grid or cells in so many units make, of this volume (m3) in all and depth (m)."""
    cells = table.cells
    if cells is None:
        return float(units * prod(table.divisions))
    if cells.size is not None:
        one = cells.size**3 if cells.form == "space" else cells.size**2 * depth
        return volume / one if one > 0 else float("inf")
    return float(cells.total or units * cells.per_unit)
