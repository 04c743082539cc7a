"""What bars are tightened to counts where joints do not dilate: by hand, by runs, and at the angle of a tilt."""

import numpy as np
import pytest

import masonry
from masonry.errors import SceneError
from masonry.scene import Scene
from tests.limit.one_block import STRONG, block
from tests.scenes import load

SIZE = '["2 m", "0.3 m", "0.2 m"]'
WEIGHT, FRICTION, BED, JOINT = 2400.0, 0.7, 0.6, 30e9
"""N, tangent, m2, Pa/m: of the flat block on the ground, and of its bed."""
SIDEWAYS = '[limit]\npattern = "weight"\ndirection = "x"'
TILT = '[limit]\npattern = "tilt"\nabout = "y"'


def bar(pretension: float, foot: float = 1.0, modulus: str = "20 GPa") -> str:
    """From the middle of the block down into the ground, 1 m long where it is upright: 2 MN/m by 20 GPa."""
    return (
        f'[[bar]]\nends = [["1 m", "0.15 m", "0.1 m"], ["{foot} m", "0.15 m", "-0.9 m"]]\narea = "1 cm^2"\n'
        f'young_modulus = "{modulus}"\npretension = "{pretension} N"\n'
    )


def anchored(pretension: float, load_words: str, **words: str) -> Scene:
    """The flat block on its bar."""
    return load(block(bar(pretension, **words) + load_words, size=SIZE))


def left_of(pretension: float, stiffness: float, weight: float = WEIGHT) -> float:
    """N in an upright bar, once the bed has closed by what presses on it."""
    bed = JOINT * BED
    return (pretension * bed - stiffness * weight) / (bed + stiffness)


@pytest.mark.parametrize(("pretension", "modulus", "stiffness"), [(0.0, "20 GPa", 2e6), (700.0, "20 GPa", 2e6),
                                                                  (3000.0, "200 TPa", 2e10)])  # fmt: skip
def test_an_upright_bar_presses_the_bed_by_what_its_ends_leave_of_its_pretension(pretension, modulus, stiffness):
    result = masonry.limit(anchored(pretension, SIDEWAYS, modulus=modulus), dilation=False)
    pulls = max(left_of(pretension, stiffness), 0.0)
    assert result.factor == pytest.approx(FRICTION * (1.0 + pulls / WEIGHT), rel=2e-5)
    assert result.elements[0].force[0] == pytest.approx(pulls, abs=1e-2)
    assert result.with_dilation == np.inf, "a block that rises as it slides stretches its bar without end"


def test_a_bar_that_leans_holds_and_presses_until_it_yields():
    """It leans by 0.5 against the push, and bears at most 900 N; without an end to that there is no limit."""
    scene = anchored(700.0, SIDEWAYS, foot=0.5)
    with pytest.raises(SceneError, match="there is no limit"):
        masonry.limit(scene, dilation=False)
    result = masonry.limit(scene.with_({"bar.0.strength": "9 MPa"}), dilation=False)
    down, back = np.array([1.0, 0.5]) / np.hypot(1.0, 0.5)
    assert result.factor == pytest.approx(FRICTION + 900.0 * (FRICTION * down + back) / WEIGHT, rel=1e-4)
    assert result.elements[0].force[0] == pytest.approx(900.0, rel=1e-6)


def test_a_run_bears_the_same():
    scene = anchored(700.0, SIDEWAYS)
    factor = masonry.run(scene.with_({"limit.accuracy": 0.004, "settle": {"steps": 4000}})).summary["collapse_load"]
    assert factor["borne"] <= masonry.limit(scene, dilation=False).factor * 1.0005 <= factor["falls"] * 1.001


def test_the_factor_of_safety_is_by_the_same_pressure():
    """Whatever friction is left, a bar that dilation stretches would hold: so there is no factor beside it."""
    result = masonry.limit(anchored(700.0, SIDEWAYS), safety=True, at=0.3, dilation=False)
    by_hand = FRICTION * (1.0 + left_of(700.0, 2e6) / WEIGHT) / 0.3
    assert result.factor == pytest.approx(by_hand, rel=3e-4) and result.with_dilation == np.inf
    assert "none: joints that dilate balance it with the least friction" in str(result)


def angle(holds: float, presses: float) -> float:
    """The tangent of the angle at which W sin = mu (W cos + presses) + holds, by halving."""
    low, high = 0.0, 0.5 * np.pi
    for _ in range(60):
        middle = 0.5 * (low + high)
        slides = WEIGHT * np.sin(middle) > FRICTION * (WEIGHT * np.cos(middle) + presses) + holds
        low, high = (low, middle) if slides else (middle, high)
    return float(np.tan(low))


@pytest.mark.parametrize("pretension", [0.0, 500.0])
def test_a_tilt_with_bars_ends_at_the_angle_by_hand(pretension):
    """The weight that closes the bed is what is left of it across the bed."""
    result = masonry.limit(anchored(pretension, TILT), dilation=False)
    cosine = np.cos(np.arctan(result.factor))
    pulls = max(left_of(pretension, 2e6, WEIGHT * cosine), 0.0)
    assert result.factor == pytest.approx(angle(0.0, pulls), rel=2e-4)
    assert result.elements[0].force[0] == pytest.approx(pulls, abs=0.2), "in newtons at the angle itself"


def test_a_tilt_with_cohesion_ends_where_it_does_with_dilation():
    """One joint slides: how far it rises makes no difference."""
    weak = STRONG.replace("100 kPa", "0.5 kPa").replace('"4 kPa"', '"0.1 kPa"')
    scene = load(block(TILT, weak, size=SIZE))
    result = masonry.limit(scene, dilation=False)
    assert result.factor == pytest.approx(angle(500.0 * BED, 0.0), rel=2e-4)
    assert result.with_dilation == pytest.approx(masonry.limit(scene).factor)


def test_no_friction_holds_what_nothing_presses():
    """A stone between two walls: with dilation the least friction is enough if it is jammed; without it falls."""
    stone = """  {name = "left", origin = ["2.1 m", "0 m", "-1 m"], size = ["0.2 m", "0.3 m", "2 m"], unit = 2},
  {name = "stone", origin = ["2.3 m", "0 m", "0.3 m"], size = ["0.5 m", "0.3 m", "0.4 m"], unit = 3},
  {name = "right", origin = ["2.8 m", "0 m", "-1 m"], size = ["0.2 m", "0.3 m", "2 m"], unit = 4},
]
[material"""
    supports = "".join(f'[[support]]\non = "{name}"\nfix = "all"\n' for name in ("left", "right"))
    scene = load(block(supports).replace("]\n[material", stone))
    with pytest.raises(SceneError, match="stands only if it is jammed: the least friction is enough"):
        masonry.limit(scene, safety=True)
    with pytest.raises(SceneError, match="no amount of friction makes it stand without dilation"):
        masonry.limit(scene, safety=True, dilation=False)
