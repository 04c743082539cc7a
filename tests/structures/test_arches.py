"""The segmental arch between skewbacks: what its crown bears, by lines of thrust, limit analysis and simulation."""

import numpy as np
import pytest

import masonry
from geometry.polyhedra.measures import centroids, volumes
from masonry.errors import Stopped
from tests.structures.lines_of_thrust import greatest_crown_load


def by_hand(specimen) -> float:
    """N on the keystone of the packaged arch, half of it on each half."""
    weight, middle = 2200 * 9.81 * volumes(specimen.blocks), centroids(specimen.blocks)
    way = np.radians(70.0) * (1 - 2 * np.arange(8) / 15)
    ends = [r * np.stack([np.sin(way), np.cos(way)], axis=1) for r in (1.9, 2.1)]
    return 2 * greatest_crown_load(weight[:7], -middle[:7, 0], 0.5 * weight[7], *ends)


def test_the_keystone_bears_what_a_line_of_thrust_does():
    limit = masonry.limit("arch-own-weight")
    assert 1e3 * limit.factor == pytest.approx(by_hand(limit.specimen), rel=1e-6)


@pytest.mark.parametrize(("share", "stands"), [(0.98, True), (1.02, False)])
def test_a_simulation_stands_below_that_load_and_falls_above_it(share, stands):
    """The load as a pressure on the upper face of a keystone that is level there."""
    load = share * 1e3 * masonry.limit("arch-own-weight").factor
    area = 0.5 * 2 * 2.1 * float(np.sin(np.radians(70.0) / 15))
    knobs = {"traction": [{"on": "keystone.z+", "stress": {"z": f"{-load / area!r} Pa"}}], "settle.steps": 60000}
    try:
        summary = masonry.run(masonry.load("arch-own-weight", knobs)).summary
    except Stopped:
        assert not stands
        return
    assert (summary["stopped"] == "" and summary["unbalanced_after_settling"] < 1e-3) == stands
