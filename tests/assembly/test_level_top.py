"""A top that stays level, free to rise: a dry wall then rocks on two corners and needs twice the moment to turn."""

import pytest

from masonry.laboratory import laboratory
from tests.scenes import load

LENGTH, HEIGHT, BEAM, PRESSURE = 0.4, 1.0, 0.1, 0.3e6
LOAD = PRESSURE * LENGTH * 0.1
"""N, on the beam; units and beam themselves have no weight here."""
DRY = 'law = "friction"\nnormal_stiffness = "100 GPa/m"\nshear_stiffness = "40 GPa/m"\ntan_friction_angle = 0.65\n'


def pier(fix: str):
    """Five dry units one above the other between a base and a beam, which is loaded and pushed along x."""
    return load(
        f"""
[specimen]
kind = "wallette"
courses = 5
units_per_course = 1
unit_length = "{LENGTH} m"
unit_height = "{HEIGHT / 5} m"
thickness = "100 mm"
bond = "stack"
base = "100 mm"
beam = "{BEAM} m"
contact_points = "vertex"
[material.units]
density = "1800 kg/m^3"
[material.plates]
density = "2400 kg/m^3"
[contact.unit_unit]
{DRY}
[contact.plate]
{DRY}
[[support]]
on = "base"
fix = "all"
[[support]]
on = "beam"
fix = {fix}
[[traction]]
on = "beam.z+"
stress = {{z = "{-PRESSURE} Pa"}}
[settle]
steps = 2000
[drive]
on = "beam"
direction = "x"
displacement = "0.3 mm"
accuracy = "0.5 %"
"""
    )


@pytest.fixture(scope="module")
def level():
    return laboratory.run(pier('["y", "rotation"]'))


@pytest.fixture(scope="module")
def free():
    return laboratory.run(pier('"y"'))


def test_under_a_level_top_the_wall_turns_about_opposite_corners(level):
    force = LOAD * LENGTH / HEIGHT
    assert level.history.rows["force"][-1] == pytest.approx(force, rel=1e-9)
    assert level.summary["peak_force_n"] == pytest.approx(force, rel=0.01)


def test_with_a_free_top_it_turns_about_the_corner_at_its_foot(free):
    force = LOAD * LENGTH / 2 / (HEIGHT + BEAM / 2)  # the drive acts in the middle of the beam
    assert free.history.rows["force"][-1] == pytest.approx(force, rel=1e-9)
    assert free.summary["peak_force_n"] == pytest.approx(force, rel=0.01)


def test_a_level_top_takes_twice_the_moment(level, free):
    ends = [run.history.rows["force"][-1] * arm for run, arm in ((level, HEIGHT), (free, HEIGHT + BEAM / 2))]
    assert ends[0] == pytest.approx(2 * ends[1], rel=1e-9)


def test_the_level_top_rises_by_what_the_wall_turns(level):
    """Once the wall rocks its forces stay as they are, and the top moves as its two corners have it, not otherwise."""
    beam = level.specimen.sets["beam"][0]
    corners = slice(8 * beam, 8 * beam + 8)
    before, after = level.history.frames[-4], level.history.frames[-1]
    moved = after.corners[corners] - before.corners[corners]
    assert moved.std(axis=0) == pytest.approx(0.0, abs=1e-15), "no corner moves otherwise than the next"
    way = after.displacement - before.displacement
    assert moved[0] == pytest.approx([way, 0.0, way * LENGTH / HEIGHT], rel=1e-3, abs=1e-12)
