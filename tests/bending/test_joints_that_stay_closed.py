"""A block on a joint that stays closed, pushed sideways, against its tip by hand: what is off is told, and how much."""

import numpy as np
import pytest

import masonry
from masonry.judgement.judgement import judgement_of
from masonry.laboratory import laboratory
from tests.scenes import load

SIDE, HEIGHT, STIFFNESS, PUSH = 1.0, 4.0, 1e9, 1e3
LIMIT = 0.02
TURNS = PUSH * HEIGHT * (HEIGHT / 2.0) / (STIFFNESS * SIDE**4 / 12.0)
TIP = PUSH * HEIGHT / STIFFNESS + TURNS * HEIGHT


def cantilever(displacements: str, points: str = "", law: str = "elastic", more: str = ""):
    """A block 1 x 1 x 4 m on a held base, 1 kPa on its side."""
    return load(
        f"""
displacements = "{displacements}"
law = "{law}"
[specimen]
kind = "boxes"
section = "1 m^2"
{points}
[[specimen.box]]
name = "base"
origin = ["-1 m", "-1 m", "-1 m"]
size = ["3 m", "3 m", "1 m"]
unit = 0
[[specimen.box]]
name = "block"
origin = ["0 m", "0 m", "0 m"]
size = ["1 m", "1 m", "4 m"]
unit = 1
[material.units]
density = "2000 kg/m^3"
young_modulus = "10 GPa"
poisson_ratio = 0.2
[contact.{"default" if displacements == "large" else "unit_unit"}]
normal_stiffness = "1 GPa/m"
shear_stiffness = "1 GPa/m"
tan_friction_angle = 0.7
[[support]]
on = "base"
fix = "all"
[[traction]]
on = "block.x-"
stress = {{ x = "1 kPa" }}
[[gauge]]
name = "top"
at = "block.z+"
direction = "x"
{more}
"""
    )


def points(rule: str, along: int) -> str:
    return f'contact_points = "{rule}"\npoints_per_edge = {along}'


def said(summary: dict) -> float:
    """By what share movements are said to be too small; 0 without a word."""
    return max((doubt.value for doubt in judgement_of(summary).doubts if doubt.name == "closed_joints"), default=0.0)


ALL = [
    ("", 0.0),
    (points("vertex", 2), 2.0),
    *((points("vertex", n), 0.0) for n in (3, 4, 12)),
    *((points("gauss", n), 0.0) for n in (2, 3, 4)),
]
"""Points, and by how much more than 1 their second moment is over that of the area."""


@pytest.mark.parametrize("displacements", ["small", "large"])
@pytest.mark.parametrize(("where", "more"), ALL)
def test_the_tip_is_off_by_what_is_told(displacements, where, more):
    summary = laboratory.run(cantilever(displacements, where)).summary
    tip = summary["gauges"]["top"]["final_m"]
    assert tip == pytest.approx(PUSH * HEIGHT / STIFFNESS + TURNS * HEIGHT / (1.0 + more), rel=2e-3)
    off = 1.0 - tip / TIP
    assert said(summary) == pytest.approx(off if off > LIMIT else 0.0, abs=0.01)
    assert (judgement_of(summary).verdict == "sound") == (off < LIMIT)


WEIGHT = '[gravity]\nz = "-9.81 m/s^2"\n'


@pytest.mark.parametrize(("where", "off"), [(points("vertex", 2), 0.66), (points("gauss", 2), 0.0)])
def test_a_dry_joint_that_its_weight_keeps_closed_is_told_as_a_glued_one(where, off):
    summary = laboratory.run(cantilever("small", where, "friction", WEIGHT)).summary
    tip = summary["gauges"]["top"]["final_m"]
    assert 1.0 - tip / TIP == pytest.approx(off, abs=0.01)
    assert said(summary) == pytest.approx(off, abs=0.02)


def test_a_block_that_is_pressed_evenly_hardly_bends_its_joint():
    scene = cantilever("small", points("vertex", 2), more=WEIGHT).with_({"traction": []})
    assert said(laboratory.run(scene).summary) == 0.0


@pytest.mark.parametrize(
    ("displacements", "where", "share"), [(one, points("vertex", 2), 65) for one in ("large", "small")]
)
def test_check_foretells_it(displacements, where, share):
    (line,) = laboratory.check(cantilever(displacements, where)).warnings
    assert f"about {share} % too small" in line
    assert not laboratory.check(cantilever(displacements, points("gauss", 2))).warnings


@pytest.mark.parametrize("along", [2])
def test_modes_say_by_how_much_the_frequency_is_too_high(along):
    exact = masonry.modes(cantilever("small", points("gauss", 2)), 1)
    assert not exact.remarks
    modes = masonry.modes(cantilever("small", points("vertex", along)), 1)
    (remark,) = modes.remarks
    off = float(modes.frequencies[0] / exact.frequencies[0] - 1.0)
    share = float(remark.split("by about ")[1].split(" %")[0]) / 100.0
    assert share == pytest.approx(off, abs=0.015) and np.isfinite(off)
