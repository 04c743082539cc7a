"""Prisms and couplets: layers that meet, beds of mortar of a grid or of cells."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.cells.request import CellRequest
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import bounds, volumes
from geometry.polyhedra.polygons import areas_normals_centroids, pad
from geometry.specimens.stacked import couplet, prism

SIZE = (0.2, 0.1, 0.05)


def horizontal_area(specimen):
    """Area of all joints that look up or down between different units."""
    joints = find_joints(specimen.blocks)
    unit = specimen.blocks.unit
    between = (unit[joints.block_a] != unit[joints.block_b]) & (np.abs(joints.normal[:, 2]) > 0.999)
    return joints.area[between].sum()


def test_a_prism_stacks_units_and_beds_of_mortar():
    specimen = prism(4, *SIZE, (2, 1, 1), mortar=(0.01, (3, 1, 1)), plates=0.02)
    low, high = bounds(specimen.blocks)
    reach = {name: (low[s, 2].min(), high[s, 2].max()) for name, s in specimen.sets.items()}
    for u in range(4):
        assert np.allclose(reach[f"unit {u + 1}"], (0.02 + 0.06 * u, 0.07 + 0.06 * u), atol=1e-15)
    assert (reach["bottom"], reach["top"]) == (reach["unit 1"], reach["unit 4"])
    assert np.allclose(reach["mortar"], (0.07, 0.20), atol=1e-15)
    assert np.allclose([reach["bottom plate"], reach["top plate"]], [(0, 0.02), (0.25, 0.27)], atol=1e-15)
    assert {name: len(s) for name, s in specimen.sets.items() if "unit " not in name} == {
        "bottom": 2,
        "top": 2,
        "units": 8,
        "mortar": 9,
        "bottom plate": 1,
        "top plate": 1,
    }
    assert len(np.unique(specimen.blocks.unit)) == 4 + 3 + 2
    assert horizontal_area(specimen) == pytest.approx(8 * 0.2 * 0.1, rel=1e-12)


@pytest.mark.parametrize("mortar", [None, (0.01, (2, 1, 1))])
def test_the_layers_of_a_prism_meet_over_their_whole_area(mortar):
    specimen = prism(3, *SIZE, (2, 2, 1), mortar)
    assert horizontal_area(specimen) == pytest.approx((2 if mortar is None else 4) * 0.2 * 0.1, rel=1e-12)
    assert volumes(specimen.blocks).sum() == pytest.approx((3 * 0.05 + (2 * 0.01 if mortar else 0)) * 0.02, rel=1e-13)


def test_a_bed_of_cells_fills_the_space_between_the_units():
    specimen = couplet(0.2, 0.005, 0.05, (1, 1, 1), (0.015, CellRequest(total=100, seed=3)))
    mortar = specimen.sets["mortar"]
    low, high = bounds(specimen.blocks)
    assert (len(mortar), [report.count for report in specimen.cells]) == (100, [100])
    assert np.allclose([low[mortar].min(axis=0), high[mortar].max(axis=0)], [(0, 0, 0.05), (0.2, 0.005, 0.065)])
    assert volumes(specimen.blocks)[mortar].sum() == pytest.approx(0.2 * 0.005 * 0.015, rel=1e-12)
    assert horizontal_area(specimen) == pytest.approx(2 * 0.2 * 0.005, rel=1e-9)
    assert np.all(specimen.blocks.group[mortar] == specimen.blocks.groups.index("mortar"))


def test_the_cells_of_all_beds_are_shared_out_and_no_face_is_bent():
    specimen = prism(3, *SIZE, CellRequest(per_unit=6), (0.01, CellRequest(total=50)))
    assert [len(specimen.sets[name]) for name in ("unit 1", "unit 2", "unit 3", "mortar")] == [6, 6, 6, 50]
    assert [report.count for report in specimen.cells] == [18, 50]
    blocks = specimen.blocks
    corners, count = pad(blocks.points, blocks.face_start, blocks.face_points)
    _, normal, centroid = areas_normals_centroids(corners)
    for f in range(len(count)):
        assert np.abs((corners[f, : count[f]] - centroid[f]) @ normal[f]).max() < 1e-12


def test_a_prism_of_one_unit_has_no_bed():
    specimen = prism(1, *SIZE, mortar=(0.01, (1, 1, 1)))
    assert (specimen.blocks.count, "mortar" in specimen.sets) == (1, False)


def test_a_prism_without_units_is_refused():
    with pytest.raises(GeometryError, match="number of units along z is 0.*nearest: 1"):
        prism(0, *SIZE)
