"""Walls that people build, by limit analysis against closed forms, and by simulation against limit analysis."""

from math import tan

import numpy as np
import pytest

import masonry
from geometry.polyhedra.measures import centroids, volumes

STRIP = 0.375
"""Tangent of the tilt at which the packaged strip between floors falls, in closed form."""


def strip_by_hand(slender: float, courses: int, overburden: float) -> float:
    """Least over the joint that opens, at a share a/h of the height: (2 t/h) ((1 + psi) h/a + psi h/(h - a))."""
    at = np.arange(1, courses) / courses
    return float((2 * slender * ((1 + overburden) / at + overburden / (1 - at))).min())


@pytest.mark.parametrize(
    ("height", "courses", "overburden"), [("2 m", 10, 0.5), ("1.2 m", 6, 1.0), ("3.2 m", 16, 0.25)]
)
def test_a_strip_between_floors_falls_by_its_three_hinges(height, courses, overburden):
    tall = float(height[:-2])
    density = 2000.0 * overburden * tall / 0.1
    scene = masonry.load(
        "wall-out-of-plane", {"specimen.height": height, "material.plates.density": f"{density!r} kg/m^3", "gauge": []}
    )
    assert masonry.limit(scene).factor == pytest.approx(strip_by_hand(0.1 / tall, courses, overburden), rel=1e-6)


def test_the_packaged_strip_has_the_published_factor():
    assert strip_by_hand(0.05, 10, 0.5) == pytest.approx(STRIP, abs=1e-12)
    assert masonry.limit("wall-out-of-plane").factor == pytest.approx(STRIP, rel=1e-6)


def test_a_wall_that_stands_free_falls_at_its_thickness_over_its_height():
    free = {"specimen.beam": None, "support": [{"on": "base", "fix": "all"}]}
    assert masonry.limit(masonry.load("wall-out-of-plane", free)).factor == pytest.approx(0.1 / 2.0, rel=1e-6)


def test_returns_hold_a_facade_that_would_fall_where_its_weight_passes_its_edge():
    alone = masonry.limit(masonry.load("facade-tilted", {"specimen.returns": "none", "specimen.return_length": None}))
    blocks = alone.specimen.blocks
    up = np.isin(np.array(blocks.groups)[blocks.group], ["units", "lintels"])
    weight = volumes(blocks)[up]
    height = (centroids(blocks)[up, 2] * weight).sum() / weight.sum()
    assert alone.factor == pytest.approx(0.15 / height, rel=1e-6), "it turns about its front edge"
    assert masonry.limit("facade-tilted").factor > 2.0 * alone.factor


@pytest.mark.slow
def test_a_strip_falls_in_a_simulation_at_the_tilt_of_its_hinges_the_nearer_the_stiffer_its_joints():
    errors = []
    for stiffness in (0.1, 1.0, 10.0):
        knobs = {f"contact.default.{key}": f"{share * stiffness!r} GPa/m" for key, share in
                 (("normal_stiffness", 1.0), ("shear_stiffness", 0.4))}  # fmt: skip
        fallen = masonry.run(masonry.load("wall-out-of-plane", {**knobs, "solver.duration": "20 s"})).summary[
            "collapse"
        ]
        errors.append(tan(fallen["began"]["tilt_rad"]) / STRIP - 1.0)
    assert errors[0] < errors[1] - 0.02, "soft joints let it bulge and fall early"
    assert abs(errors[2]) < 0.02


@pytest.mark.slow
def test_a_wall_with_a_window_bears_what_limit_analysis_allows_and_not_much_less():
    peak = masonry.run("wall-with-window").summary["peak_force_n"]
    most = masonry.limit("wall-with-window").factor
    assert 0.94 * most < peak < most, "friction that does not dilate bears less"


@pytest.mark.slow
def test_a_facade_falls_before_the_tilt_that_limit_analysis_allows():
    fallen = masonry.run("facade-tilted").summary["collapse"]
    most = masonry.limit("facade-tilted").factor
    assert 0.8 * most < abs(tan(fallen["began"]["tilt_rad"])) < most, "friction that does not dilate bears less"
