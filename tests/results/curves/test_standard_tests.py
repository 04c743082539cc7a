"""Strength and modulus by EN 1052-1 and ASTM E519, by hand, from a run, and what does not fit."""

import numpy as np
import pytest

from masonry import scene
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.rows.standard_test import compression, diagonal_compression

FORCE = np.array([0.0, 30e3, 90e3, 60e3])
SHORTER, WIDER = np.array([0.0, 0.1e-3, 0.5e-3, 1e-3]), np.array([0.0, 0.02e-3, 0.1e-3, 1e-3])


def test_compression_by_hand():
    strength, modulus, strain = compression(FORCE, SHORTER, area=0.01, length=0.2)
    assert (strength, strain, modulus) == pytest.approx((9e6, 5e-4, 6e9))


def test_diagonal_compression_by_hand():
    strength, modulus, strain = diagonal_compression(FORCE, SHORTER, WIDER, area=0.1, length=1.0)
    assert (strength, strain) == pytest.approx((0.7071 * 90e3 / 0.1, 0.12e-3), rel=1e-4)
    assert modulus == pytest.approx(0.7071 * 30e3 / 0.1 / 0.12e-3, rel=1e-4)


def test_a_curve_that_never_rises_has_no_modulus():
    assert compression(np.zeros(3), np.zeros(3), 0.01, 0.2)[1:] == (None, None)


def test_a_prism_has_the_strength_of_its_joints_and_the_modulus_of_courses_in_a_row():
    summary = laboratory.run(scene.load("prism-in-compression")).summary
    assert summary.standard.strength_pa == pytest.approx(10.5e6, rel=2e-3)
    by_hand = 62.0 / (62.0 / 16.7e9 + 1.0 / 0.082e9)
    assert summary.standard.modulus_pa == pytest.approx(by_hand, rel=0.03), "the platens confine, the cap hardens"


@pytest.mark.parametrize(
    ("scene_name", "changes", "message"),
    [
        ("prism-in-compression", {"standard.shortening": "shorter"}, "standard.shortening: 'shorter' is no gauge"),
        ("prism-in-compression", {"standard.extension": "shortening"}, "belongs to ASTM E519"),
        ("prism-in-compression", {"standard.test": "EN 1052"}, "allowed: EN 1052-1, ASTM E519"),
        ("diagonal-compression", {"standard.area": None}, "standard.area: missing"),
        ("diagonal-compression", {"specimen.shoes": "2 m"}, "longer than the wall"),
        ("diagonal-compression", {"specimen.beam": "50 mm"}, "shoes take the place"),
    ],
)
def test_what_does_not_fit_is_told(scene_name, changes, message):
    from masonry.assembly.assemble import joined

    with pytest.raises((SceneError, ValueError), match=message):
        joined(scene.load(scene_name, changes))
