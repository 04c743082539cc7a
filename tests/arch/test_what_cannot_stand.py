"""What dead loads move away is told from what stands, near the limit by hand on either side of it."""

import numpy as np
import pytest

from masonry import scene
from masonry.errors import Stopped
from masonry.judgement.judgement import judgement_of
from masonry.judgement.sentence import advice, trust
from masonry.laboratory import laboratory

TILT = 0.1504653
"""Horizontal over vertical acceleration under which the packaged arch falls, by linear programming (Livesley 1978)."""


def tilted(share: float, **more):
    gravity = {"x": f"{share * TILT * 9.81} m/s^2", "z": "-9.81 m/s^2"}
    return scene.load("arch", {"gravity": gravity}).with_(more)


CORNERS = {"specimen.points_per_edge": 2}
STIFF = {"closed_joints"}
"""What is doubtful of arches with two points along an edge whose dry joints stay closed."""


def doubted(summary) -> set[str]:
    """The names of its doubts."""
    return {doubt.name for doubt in judgement_of(summary).doubts}


@pytest.mark.parametrize(("share", "stands"), [(0.98, True), (0.999, True), (1.001, False), (1.02, False)])
def test_an_arch_that_is_tilted_too_far_is_doubted_however_slowly_it_falls(share, stands):
    summary = laboratory.run(tilted(share)).summary
    assert summary["unbalanced_after_settling"] < 1e-3, "the force alone does not tell"
    assert (doubted(summary) <= STIFF) == stands
    assert (summary["kinetic_after_settling"] < 1e-12) == stands


@pytest.mark.parametrize("thickness", [106, 105])
def test_an_arch_that_is_a_little_too_thin_is_doubted(thickness):
    summary = laboratory.run(scene.load("arch", {"specimen.thickness": f"{thickness} mm", **CORNERS})).summary
    assert summary["unbalanced_after_settling"] < 1e-3, "by limit analysis 106.07 mm are needed"
    assert any("cannot stand under them" in words for words in advice(summary))


def test_steps_that_are_found_leave_no_swing_in_the_thrust():
    brief, patient = (laboratory.run(tilted(0.98, settle=steps)).summary for steps in (None, {"steps": 20_000}))
    thrust, right = (summary["reactions"]["end"]["support.1"]["force_n"][0] for summary in (brief, patient))
    assert thrust == pytest.approx(right, rel=1e-5)
    assert doubted(brief) <= STIFF


def test_no_steps_are_found_for_what_falls():
    with pytest.raises(Stopped, match=r"not come to rest in 128000 steps: .* kinetic energy is .* of the stored"):
        laboratory.run(tilted(1.001, settle=None))


def test_the_peak_of_a_thrust_that_pushes_the_drive_along_is_its_least_amount_after_settling():
    drive = {"on": "right abutment", "direction": "x", "displacement": "1 mm", "accuracy": "1 %"}
    result = laboratory.run(scene.load("arch-spread", {"drive": drive}))
    summary, forces = result.summary, result.history.rows["force"]
    assert summary["peak_force_n"] == pytest.approx(-479.62, rel=0.005) == forces[-1]
    assert summary["displacement_at_peak_m"] > 0.0 and summary["lowest_stress_pa"] == pytest.approx(
        -516.18 / 0.045, rel=1e-3
    )
    assert summary["reactions"]["peak"]["drive"]["force_n"][0] < -478.0
    assert result.peak.stress == summary["peak_stress_pa"]
    assert 0.0 < summary["reaction_mismatch_max"] < 0.02 and "with care" not in trust(summary)
    assert np.abs(forces).max() < 517.0
