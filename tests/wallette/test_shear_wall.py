"""The packaged shear wall: pressed by a beam that stays level, pushed until it cracks from corner to corner."""

import numpy as np
import pytest

from masonry.judgement.sentence import trust
from masonry.laboratory import laboratory
from masonry.scene import load

PRESSED = 1.21e6 * 0.99 * 0.1
"""N, the dead load on the beam."""


@pytest.mark.slow
def test_the_shear_wall_cracks_in_steps_between_the_bounds_of_statics():
    result = laboratory.run(load("shear-wall"))
    summary, end = result.summary, result.summary["reactions"]["end"]
    sliding = 0.75 * PRESSED + 0.224e6 * 0.99 * 0.1
    rocking = (PRESSED + 0.16e6 * 0.99 * 0.1) * 0.99 / 0.992
    assert 0.5 * PRESSED < summary["peak_force_n"] < min(sliding, rocking)
    assert summary["kinetic_over_internal_max"] < 1e-3
    assert "sound: quasi-static, and the energy balance closes" in trust(summary)
    bears = sum(end[who]["force_n"][2] for who in ("support.0", "damping", "inertia"))
    assert bears == pytest.approx(PRESSED, rel=1e-12), "the base bears what lies on the beam, but for what still moves"
    assert summary["motion_at_end"] < 1e-5
    frame, joints, blocks = result.history.frames[-1], result.joints, result.specimen.blocks
    head = (np.abs(joints.normal[:, 0]) > 0.5) & (blocks.unit[joints.block_a] != blocks.unit[joints.block_b])
    course = np.floor(joints.point[:, 2] / 0.062).astype(int)
    opened = [frame.opening[head & (course == c)].max() for c in range(16)]
    assert min(opened) > 0.1e-3, "a head joint is open in every course"
    places = [joints.point[head & (course == c)][np.argmax(frame.opening[head & (course == c)]), 0] for c in range(16)]
    assert np.corrcoef(places, range(16))[0, 1] < -0.9, "from the top left, where the beam presses, to the bottom right"
