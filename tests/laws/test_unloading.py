"""Opening, closing, compressing and opening again: secant to the origin, or elastic with an opening that stays."""

import numpy as np
import pytest

from verification.fixtures.one_contact import along, law, walk
from verification.references.closed_forms import LAWS, Joint, dissipated_in_tension, tension, unloaded

UM = 1e-6
CYCLE = np.array([0.0, 20.0, 0.0, -8.0, 0.0, 20.0, 40.0]) * UM


def cycled(name, corners, **changes):
    corners = np.asarray(corners)
    return walk(law(name, **changes), along(np.outer(corners, [0.0, 0.0, 1.0]), 0.1 * UM))


@pytest.mark.parametrize("coupling", ["combined", "independent"])
@pytest.mark.parametrize("unloading", ["secant", "elastic"])
@pytest.mark.parametrize("name", LAWS)
def test_the_cycle_follows_the_closed_form_to_round_off(name, unloading, coupling):
    trace = cycled(name, CYCLE, unloading=unloading, coupling=coupling)
    opening = trace.path[:, 2]
    first = int(np.argmax(opening >= 20 * UM)) + 1
    wanted = np.concatenate(
        [tension(name, Joint(), opening[:first]), unloaded(name, Joint(), opening[first:], 20 * UM, unloading)]
    )
    np.testing.assert_allclose(trace.sigma, wanted, rtol=1e-12, atol=1e-12 * 0.58e6)


@pytest.mark.parametrize("unloading", ["secant", "elastic"])
@pytest.mark.parametrize("name", LAWS)
def test_a_contact_torn_and_closed_has_its_full_stiffness_in_compression(name, unloading):
    trace = cycled(name, [0.0, 20 * UM, -1 * UM, -8 * UM], unloading=unloading)
    assert np.diff(trace.sigma)[-50:] / np.diff(trace.path[:, 2])[-50:] == pytest.approx(150e9, rel=1e-9)


@pytest.mark.parametrize("name", LAWS)
def test_nothing_is_spent_and_everything_is_given_back_on_the_way_down_and_up(name):
    trace = cycled(name, CYCLE)
    opening = trace.path[:, 2]
    first = int(np.argmax(opening >= 20 * UM))
    again = first + 1 + int(np.argmax(opening[first + 1 :] >= 20 * UM))
    assert np.ptp(trace.dissipated[first:again]) == 0.0
    assert trace.work[again] == pytest.approx(trace.work[first], rel=1e-9)
    assert trace.dissipated[again] == pytest.approx(dissipated_in_tension(name, Joint(), 20 * UM), rel=1e-12)
    assert trace.dissipated[-1] == pytest.approx(dissipated_in_tension(name, Joint(), 40 * UM), rel=1e-12)


@pytest.mark.parametrize("unloading", ["secant", "elastic"])
@pytest.mark.parametrize("name", LAWS)
def test_a_contact_stores_what_it_gives_back(name, unloading):
    trace = cycled(name, [0.0, 8 * UM], unloading=unloading)
    top = float(tension(name, Joint(), 8 * UM))
    recoverable = 0.5 * top * 8 * UM if unloading == "secant" else 0.5 * top**2 / 150e9
    assert trace.stored[-1] == pytest.approx(recoverable, rel=1e-9, abs=1e-15)
    pressed = cycled(name, [0.0, -2 * UM], unloading=unloading)
    assert pressed.stored[-1] == pytest.approx(0.5 * 150e9 * (2 * UM) ** 2, rel=1e-12)


@pytest.mark.parametrize("unloading", ["secant", "elastic"])
@pytest.mark.parametrize("name", LAWS)
def test_many_cycles_cost_no_more_than_one(name, unloading):
    once = cycled(name, [0.0, 12 * UM], unloading=unloading)
    often = cycled(name, [0.0, *[12 * UM, -4 * UM] * 5, 12 * UM], unloading=unloading)
    assert often.sigma[-1] == pytest.approx(once.sigma[-1], rel=1e-12, abs=1e-6)
    assert often.dissipated[-1] == pytest.approx(once.dissipated[-1], rel=1e-12)


def test_a_contact_without_tensile_strength_opens_without_stress_and_bears_on_closing():
    for name in LAWS:
        trace = cycled(name, CYCLE, tensile_strength=0.0)
        np.testing.assert_allclose(trace.sigma, 150e9 * np.minimum(trace.path[:, 2], 0.0), rtol=1e-14)
        assert not trace.dissipated.any()
        assert np.isfinite(trace.stored).all()


def test_within_the_elastic_limit_nothing_is_remembered():
    for name in LAWS:
        trace = cycled(name, [0.0, 3.8 * UM, -3 * UM, 3.8 * UM])
        assert not trace.dissipated.any()
        assert np.all(trace.intact_n == 1.0)
        np.testing.assert_allclose(trace.sigma, 150e9 * trace.path[:, 2], rtol=1e-14)
