"""Arches without strength against limit equilibrium by hand: a line of thrust within the arch, least and greatest."""

import re
from functools import cache

import numpy as np
import pytest

from masonry import scene
from masonry.errors import SceneError
from masonry.judgement.judgement import judgement_of
from masonry.laboratory import laboratory
from masonry.laboratory.result import Result
from verification.fixtures.arches import Arch, greatest_thrust, least_thrust

WEIGHT = 2000 * 9.81 * 0.3
"""N/m2: density, g and depth of the packaged arch, whose radius is 1 m."""
DEFORMABLE = (("material.units.young_modulus", "20 GPa"), ("material.units.poisson_ratio", 0.2))


@cache
def run(name: str, *overrides: tuple[str, object]) -> Result:
    return laboratory.run(scene.load(name, dict(overrides)))


def at_the_end(result: Result, column: str) -> np.ndarray:
    return result.resultants[column][result.resultants["moment"] == "end"]


def by_hand() -> tuple[float, tuple[int, int]]:
    """Least thrust (N) of the packaged arch and its two joints, counted from the left abutment: hinges at the outer
    end of the upper and the inner end of the lower one, tried one by one."""
    way = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 16)
    inner, outer = (r * np.stack([np.sin(way), np.cos(way)], axis=1) for r in (0.925, 1.075))
    area = 0.5 * np.sin(np.pi / 15) * (1.075**2 - 0.925**2)
    middle = 2 / 3 * np.cos(np.pi / 30) * (1.075**3 - 0.925**3) / (1.075**2 - 0.925**2)
    x = middle * np.sin(0.5 * (way[:-1] + way[1:]))
    best = (0.0, (0, 0))
    for lower in range(7):
        for upper in range(lower + 1, 8):
            turning = area * (7.5 - upper) * (outer[upper, 0] - inner[lower, 0])
            turning += area * (x[lower:upper] - inner[lower, 0]).sum()
            best = max(best, (WEIGHT * turning / (outer[upper, 1] - inner[lower, 1]), (lower, upper)))
    return best


def test_the_thrusts_by_hand_are_those_of_the_literature_and_of_each_other():
    assert least_thrust(Arch(20, 0.12)) == pytest.approx(0.07179, abs=5e-6)
    assert by_hand()[0] == pytest.approx(WEIGHT * least_thrust(Arch(15, 0.15)), rel=1e-12)


def test_under_its_own_weight_the_line_of_thrust_lies_in_the_arch_between_least_and_greatest():
    result = run("arch")
    thrust = result.summary["reactions"]["end"]["support.0"]["force_n"][0]
    assert WEIGHT * least_thrust(Arch(15, 0.15)) < thrust < WEIGHT * greatest_thrust(Arch(15, 0.15))
    assert at_the_end(result, "eccentricity").max() <= 1.0 + 1e-9
    assert np.abs(at_the_end(result, "force_x")) == pytest.approx(np.full(16, thrust), rel=1e-9), "in every joint"
    balance = result.summary["reactions"]["end"]
    assert np.abs(balance["sum"]["force_n"]).max() < 1e-9 * thrust
    assert np.abs(balance["sum"]["moment_nm"]).max() < 1e-9 * thrust


def test_an_abutment_that_gives_way_brings_the_least_thrust_with_hinges_where_statics_has_them():
    result, (least, (lower, upper)) = run("arch-spread"), by_hand()
    assert result.history.rows["force"][-1] == pytest.approx(least, rel=1e-9)
    units = np.stack([at_the_end(result, "unit_a"), at_the_end(result, "unit_b")], axis=1)
    assert units[1:3].tolist() == [[0, 15], [1, 2]], "a springing, and then joints between voussoirs"
    eccentricity = {tuple(pair): e for pair, e in zip(units.tolist(), at_the_end(result, "eccentricity"), strict=True)}
    hinges = sorted(pair for pair, e in eccentricity.items() if e > 1.0 - 1e-9)
    joints = (lower, upper, 15 - upper, 15 - lower)
    assert hinges == sorted((k - 1, k) for k in joints)


@pytest.mark.parametrize("kinematics", ["affine", "tets"])
def test_deformable_voussoirs_have_the_same_least_thrust(kinematics):
    more = (("kinematics", kinematics), ("specimen.mesh", "fan"), ("drive.history", ("-0.1 mm",)), *DEFORMABLE)
    assert run("arch-spread", *more).history.rows["force"][-1] == pytest.approx(by_hand()[0], rel=1e-6)


@pytest.mark.parametrize(
    "overrides",
    [
        (),
        (("drive.history", ("1 mm",)),),
        (("specimen.voussoirs", 7), ("specimen.angle", "157.5 deg")),
        (("specimen.voussoirs", 8), ("specimen.angle", "100 deg"), ("specimen.thickness", "200 mm")),
    ],
    ids=["packaged", "pushed in", "seven", "flat"],
)
def test_a_dry_arch_is_quasi_static_and_only_points_at_the_edges_of_one_that_is_pushed_in_are_doubted(overrides):
    """Pushed in it bears 4 % less with 16 points along each edge."""
    summary = run("arch-spread", *overrides).summary
    assert summary["kinetic_over_internal_max"] < 0.01 and summary["damping_over_external"] >= 0.0
    is_pushed_in = overrides == (("drive.history", ("1 mm",)),)
    assert [doubt.name for doubt in judgement_of(summary).doubts] == ["few_points"] * is_pushed_in


def test_an_arch_at_rest_without_slip_is_not_doubted_for_rounding():
    flat = (("specimen.voussoirs", 8), ("specimen.angle", "100 deg"), ("specimen.thickness", "200 mm"))
    summary = run("arch", *flat, ("specimen.points_per_edge", 2)).summary
    assert summary["joints_opened_or_slid"] == 0
    assert [doubt.name for doubt in judgement_of(summary).doubts] == ["closed_joints"], "two points along an edge"
    assert summary["kinetic_over_internal_max"] is None and summary["damping_over_external"] is None, (
        "nothing drives it"
    )
    assert summary["not_measured"] == []


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        ("voussoirs", 1, "must be in [2, 1000]"),
        ("angle", "181 deg", "must be in (0, 180] deg"),
        ("thickness", "1 m", "must be less than radius, 1 m"),
        ("radius", "1", "has no unit"),
    ],
)
def test_a_scene_of_an_arch_that_cannot_be_is_refused_by_its_key(key, value, message):
    with pytest.raises(SceneError, match=f"specimen.{key}: .*{re.escape(message)}"):
        scene.load("arch", {f"specimen.{key}": value})
