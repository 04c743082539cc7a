"""Tables of a scene for arches, bridges, vaults and domes. Lengths in m."""

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, StrictBool, model_validator

from geometry.structures.arch import arch
from geometry.structures.bridge import BridgeArch, Pier, bridge
from geometry.structures.dome import dome
from geometry.structures.rings import ring_over
from geometry.structures.vault import vault
from masonry.scene.tables.specimens.common import Structure
from masonry.scene.tables.types import Count, Embrace, Halves, KeyedError, Length, Sides, Table, Voussoirs


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

    def argument(self, name: str) -> Any:
        """The argument of a parameter of the builder; those of the ring follow from several keys."""
        ring = dict(zip(("radius", "angle", "level"), self.ring, strict=True))
        return ring[name] if name in ring else super().argument(name)

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

    builder = staticmethod(arch)
    seen_along_y = True

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

    builder = staticmethod(bridge)
    seen_along_y = True

    kind: Literal["bridge"]
    depth: Length
    arch: Annotated[tuple[BridgeArchTable, ...], Field(min_length=1, max_length=100)]
    pier: tuple[PierTable, ...] = ()

    def argument(self, name: str) -> Any:
        """The argument of a parameter of the builder."""
        parts = {"arch": BridgeArch, "pier": Pier}
        return [parts[name](**dict(table)) for table in getattr(self, name)] if name in parts else getattr(self, name)

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

    builder = staticmethod(vault)
    seen_along_y = True
    usual_view = "iso"

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

    builder = staticmethod(dome)
    seen_along_y = True
    usual_view = "iso"

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


ArchOrDome = ArchSpec | BridgeSpec | VaultSpec | DomeSpec
