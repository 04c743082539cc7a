"""What is said of fracture energies, on curves and cracks that are made up."""

import numpy as np
import pytest

from tests.verification.paper.test_curve_shapes import PEAK, curve
from tests.verification.paper.test_size_claims import LENGTH, cracked
from verification.paper.walls.common import rate_claim
from verification.paper.walls.curve_shape import tail
from verification.paper.walls.energy_claims import drastic_claim, pattern_claim, residual_claim, smooth_claim

SOFT = np.exp(-np.linspace(0.0, 4.0, 400))


def test_a_curve_that_rests_and_falls_once_more_is_not_smooth_and_one_that_only_decays_is():
    late = np.concatenate([0.5 + 0.5 * SOFT, 0.2 * np.ones(100)])
    smooth = {kind: {f: curve(SOFT) for f in (1, 2, 4)} for kind in ("GI", "GII")}
    rough = smooth | {"GII": {1: curve(SOFT), 2: curve(late), 4: curve(SOFT)}}
    assert smooth_claim({"upright": smooth, "hinge": rough}).holds, "what is not shipped is told, and does not count"
    dropped = smooth_claim({"hinge": rough, "upright": smooth})
    assert not dropped.holds and "GII x 2: 31 %" in dropped.measured
    assert smooth_claim({"hinge": smooth | {"GII": {1: curve(late), 2: curve(SOFT), 4: curve(SOFT)}}}).holds


def test_the_tail_is_the_mean_of_the_last_third_and_a_residual_is_higher_only_by_more_than_its_limit():
    def level(share: float):
        return curve(np.concatenate([SOFT[:200], share * np.ones(800)]))

    assert tail(level(0.1)) == pytest.approx(0.1 * PEAK)
    assert residual_claim({"cells": {"GII": {1: level(0.1), 2: level(0.103), 4: level(0.106)}}}).holds
    assert not residual_claim({"cells": {"GII": {1: level(0.1), 2: level(0.101), 4: level(0.106)}}}).holds


def test_a_tensile_energy_is_drastic_where_it_moves_the_curve_much_more_than_the_shear_energy_does():
    def slower(times: float):
        return curve(np.exp(-np.linspace(0.0, 4.0 / times, 400)))

    tension, hardly = {f: slower(f) for f in (1, 2)}, {f: slower(1.0 + 0.1 * f) for f in (1, 2)}
    assert drastic_claim({"grid": {"GI": tension, "GII": hardly}}).holds
    assert not drastic_claim({"grid": {"GI": hardly, "GII": hardly}}).holds
    assert not drastic_claim({"grid": {"GI": tension, "GII": tension}}).holds


def test_a_crack_that_moves_by_half_a_unit_is_another_pattern_and_the_same_one_is_not():
    here, there = cracked(LENGTH), cracked(1.5 * LENGTH)
    assert pattern_claim("cells", {1: here, 2.5: there}).holds
    same = pattern_claim("cells", {1: here, 2.5: cracked(LENGTH)})
    assert not same.holds and same.why


@pytest.mark.parametrize(("ends", "kinetic", "holds"), [(0.01, 0.01, True), (0.03, 0.01, False), (0.01, 0.06, False)])
def test_a_rate_is_quasi_static_by_the_limits_of_every_run_and_says_how_far_it_is_from_the_accuracy(
    ends, kinetic, holds
):
    shipped, constant = curve(SOFT), curve(1.02 * SOFT)
    constant.summary |= {
        "peak_stress_pa": 1.02 * PEAK,
        "reaction_mismatch_max": ends,
        "kinetic_over_internal_max": kinetic,
    }
    claim = rate_claim(shipped, constant, "5")
    assert claim.holds is holds and "peak +2 %" in claim.measured
