"""What a scene says of a structure that people build. Lengths in m."""

from typing import Literal

from pydantic import model_validator

from masonry.scene.tables.specimens.common import Divided, SpecimenTable
from masonry.scene.tables.types import Embrace, KeyedError, Length, Voussoirs


class Structure(SpecimenTable, Divided):
    """A structure, whose units may be divided."""

    @property
    def amount(self) -> tuple[float, float, float]:
        """About how many units, their volume (m3), and how deep they are along y (m)."""
        raise NotImplementedError


class ArchSpec(Structure):
    """A ring of voussoirs between two abutments; radius of the centre line, angle of embrace."""

    kind: Literal["arch"]
    radius: Length
    angle: Embrace
    voussoirs: Voussoirs
    thickness: Length
    depth: Length

    @model_validator(mode="after")
    def _is_a_ring(self) -> "ArchSpec":
        if self.thickness >= self.radius:
            raise KeyedError(
                "thickness", f"must be less than radius, {self.radius:g} m, which is that of the centre line"
            )
        return self

    @property
    def amount(self) -> tuple[float, float, float]:
        """About how many units, their volume (m3), and how deep they are along y (m)."""
        return self.voussoirs + 2, self.radius * self.angle * self.thickness * self.depth, self.depth
