"""The closed form of cycles in shear: one way it is the envelope, and its energy is its work less what it stores."""

import numpy as np
import pytest

from verification.references.closed_forms import Joint, dissipated_in_shear, shear
from verification.references.cyclic_forms import Sheared, followed, legs

JOINT, COMPRESSION = Joint(), 0.5e6
LAWS = ("linear", "polynomial", "exponential")
TURNS = (60e-6, -60e-6, 30e-6, -150e-6, 150e-6, 0.0)


def path(points: int) -> np.ndarray:
    """Places (m) through the turns."""
    ends = [0.0, *TURNS]
    return np.concatenate([np.linspace(a, b, points + 1)[1:] for a, b in zip(ends[:-1], ends[1:], strict=True)])


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("variable", ["displacement", "plastic"])
def test_one_way_it_is_the_envelope_and_its_energy(law, variable):
    places = np.linspace(0.0, 100e-6, 501)[1:]
    stress, gone = followed(Sheared(law, JOINT, COMPRESSION, variable), places)
    if variable == "displacement":
        assert stress == pytest.approx(shear(law, JOINT, places, COMPRESSION), rel=1e-12)
        assert gone == pytest.approx(dissipated_in_shear(law, JOINT, places, COMPRESSION), rel=1e-9, abs=1e-9)
    else:
        us0 = float(JOINT.peak(COMPRESSION)) / JOINT.ks
        slid = np.maximum(places - stress / JOINT.ks, 0.0)
        on = places > us0
        assert stress[on] == pytest.approx(shear(law, JOINT, us0 + slid[on], COMPRESSION), rel=1e-6)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("variable", ["displacement", "plastic"])
def test_the_energy_gone_is_the_work_less_what_is_stored(law, variable):
    places = path(20_000)
    stress, gone = followed(Sheared(law, JOINT, COMPRESSION, variable), places)
    before = np.concatenate([[0.0], stress[:-1]])
    work = np.cumsum(0.5 * (stress + before) * np.diff(places, prepend=0.0))
    assert gone == pytest.approx(work - 0.5 * stress**2 / JOINT.ks, abs=1e-5 * gone[-1])
    assert np.min(np.diff(gone)) >= -1e-9 * gone[-1]


def test_legs_end_at_the_turns():
    places = path(7)
    assert [places[leg][-1] for leg in legs(places)] == pytest.approx(TURNS, abs=1e-18)
