"""The column: drums that fill a prism or a frustum and meet over whole polygons."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import bounds, volumes
from geometry.polyhedra.validate import require_sound as require_valid
from geometry.structures.column import column
from tests.geometry.structures.drawing import joint_areas, require_sound


def polygon(radius: float, sides: int = 12) -> float:
    """m2 of a regular polygon in a circle."""
    return 0.5 * sides * radius**2 * float(np.sin(2 * np.pi / sides))


def test_a_tapered_column_is_a_frustum_and_its_joints_are_whole_polygons():
    specimen = column(0.6, 2.0, 4, 12, top_diameter=0.4, base=0.2, capital=0.25, overhang=0.05)
    require_valid(specimen.blocks)
    low, high = polygon(0.3), polygon(0.2)
    frustum = 2.0 / 3 * (low + high + np.sqrt(low * high))
    require_sound(specimen, frustum + 0.7**2 * 0.2 + 0.5**2 * 0.25)
    areas = joint_areas(find_joints(specimen.blocks))
    inner = {(k, k + 1): polygon(0.3 - 0.025 * (k + 1)) for k in range(3)}
    expected = {**inner, (3, 4): high, (0, 5): low}
    assert areas.keys() == expected.keys()
    assert [areas[pair] for pair in expected] == pytest.approx(list(expected.values()), rel=1e-9)
    assert specimen.section == pytest.approx(low)
    assert {name: members.tolist() for name, members in specimen.sets.items()} == {
        **{"units": [0, 1, 2, 3, 4], "drums": [0, 1, 2, 3], "capital": [4], "top": [4], "base": [5]},
        **{f"drum {k + 1}": [k] for k in range(4)},
    }


@pytest.mark.parametrize("sides", [4, 12, 24])
def test_a_side_looks_along_x_and_another_along_y(sides):
    low, high = bounds(column(1.0, 1.0, 1, sides).blocks)
    assert high[0, :2] == pytest.approx(np.full(2, 0.5 * np.cos(np.pi / sides)), rel=1e-12)
    assert low[0, :2] == pytest.approx(-high[0, :2], rel=1e-12)
    assert volumes(column(1.0, 1.0, 3, sides).blocks) == pytest.approx(np.full(3, polygon(0.5, sides) / 3), rel=1e-9)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"drums": 0}, "number of drums along z is 0"),
        ({"sides": 2}, "number of sides is 2, it must be 3 or more; nearest: 3"),
        ({"diameter": 0.0}, "diameter is 0 m"),
        ({"top_diameter": -0.1}, "top_diameter is -0.1 m"),
        ({"overhang": -0.1}, "overhang is -0.1 m, it must be 0 m or more"),
    ],
)
def test_a_column_that_cannot_be_built_says_what_would_work(change, message):
    with pytest.raises(GeometryError, match=message):
        column(**({"diameter": 0.6, "height": 2.0, "drums": 4} | change))
