"""What a scene says of its specimen: the couplet, the wallette, or boxes one by one. Lengths in m, areas in m2."""

from collections import Counter
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from masonry.scene.points import PerAxis, PointsPerEdge, PointsPerFace, fewest, one_density
from masonry.scene.types import Area, Count, Gap, KeyedError, Length, Number, Position, Table


class _Specimen(Table):
    kind: str
    contact_points: Literal["gauss", "vertex"] = "gauss"
    points_per_edge: PointsPerEdge = PerAxis()
    points_per_face: PointsPerFace | None = None
    contact_spacing: Length | None = None
    mesh_size: Length | None = None

    @model_validator(mode="before")
    @classmethod
    def _one_density(cls, data: Any) -> Any:
        return one_density(data)

    @model_validator(mode="after")
    def _has_corners(self) -> "_Specimen":
        if self.contact_points == "vertex":
            for key, number in (("points_per_edge", 2), ("points_per_face", 4)):
                given = getattr(self, key)
                if given is not None and fewest(given) < number:
                    raise KeyedError(key, f"must be {number} or more with contact_points = 'vertex'")
        return self


class Mortar(Table):
    """A mortar layer made of blocks."""

    thickness: Length
    divisions: tuple[Count, Count, Count] = (1, 1, 1)


class CoupletSpec(_Specimen):
    """Two units, one above the other; length, width and height are those of one unit."""

    kind: Literal["couplet"]
    length: Length
    width: Length
    height: Length
    divisions: tuple[Count, Count, Count] = (1, 1, 1)
    mortar: Mortar | None = None
    plates: Length | None = None


class WalletteSpec(_Specimen):
    """Running bond of expanded units with zero-thickness joints; divisions (nx, nz) of a whole unit."""

    kind: Literal["wallette"]
    courses: Count
    units_per_course: Count = 2
    unit_length: Length
    unit_height: Length
    thickness: Length
    joint_thickness: Gap = 0.0
    divisions: tuple[Count, Count] = (1, 1)
    plates: Length | None = None


class Box(Table):
    """A cuboid, divided into a regular grid of blocks."""

    name: Annotated[str, Field(min_length=1)]
    origin: tuple[Position, Position, Position]
    size: tuple[Length, Length, Length]
    group: Annotated[str, Field(min_length=1)] = "units"
    unit: Number = 0
    divisions: tuple[Count, Count, Count] = (1, 1, 1)


class BoxesSpec(_Specimen):
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


Specimen = Annotated[CoupletSpec | WalletteSpec | BoxesSpec, Field(discriminator="kind")]
