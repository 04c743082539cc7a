"""Every packaged scene runs to its end, quasi-static, with an energy balance that closes."""

import numpy as np
import pytest

from masonry.laboratory import laboratory
from masonry.scene import load, packaged

QUICK = ("couplet", "couplet-cyclic", "couplet-meso-coarse", "triplet-dry", "wallette-mode-1", "wallette-mode-2")


def require_balance(summary):
    """Forces and moments of supports, drive, loads, damping and inertia add up to nothing, while it moves and at the
    end; and damping and inertia have almost no part in it at the end."""
    for balance in summary["reactions"].values():
        acts = {name: act for name, act in balance.items() if isinstance(act, dict) and name != "sum"}
        assert acts.keys() > {"support.0", "damping", "inertia"}
        for key in ("force_n", "moment_nm"):
            each = np.array([act[key] for act in acts.values()])
            left = each.sum(axis=0)
            forces = np.array([act["force_n"] for act in acts.values()])
            most = max(np.abs(each).max(), np.abs(forces).max())  # or a force times 1 m, without any moment
            assert np.abs(left).max() < 1e-12 * most, key
            assert balance["sum"][key] == pytest.approx(left.tolist(), rel=0.0, abs=1e-14 * most)
    assert set(summary["reactions"]) == {"peak", "end"}
    assert summary["force_balance"] < 1e-12
    if summary["collapse_load"] is None:  # which ends in a fall
        soft = summary["law"] == "friction" or summary["energy_j"].get("crushing", 0.0) > 0.0
        # what rocks on dry joints, or on toes at their strength, hardly has a stiffness that brings it to rest
        assert summary["motion_at_end"] < (1e-4 if soft else 1e-5)


@pytest.mark.parametrize("name", QUICK)
def test_forces_and_moments_on_a_packaged_scene_add_up_to_nothing(name):
    require_balance(laboratory.run(load(name)).summary)


RUBBLE = ("wall-three-leaf", "wall-three-leaf-out-of-plane")
"""Driven in so many steps, for minutes: they have tests of their own in tests/structures."""


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in packaged() if not load(name).is_large and name not in RUBBLE])
def test_a_packaged_scene_runs_to_its_end(name):
    scene = load(name)
    summary = laboratory.run(scene).summary
    assert (summary["stopped"], summary["interrupted"]) == ("", False)
    if scene.drive is None:
        assert summary["unbalanced_after_settling"] < 1e-9
        assert summary["peak_stress_pa"] is None and summary["reaction_mismatch_max"] is None
    else:
        assert summary["reaction_mismatch_max"] < 0.02
        assert summary["peak_stress_pa"] >= abs(summary["final_stress_pa"])
        assert summary["final_stress_pa"] > 0.0 or summary["cycles"]
    assert all(cycle["closed"] and cycle["dissipated_j"] > 0.0 for cycle in summary["cycles"])
    require_balance(summary)
    assert summary["energy_imbalance"] < 1e-9
    assert (summary["kinetic_over_internal_max"] or 0.0) < 0.05 and summary["not_measured"] == []
    assert summary["dissipation_mismatch"] < 0.01
