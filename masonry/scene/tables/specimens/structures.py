"""Tables of a scene for structures that people build. Lengths in m."""

from collections import Counter
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, StrictBool, model_validator

from geometry.structures.rings import ring_over
from masonry.scene.tables.cells import CellsTable
from masonry.scene.tables.specimens.common import Divided, SpecimenTable
from masonry.scene.tables.types import (
    Angle,
    Count,
    Embrace,
    Gap,
    Given,
    Halves,
    KeyedError,
    Length,
    Table,
    UnitInterval,
    Voussoirs,
)

Sides = Annotated[int, Given("integer", "[3, 1000]")]


class Structure(SpecimenTable, Divided):
    """A structure, whose units may be divided."""

    @property
    def amount(self) -> tuple[float, float, float]:
        """About how many units, their volume (m3), and how deep they are along y (m)."""
        raise NotImplementedError


class _Ring(Structure):
    """A ring of pieces between two abutments: radius of the centre line and angle of embrace, or span and rise of the
    intrados."""

    radius: Length | None = None
    angle: Embrace | None = None
    span: Length | None = None
    rise: Length | None = None
    thickness: Length

    @property
    def ring(self) -> tuple[float, float, float]:
        """Radius of the centre line (m), angle of embrace (rad), z of the centre (m)."""
        if self.span is not None and self.rise is not None:
            return ring_over(self.span, self.rise, self.thickness)
        assert self.radius is not None and self.angle is not None
        return self.radius, self.angle, 0.0

    @property
    def length_of_ring(self) -> float:
        """m, of its centre line."""
        radius, angle, _ = self.ring
        return radius * angle

    @model_validator(mode="after")
    def _is_a_ring(self) -> "_Ring":
        by_circle, by_span = {"radius": self.radius, "angle": self.angle}, {"span": self.span, "rise": self.rise}
        mine, others = (by_span, by_circle) if self.span is not None or self.rise is not None else (by_circle, by_span)
        for key, value in others.items():
            if value is not None:
                raise KeyedError(
                    key, "radius and angle, or span and rise, give the ring; keep two that belong together"
                )
        for key, value in mine.items():
            if value is None:
                raise KeyedError(key, "missing; give radius and angle of the ring, or span and rise of its intrados")
        if self.span is not None and self.rise is not None and self.rise > 0.5 * self.span:
            raise KeyedError("rise", f"must be half of the span or less, {0.5 * self.span:g} m; that is a semicircle")
        if self.radius is not None and self.thickness >= self.radius:
            raise KeyedError("thickness", f"must be less than radius, {self.radius:g} m, the radius of the centre line")
        return self


class ArchSpec(_Ring):
    """A ring of voussoirs between two abutments."""

    kind: Literal["arch"]
    voussoirs: Voussoirs
    depth: Length
    facets: Count = 1
    abutments: Literal["square", "skewbacks"] = "square"

    @property
    def amount(self) -> tuple[float, float, float]:
        """About how many units, their volume (m3), and how deep they are along y (m)."""
        return self.voussoirs + 2, self.length_of_ring * self.thickness * self.depth, self.depth


class BridgeArchTable(Table):
    """An arch of a bridge, by span and rise of its intrados; `geometry.structures.bridge.BridgeArch`."""

    span: Length
    rise: Length
    thickness: Length
    voussoirs: Voussoirs

    @model_validator(mode="after")
    def _is_at_most_a_semicircle(self) -> "BridgeArchTable":
        if self.rise > 0.5 * self.span:
            raise KeyedError("rise", f"must be half of the span or less, {0.5 * self.span:g} m; that is a semicircle")
        return self


class PierTable(Table):
    """Pier from which two arches of a bridge spring; `geometry.structures.bridge.Pier`."""

    width: Length
    height: Length
    courses: Count


class BridgeSpec(Structure):
    """Arches side by side, on piers between two abutments."""

    kind: Literal["bridge"]
    depth: Length
    arch: Annotated[tuple[BridgeArchTable, ...], Field(min_length=1, max_length=100)]
    pier: tuple[PierTable, ...] = ()

    @model_validator(mode="after")
    def _has_a_pier_between_each_two_arches(self) -> "BridgeSpec":
        if len(self.pier) != len(self.arch) - 1:
            needed = f"{len(self.arch)} arches have {len(self.arch) - 1} piers between them"
            raise KeyedError("pier", f"{needed}; here are {len(self.pier)}")
        return self

    @property
    def amount(self) -> tuple[float, float, float]:
        """About how many units, their volume (m3), and how deep they are along y (m)."""
        rings = [ring_over(one.span, one.rise, one.thickness)[:2] for one in self.arch]
        area = sum(r * angle * one.thickness for (r, angle), one in zip(rings, self.arch, strict=True))
        area += sum(pier.width * pier.height for pier in self.pier)
        units = sum(one.voussoirs for one in self.arch) + sum(pier.courses + 1 for pier in self.pier) + 2
        return units, area * self.depth, self.depth


class VaultSpec(_Ring):
    """A barrel vault: courses in bond between two abutments."""

    kind: Literal["vault"]
    courses: Voussoirs
    length: Length
    units_per_course: Halves
    bond: Literal["running", "stack"] = "running"
    facets: Count = 1

    @property
    def amount(self) -> tuple[float, float, float]:
        """About how many units, their volume (m3), and how deep they are along y (m)."""
        volume = self.length_of_ring * self.thickness * self.length
        return self.courses * (self.units_per_course + 0.5), volume, self.length / self.units_per_course


class DomeSpec(Structure):
    """Courses of voussoirs round an upright axis, on a ring of blocks; radius of the middle surface."""

    kind: Literal["dome"]
    radius: Length
    angle: Embrace = float(np.pi)
    thickness: Length
    courses: Count
    voussoirs: Sides
    crown: Length
    bond: Literal["running", "stack"] = "running"
    closed: StrictBool = True

    @model_validator(mode="after")
    def _has_a_crown(self) -> "DomeSpec":
        if self.thickness >= self.radius:
            raise KeyedError("thickness", f"must be less than radius, {self.radius:g} m, the radius of the centre line")
        springing = self.radius * float(np.sin(0.5 * self.angle))
        if self.crown >= springing:
            raise KeyedError("crown", f"must be less than the radius at the springing, {springing:.4g} m")
        return self

    @property
    def amount(self) -> tuple[float, float, float]:
        """About how many units, their volume (m3), and how deep they are along y (m)."""
        area = 2 * np.pi * self.radius**2 * (1 - float(np.cos(0.5 * self.angle)))
        return (self.courses + 2) * self.voussoirs + 1, area * self.thickness, 2 * self.radius / self.voussoirs


class ColumnSpec(Structure):
    """Drums one above the other, on a base and under a capital."""

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
