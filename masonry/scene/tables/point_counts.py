"""Number of contact points in a scene: along edges, on a face, or by their spacing."""

from typing import Annotated, Any, NamedTuple

from pydantic import AfterValidator, BeforeValidator, PlainSerializer, ValidationInfo

from masonry.quantity import convert
from masonry.scene.tables.types import Count, Given, KeyedError

DENSITIES = ("points_per_edge", "points_per_face", "contact_spacing")
"""Three ways to say how many contact points there are; one at most is given."""
EXAMPLE = "a table by axis such as {x = 2, y = 10, z = 2}"


class PerAxis(NamedTuple):
    """Points along an edge, by the axis that it runs along; what a file leaves out is 2."""

    x: Count = 2
    y: Count = 2
    z: Count = 2


def _per_axis(value: Any, info: ValidationInfo) -> Any:
    """One number for all axes, or a table by axis."""
    if value is None or isinstance(value, (dict, PerAxis)):
        return value
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        raise ValueError(f"must be a whole number, or {EXAMPLE}; not {value!r:.60}")
    number = convert(value, "integer", info.field_name or "", "[1, 1000]")
    return PerAxis(*3 * (int(number),))


def _even(value: int) -> int:
    if value % 2:
        raise ValueError(f"must be even, as points lie on lines from the middle of a patch to its corners; not {value}")
    return value


def _write_per_axis(value: PerAxis | None) -> Any:
    return value._asdict() if value is not None and len(set(value)) > 1 else value and value.x


def fewest(number: PerAxis | int) -> int:
    """The fewest points along an edge, or the points on a face."""
    return number if isinstance(number, int) else min(number)


PointsPerEdge = Annotated[PerAxis | None, BeforeValidator(_per_axis), PlainSerializer(_write_per_axis)]
PointsPerFace = Annotated[int, Given("integer", "[1, 1e5]")]
PatchPointsPerEdge = Annotated[int, AfterValidator(_even), Given("integer", "[2, 40]")]


def one_density(table: Any) -> Any:
    """Raw values in which points_per_edge has its default only where nothing else is said; KeyedError for two."""
    densities = [key for key in DENSITIES if isinstance(table, dict) and table.get(key) is not None]
    if len(densities) > 1:
        raise KeyedError(densities[1], f"{' and '.join(densities)} exclude each other; keep one of them")
    return table if densities in ([], ["points_per_edge"]) else {**table, "points_per_edge": None}
