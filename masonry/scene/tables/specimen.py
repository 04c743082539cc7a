"""Tables of a scene for its specimen: kind and size. Lengths in m, areas in m2."""

from collections import Counter
from math import prod
from typing import Annotated, Any, Literal, get_args

from pydantic import Field, model_validator

from geometry.specimens.bending import bending
from geometry.specimens.boxes import boxes
from geometry.specimens.stacked import couplet, prism
from geometry.specimens.wallette import wallette
from masonry.scene.tables.cells import CellsTable, exclude, filling_of
from masonry.scene.tables.specimens.arches_and_domes import ArchOrDome
from masonry.scene.tables.specimens.blocks_file import FileSpec
from masonry.scene.tables.specimens.common import Divided, SpecimenTable, count_of_parts
from masonry.scene.tables.specimens.walls_and_columns import WallOrColumn
from masonry.scene.tables.types import Area, Count, Gap, Halves, KeyedError, Length, Number, Position, SetName, Table


class Mortar(Divided):
    """Layers of mortar made of blocks."""

    thickness: Length


class _Stack(SpecimenTable, Divided):
    """Units one above the other; length, width and height are those of one unit."""

    length: Length
    width: Length
    height: Length
    mortar: Mortar | None = None
    plates: Length | None = None

    def argument(self, name: str) -> Any:
        """The argument of a parameter of the builder."""
        if name == "divisions":
            return filling_of(self)
        if name == "mortar":
            return self.mortar and (self.mortar.thickness, filling_of(self.mortar))
        return super().argument(name)

    @property
    def course_height(self) -> float:
        """m, of a unit."""
        return self.height

    @property
    def amount(self) -> tuple[float, float, float]:
        """About how many units, their volume (m3), and how deep they are along y (m)."""
        units = getattr(self, "units", 2)
        return units, units * self.length * self.width * self.height, self.width

    @property
    def blocks_and_volume(self) -> tuple[float, float]:
        """About how many blocks, those of beds too, and the volume (m3) of the units."""
        blocks, volume = super().blocks_and_volume
        if self.mortar is None:
            return blocks, volume
        beds = self.amount[0] - 1
        of_beds = beds * self.length * self.width * self.mortar.thickness
        return blocks + count_of_parts(self.mortar, beds, of_beds, self.width), volume

    @property
    def all_cells(self) -> tuple[CellsTable, ...]:
        """The tables of cells of all its parts that have one."""
        beds = self.mortar.cells if self.mortar is not None else None
        return super().all_cells if beds is None else (*super().all_cells, beds)


class CoupletSpec(_Stack):
    """Two units."""

    builder = staticmethod(couplet)

    kind: Literal["couplet"]


class PrismSpec(_Stack):
    """Any number of units."""

    builder = staticmethod(prism)

    kind: Literal["prism"]
    units: Count = 3


class _Wall(SpecimenTable):
    """Courses of expanded units with zero-thickness joints."""

    courses: Count
    units_per_course: Halves = 2
    unit_length: Length
    unit_height: Length
    unit_width: Length | None = None
    thickness: Length
    joint_thickness: Gap = 0.0
    bond: Literal["running", "stack", "header", "english", "flemish"] = "running"

    def argument(self, name: str) -> Any:
        """The argument of a parameter of the builder."""
        return filling_of(self) if name == "divisions" else super().argument(name)

    @property
    def amount(self) -> tuple[float, float, float]:
        """About how many units, their volume (m3), and how deep they are along y (m)."""
        units = self.courses * self.units_per_course
        return units, units * self.unit_length * self.thickness * self.unit_height, self.thickness


class WalletteSpec(_Wall):
    """A plane wall between plates, on a base and under a beam; divisions (nx, nz) of a whole unit."""

    builder = staticmethod(wallette)

    kind: Literal["wallette"]
    divisions: tuple[Count, Count] = (1, 1)
    cells: CellsTable | None = None
    plates: Length | None = None
    base: Length | None = None
    beam: Length | None = None
    shoes: Length | None = None

    @model_validator(mode="after")
    def _is_divided_once(self) -> "WalletteSpec":
        exclude(self)
        return self


class BendingSpec(_Wall, Divided):
    """A wall between support rollers and load rollers."""

    builder = staticmethod(bending)

    kind: Literal["bending"]
    support_distance: Length = 0.025
    load_distance: Length | None = None
    roller_width: Length = 0.01
    bottom_plate: Length | None = None


class Box(Table):
    """A cuboid, divided into a regular grid of blocks."""

    name: SetName
    origin: tuple[Position, Position, Position]
    size: tuple[Length, Length, Length]
    group: SetName = "units"
    unit: Number = 0
    divisions: tuple[Count, Count, Count] = (1, 1, 1)


class BoxesSpec(SpecimenTable):
    """Boxes that the user places; `section` turns a force into the reported stress."""

    builder = staticmethod(boxes)
    placed_by_hand = True

    kind: Literal["boxes"]
    box: Annotated[tuple[Box, ...], Field(min_length=1)]
    section: Area

    def argument(self, name: str) -> Any:
        """The argument of a parameter of the builder."""
        if name != "box":
            return super().argument(name)
        return [(b.name, b.origin, b.size, b.group, b.unit, b.divisions) for b in self.box]

    @property
    def blocks_and_volume(self) -> tuple[float, float]:
        """About how many blocks, and the volume (m3) of the boxes."""
        return sum(prod(box.divisions) for box in self.box), sum(prod(box.size) for box in self.box)

    @model_validator(mode="after")
    def _names_differ(self) -> "BoxesSpec":
        name, times = Counter(box.name for box in self.box).most_common(1)[0]
        if times > 1:
            raise KeyedError("box", f"{times} boxes are named '{name}'; each needs a name of its own")
        return self


Specimen = Annotated[
    CoupletSpec | PrismSpec | WalletteSpec | BendingSpec | ArchOrDome | WallOrColumn | BoxesSpec | FileSpec,
    Field(discriminator="kind"),
]
TABLES: dict[str, type[SpecimenTable]] = {
    get_args(table.model_fields["kind"].annotation)[0]: table for table in get_args(get_args(Specimen)[0])
}
"""By the words that `kind` may be."""


def table_of(shape: str) -> type[SpecimenTable]:
    """The table of the kind that makes specimens of a shape; that of all kinds for shapes of other programs."""
    return TABLES.get(shape, SpecimenTable)
