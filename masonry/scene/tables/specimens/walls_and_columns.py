"""Tables of a scene for columns, towers and walls that people build. Lengths in m."""

from collections import Counter
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from geometry.structures.column import column
from geometry.structures.multi_leaf import multi_leaf
from geometry.structures.openings import Opening
from geometry.structures.tower import tower
from geometry.structures.wall import wall
from masonry.scene.tables.cells import CellsTable
from masonry.scene.tables.specimens.common import Structure
from masonry.scene.tables.types import Angle, Count, Gap, Given, KeyedError, Length, Sides, Table, UnitInterval


class ColumnSpec(Structure):
    """Drums one above the other, on a base and under a capital."""

    builder = staticmethod(column)

    kind: Literal["column"]
    diameter: Length
    height: Length
    drums: Count
    sides: Sides = 24
    top_diameter: Length | None = None
    base: Length | None = None
    capital: Length | None = None
    overhang: Gap = 0.0

    @property
    def amount(self) -> tuple[float, float, float]:
        """About how many units, their volume (m3), and how deep they are along y (m)."""
        return self.drums + 1, 0.8 * self.diameter**2 * self.height, self.diameter


class TowerSpec(Structure):
    """Four walls round a square, on a base."""

    builder = staticmethod(tower)
    seen_along_y = True

    kind: Literal["tower"]
    width: Length
    thickness: Length
    courses: Annotated[int, Given("integer", "[1, 10000]")]
    unit_length: Length
    unit_height: Length
    base: Length | None = None

    @model_validator(mode="after")
    def _is_hollow(self) -> "TowerSpec":
        if self.width <= 2.0 * self.thickness:
            raise KeyedError("width", f"must be more than two walls, {2.0 * self.thickness:g} m")
        return self

    @property
    def amount(self) -> tuple[float, float, float]:
        """About how many units, their volume (m3), and how deep they are along y (m)."""
        around = 4.0 * (self.width - self.thickness)
        units = self.courses * (around / self.unit_length + 2)
        return units, around * self.thickness * self.courses * self.unit_height, self.width


class CoreCells(CellsTable):
    """Cells of the core of a wall, in space."""

    form: Literal["space"] = "space"


class MultiLeafSpec(Structure):
    """Two leaves in bond, a core of cells, headers through all of it."""

    builder = staticmethod(multi_leaf)
    seen_along_y = True
    usual_view = "iso"

    kind: Literal["multi-leaf"]
    length: Length
    height: Length
    leaf_thickness: Length
    core_thickness: Length
    unit_length: Length
    unit_height: Length
    joint_thickness: Gap = 0.0
    bond: Literal["running", "stack"] = "running"
    headers: UnitInterval = 0.0
    core: CoreCells
    base: Length | None = None
    beam: Length | None = None

    def argument(self, name: str) -> Any:
        """The argument of a parameter of the builder."""
        return self.core.request if name == "core" else super().argument(name)

    @property
    def all_cells(self) -> tuple[CellsTable, ...]:
        """The tables of cells of all its parts that have one."""
        return (*super().all_cells, self.core)

    @property
    def amount(self) -> tuple[float, float, float]:
        """About how many units, their volume (m3), and how deep they are along y (m)."""
        face = self.length * self.height
        unit = (self.unit_length + self.joint_thickness) * (self.unit_height + self.joint_thickness)
        room = face * self.core_thickness
        core = self.core.total or (self.core.per_unit or 1.0 if self.core.size is None else room / self.core.size**3)
        return 2 * face / unit + core, face * (2 * self.leaf_thickness + self.core_thickness), self.leaf_thickness


class OpeningTable(Table):
    """A rectangular opening in a wall, and what bears the wall above it; `geometry.structures.openings.Opening`."""

    name: Annotated[str, Field(min_length=1, max_length=60)]
    left: Gap
    width: Length
    height: Length
    sill: Gap = 0.0
    head: Literal["lintel", "flat arch", "none"] = "lintel"
    bearing: Length | None = None
    head_courses: Count | None = None
    voussoirs: Count | None = None
    skew: Angle | None = None

    @model_validator(mode="after")
    def _has_the_keys_of_its_head(self) -> "OpeningTable":
        owners = {"bearing": ("lintel",), "head_courses": ("lintel", "flat arch")}
        owners |= dict.fromkeys(("voussoirs", "skew"), ("flat arch",))
        for key, heads in owners.items():
            if self.head not in heads and getattr(self, key) is not None:
                raise KeyedError(key, f"belongs to head = {' or '.join(map(repr, heads))}; leave it out")
        return self


class WallSpec(Structure):
    """A wall with openings, returns, a base and a beam."""

    builder = staticmethod(wall)
    seen_along_y = True

    kind: Literal["wall"]
    length: Length
    height: Length
    thickness: Length
    unit_length: Length
    unit_height: Length
    unit_width: Length | None = None
    joint_thickness: Gap = 0.0
    bond: Literal["running", "stack", "english", "flemish"] = "running"
    opening: tuple[OpeningTable, ...] = ()
    returns: Literal["none", "left", "right", "both"] = "none"
    return_length: Length | None = None
    return_thickness: Length | None = None
    base: Length | None = None
    beam: Length | None = None

    def argument(self, name: str) -> Any:
        """The argument of a parameter of the builder; of openings, the rest is as `Opening` has it."""
        if name != "opening":
            return super().argument(name)
        return [Opening(**{key: value for key, value in table if value is not None}) for table in self.opening]

    @model_validator(mode="after")
    def _names_differ(self) -> "WallSpec":
        name, times = Counter(o.name for o in self.opening).most_common(1)[0] if self.opening else ("", 0)
        if times > 1:
            raise KeyedError("opening", f"{times} openings are named '{name}'; each needs a name of its own")
        return self

    @property
    def amount(self) -> tuple[float, float, float]:
        """About how many units, their volume (m3), and how deep they are along y (m)."""
        sides = {"none": 0, "both": 2}.get(self.returns, 1)
        volume = (self.length + sides * (self.return_length or 0.0)) * self.thickness * self.height
        unit = (self.unit_length + self.joint_thickness) * (self.unit_height + self.joint_thickness) * self.thickness
        return volume / unit, volume, self.thickness


WallOrColumn = ColumnSpec | TowerSpec | WallSpec | MultiLeafSpec
