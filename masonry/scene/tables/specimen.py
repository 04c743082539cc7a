"""Tables of a scene for its specimen: kind and size. Lengths in m, areas in m2."""

from collections import Counter
from pathlib import Path
from typing import Annotated, Literal, get_args

from pydantic import AfterValidator, Field, model_validator

from masonry.scene.tables.cells import CellsTable, exclude
from masonry.scene.tables.specimens.common import Divided, SpecimenTable
from masonry.scene.tables.specimens.structures import (
    ArchSpec,
    BridgeSpec,
    ColumnSpec,
    DomeSpec,
    MultiLeafSpec,
    TowerSpec,
    VaultSpec,
    WallSpec,
)
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


class CoupletSpec(_Stack):
    """Two units."""

    kind: Literal["couplet"]


class PrismSpec(_Stack):
    """Any number of units."""

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


class WalletteSpec(_Wall):
    """A plane wall between plates, on a base and under a beam; divisions (nx, nz) of a whole unit."""

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

    kind: Literal["boxes"]
    box: Annotated[tuple[Box, ...], Field(min_length=1)]
    section: Area

    @model_validator(mode="after")
    def _names_differ(self) -> "BoxesSpec":
        name, times = Counter(box.name for box in self.box).most_common(1)[0]
        if times > 1:
            raise KeyedError("box", f"{times} boxes are named '{name}'; each needs a name of its own")
        return self


def _absolute(path: str) -> str:
    """Where a path leads from here, so that a scene which is written elsewhere still finds its blocks."""
    return str(Path(path).absolute())


class FileSpec(SpecimenTable, Divided):
    """Blocks from a file that `masonry import` or `masonry.write_blocks` wrote, or such a file within the scene, as
    text; the units among them may be divided."""

    kind: Literal["file"]
    path: Annotated[str, Field(min_length=1), AfterValidator(_absolute)] | None = None
    content: Annotated[str, Field(min_length=1)] | None = None

    @model_validator(mode="after")
    def _names_its_blocks_once(self) -> "FileSpec":
        if self.path is None and self.content is None:
            raise KeyedError(
                "path", "missing; the file of blocks, which `masonry import` or masonry.write_blocks wrote"
            )
        if self.path is not None and self.content is not None:
            raise KeyedError("content", "path and content exclude each other; keep one of them")
        return self


Specimen = Annotated[
    CoupletSpec
    | PrismSpec
    | WalletteSpec
    | BendingSpec
    | ArchSpec
    | BridgeSpec
    | VaultSpec
    | DomeSpec
    | ColumnSpec
    | TowerSpec
    | WallSpec
    | MultiLeafSpec
    | BoxesSpec
    | FileSpec,
    Field(discriminator="kind"),
]


def kinds() -> list[str]:
    """The words that `kind` may be."""
    union = get_args(Specimen)[0]
    return [get_args(table.model_fields["kind"].annotation)[0] for table in get_args(union)]
