"""A beam on two rough joints, whose weight is shared out by how stiffly these turn: by two points and by three."""

import pytest

import masonry
from masonry.limit_analysis import corner_points
from tests.scenes import box, listed, load, specimen, tables

WIDE, APART, ROUGH, SMOOTH = 0.4, 0.3, 0.8, 0.2
LEFT, LONG, THICK, HIGH = 0.5, 1.2, 0.4, 0.3
WEIGHT = 2000.0 * 9.81 * LONG * THICK * HIGH
"""N."""


def beam(rough: float, smooth: float):
    """Pushed along its two joints by 1 kN times a factor, in their plane, so that the push turns nothing."""
    boxes = [
        box("l", (-APART - 0.5 * WIDE, 0.0, -0.2), (WIDE, THICK, 0.2), "rough", 0),
        box("r", (APART - 0.5 * WIDE, 0.0, -0.2), (WIDE, THICK, 0.2), "smooth", 1),
        box("b", (-LEFT, 0.0, 0.0), (LONG, THICK, HIGH), "units", 2),
    ]
    dry = 'law = "friction"\nnormal_stiffness = "20 GPa/m"\nshear_stiffness = "8 GPa/m"\ntan_friction_angle = '
    return load(
        'kinematics = "rigid"\n'
        + specimen(boxes, 0.16)
        + tables("material", dict.fromkeys(("rough", "smooth", "units"), 'density = "2000 kg/m^3"'))
        + tables("contact", {"rough_units": f"{dry}{rough}", "smooth_units": f"{dry}{smooth}"})
        + listed("support", [f'on = "{name}"\nfix = "all"' for name in "lr"])
        + '[gravity]\nz = "-9.81 m/s^2"\n[limit]\npattern = "force"\non = "b"\nat = ["0.1 m", "0.2 m", "0 m"]\n'
        '[limit.force]\nx = "1 kN"\n'
    )


def by_hand(rough: float, smooth: float, times: float) -> float:
    """The push over 1 kN, where joints turn so many times as stiffly as their areas do."""
    off_middle = 0.5 * LONG - LEFT
    more = WEIGHT * off_middle / (APART + times * WIDE**2 / (12.0 * APART))
    return (0.5 * (rough + smooth) * WEIGHT - 0.5 * (rough - smooth) * more) / 1e3


def test_a_factor_by_points_at_the_corners_says_what_it_is_by_joints_that_turn_as_their_areas():
    result = masonry.limit(beam(ROUGH, SMOOTH), dilation=False)
    two, three = by_hand(ROUGH, SMOOTH, 3.0), by_hand(ROUGH, SMOOTH, 1.0)
    assert result.factor == pytest.approx(two, rel=1e-3) and 1.0 - three / two > 0.04
    (line,) = [line for line in result.remarks if "corners alone" in line]
    told = float(line.split("the factor is ")[1].split(",")[0])
    assert told == pytest.approx(three, rel=1e-3) and f"{100.0 * (1.0 - three / two):.2g} % less" in line
    again = masonry.limit(
        beam(ROUGH, SMOOTH).with_({"specimen.contact_points": "vertex", "specimen.points_per_edge": 3}),
        dilation=False,
        points="scene",
    )
    assert again.factor == pytest.approx(three, rel=1e-3)
    assert not any("corners alone" in line for line in again.remarks)


def test_joints_of_one_friction_slide_alike_however_stiffly_they_turn():
    result = masonry.limit(beam(0.5, 0.5), dilation=False)
    assert result.factor == pytest.approx(by_hand(0.5, 0.5, 1.0), rel=1e-3)
    assert not any("corners alone" in line for line in result.remarks)


def test_what_would_take_long_is_not_asked_but_named(monkeypatch):
    monkeypatch.setattr(corner_points, "MOST", 10)
    (line,) = [r for r in masonry.limit(beam(ROUGH, SMOOTH), dilation=False).remarks if "corners alone" in r]
    assert "was not asked" in line and "points_per_edge=3" in line
