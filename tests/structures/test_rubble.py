"""The three-leaf wall: what headers are worth out of its plane, and a simulation below its limit analysis."""

import pytest

import masonry

FEW = {"specimen.core.total": 60}
"""Cells, in place of the 2,000 of the packaged scenes."""


@pytest.mark.slow
def test_headers_hold_the_leaves_together_out_of_plane():
    scene = "wall-three-leaf-out-of-plane"
    with_headers, without = (masonry.limit(masonry.load(scene, {**FEW, "specimen.headers": h})) for h in (0.083, 0.0))
    assert with_headers.factor > 1.15 * without.factor
    assert max(with_headers.gap, without.gap) < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "displacement", "steps"),
    [("wall-three-leaf", "1.2 mm", 40000), ("wall-three-leaf-out-of-plane", "2 mm", 60000)],
)
def test_a_wall_of_rubble_bears_less_than_rubble_that_dilates(name, displacement, steps):
    scene = masonry.load(name, {**FEW, "drive.displacement": displacement, "drive.steps": steps})
    summary, most = masonry.run(scene).summary, masonry.limit(scene).factor
    assert summary["stopped"] == "" and summary["energy_imbalance"] < 1e-9
    assert 0.8 * most < summary["peak_force_n"] < most


@pytest.mark.slow
@pytest.mark.parametrize("name", ["wall-three-leaf", "wall-three-leaf-out-of-plane"])
def test_the_packaged_walls_of_2000_cells_are_built_and_settle(name):
    summary = masonry.run(masonry.load(name, {"drive.steps": 200, "drive.displacement": "1 um"})).summary
    assert summary["unbalanced_after_settling"] < 1e-6 and summary["energy_imbalance"] < 1e-9
