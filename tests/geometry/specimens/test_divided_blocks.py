"""Blocks of a file divided as built units are: volumes, joints, sets and units stay; what cannot be cut is refused."""

import numpy as np
import pytest

from geometry.blocks import GeometryError, Specimen
from geometry.cells.domain import Domain
from geometry.cells.request import CellRequest
from geometry.cells.space import divide_space
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import bounds, volumes
from geometry.polyhedra.overlaps import check_overlaps
from geometry.polyhedra.validate import require_sound
from geometry.specimens.divided import divided
from geometry.specimens.from_arrays import polyhedra
from geometry.specimens.wallette import wallette
from tests.geometry.specimens.test_from_arrays import CUBE, QUADS, prism

ARCH = 5
"""Voussoirs of a half circle."""


def voussoir(k):
    a, b = (np.pi * j / ARCH for j in (k, k + 1))
    ring = [(r * np.cos(t), r * np.sin(t)) for r, t in ((1.0, a), (1.4, a), (1.4, b), (1.0, b))]
    return np.array([(x, y, z) for y in (0.0, 0.3) for x, z in ring]), QUADS


@pytest.fixture(scope="module")
def arch():
    """Five voussoirs of group units on one block of group plates."""
    foot = (CUBE * [0.4, 0.3, 0.1] + [1.0, 0.0, -0.1], QUADS)
    solids = [voussoir(k) for k in range(ARCH)] + [foot]
    groups = ["units"] * ARCH + ["plates"]
    blocks = polyhedra(solids, [str(b) for b in range(ARCH + 1)], [7, 8, 9, 10, 11, 12], groups)
    return Specimen(blocks, {"key": np.array([2]), "ends": np.array([0, 4]), "foot": np.array([5])}, 0.1, "file")


def areas(blocks):
    """Area of the joints between each two units that meet."""
    joints = find_joints(blocks)
    pairs = np.sort(np.stack([blocks.unit[joints.block_a], blocks.unit[joints.block_b]]), axis=0)
    found = {}
    for a, b, area in zip(*pairs.tolist(), joints.area, strict=True):
        found[a, b] = found.get((a, b), 0.0) + float(area)
    return {pair: area for pair, area in found.items() if pair[0] != pair[1]}


FILLINGS = {
    "grid": (2, 1, 3),
    "cells of the plane": CellRequest(total=30),
    "cells in space": CellRequest(per_unit=5, space=True),
    "Voronoi cells in space": CellRequest(per_unit=4, space=True, laguerre=False, regularise=False),
    "cells of two sizes": CellRequest(per_unit=3, sizes=(1.0, 2.0, 3.0)),
}


@pytest.mark.parametrize("filling", FILLINGS.values(), ids=FILLINGS)
def test_parts_fill_their_blocks_and_units_meet_as_before(arch, filling):
    parts = divided(arch, filling)
    require_sound(parts.blocks)
    check_overlaps(parts.blocks)
    before, after = arch.blocks, parts.blocks
    assert after.count > before.count
    whole = np.bincount(before.unit, volumes(before))
    assert np.bincount(after.unit, volumes(after)) == pytest.approx(whole, rel=1e-9)
    assert areas(after) == pytest.approx(areas(before), rel=1e-9)
    assert set(after.unit[parts.sets["key"]]) == {9} and set(after.unit[parts.sets["ends"]]) == {7, 11}
    assert len(parts.sets["foot"]) == 1, "a plate is no unit and stays whole"
    assert sum(map(len, (parts.sets["ends"], parts.sets["key"]))) == np.isin(after.unit, [7, 9, 11]).sum()


def test_a_grid_in_boxes_is_that_of_a_built_wall():
    size = {"courses": 3, "units_per_course": 1, "unit_length": 0.2, "unit_height": 0.1, "thickness": 0.1}
    whole = wallette(**size, joint_thickness=0.0, bond="stack")
    cut, built = divided(whole, (4, 1, 2)), wallette(**size, joint_thickness=0.0, bond="stack", divisions=(4, 2))
    corners = [np.sort(np.round(np.hstack(bounds(part.blocks)), 12), axis=0) for part in (cut, built)]
    assert np.array_equal(*corners)
    areas_of = [np.sort(find_joints(part.blocks).area) for part in (cut, built)]
    assert areas_of[0] == pytest.approx(areas_of[1], rel=1e-12)


def test_given_sites_say_where_cells_lie(arch):
    inner = [tuple(voussoir(k)[0].mean(axis=0)) for k in range(ARCH)]
    more = (*inner, (1.1, 0.15, 0.1))
    parts = divided(arch, CellRequest(total=6, sites=more, space=True, laguerre=False, regularise=False))
    assert np.bincount(parts.blocks.unit, minlength=13)[7:].tolist() == [2, 1, 1, 1, 1, 1]
    with pytest.raises(GeometryError, match=r"the site \(0, 0, 0\) m lies in no unit"):
        divided(arch, CellRequest(total=6, sites=(*inner, (0.0, 0.0, 0.0))))


@pytest.mark.parametrize("turn", [0.0, 0.3, 1.1])
def test_a_domain_that_leans_any_way_is_divided_in_space(turn):
    """The box round a domain may touch it in an edge; it must not take part in its cells there."""
    spin = np.array([[np.cos(turn), 0.0, -np.sin(turn)], [0.0, 1.0, 0.0], [np.sin(turn), 0.0, np.cos(turn)]])
    domain = Domain(np.concatenate([-np.eye(3), np.eye(3)]) @ spin.T, np.array([0.0, 0.0, 0.0, 0.2, 0.3, 0.1]))
    _, report = divide_space(domain, np.ones(12), None, np.random.default_rng(1))
    assert report.size_error < 1e-9 and report.count == 12


def test_what_cannot_be_divided_is_refused(arch):
    with pytest.raises(GeometryError, match="no blocks of group 'stones' to be divided, only of units, plates"):
        divided(arch, (2, 1, 1), "stones")
    corner = prism([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], 0.0, 1.0)
    with pytest.raises(GeometryError, match="block 0 is not convex"):
        divided(Specimen(polyhedra([corner], ["a"], [0], ["units"])), (2, 1, 1))
    upright = prism([(0, 0), (1, 0), (0, 1)], 0.0, 1.0)
    foot = (CUBE - [0, 0, 1], QUADS)
    with pytest.raises(GeometryError, match="block 1 is no prism along y.*form = 'space'"):
        divided(Specimen(polyhedra([foot, upright], ["a", "b"], [0, 1], ["feet", "units"])), CellRequest(total=3))
