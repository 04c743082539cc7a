"""Every packaged scene runs to its end, quasi-static, with an energy balance that closes."""

import pytest

from masonry import laboratory
from masonry.scene import load, packaged


@pytest.mark.slow
@pytest.mark.parametrize("name", packaged())
def test_a_packaged_scene_runs_to_its_end(name):
    scene = load(name)
    summary = laboratory.run(scene).summary
    assert (summary["stopped"], summary["interrupted"]) == ("", False)
    if scene.drive is None:
        assert summary["unbalanced_after_settling"] < 1e-9
    else:
        assert summary["peak_stress_pa"] > abs(summary["final_stress_pa"])
        assert summary["final_stress_pa"] > 0.0 or summary["cycles"]
    assert all(cycle["closed"] and cycle["dissipated_j"] > 0.0 for cycle in summary["cycles"])
    assert summary["energy_imbalance"] < 1e-9
    assert summary["reaction_mismatch_max"] < 0.02
    assert summary["kinetic_over_internal_max"] < 0.05
    assert summary["dissipation_mismatch"] < 0.01
