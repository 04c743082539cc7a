"""How far contact points reach to the edge about which a dry joint turns, not to its corners: in a check, and a run."""

import pytest

from masonry.assembly.assemble import assemble
from masonry.judgement.judgement import judgement_of
from masonry.laboratory import laboratory
from masonry.laboratory.remarks.checks import free_rocking
from tests.scenes import box, listed, load, specimen, tables

DRY = 'law = "friction"\nnormal_stiffness = "2 GPa/m"\nshear_stiffness = "1 GPa/m"\ntan_friction_angle = 0.9'
ALONG_X, ALONG_Y = "{x = 8, y = 2, z = 2}", "{x = 2, y = 8, z = 2}"


def shaken(fixed: str, points: str, direction: str = "x"):
    """A block of 0.4 x 0.3 x 1 m on ground that is pushed to and fro for half a second: it rocks."""
    boxes = [
        box("g", (-0.5, -0.5, -0.2), (1.4, 1.3, 0.2), "units", 0),
        box("b", (0.0, 0.0, 0.0), (0.4, 0.3, 1.0), "units", 1),
    ]
    more = [f'on = "b"\nfix = [{fixed}]'] if fixed else []
    return load(
        'kinematics = "rigid"\n'
        + specimen(boxes, 1.0, more=f'contact_points = "gauss"\npoints_per_edge = {points}')
        + tables("material", {"units": 'density = "2000 kg/m^3"'})
        + tables("contact", {"unit_unit": DRY})
        + listed("support", ['on = "g"\nfix = "all"', *more])
        + '[gravity]\nz = "-9.81 m/s^2"\n[settle]\nsteps = 4000\n[solver]\nmasses = "real"\nrotation_limit = 0.5\n'
        + f'[ground]\n{direction} = "0.5 g * sin(2 pi t / 0.5 s)"\nduration = "0.4 s"\nas = "base"\n'
    )


@pytest.mark.parametrize(
    ("fixed", "points", "told"),
    [
        ("", ALONG_X, True),
        ('"y", "rotation x", "rotation z"', ALONG_X, False),
        ('"x", "rotation y", "rotation z"', ALONG_X, True),
        ('"y", "rotation x", "rotation z"', ALONG_Y, True),
        ('"x", "rotation y", "rotation z"', ALONG_Y, False),
        ("", "8", False),
    ],
)
def test_a_check_asks_for_the_directions_in_which_a_block_may_turn(fixed, points, told):
    lines = free_rocking.remarks(assemble(shaken(fixed, points)))
    assert len(lines) == told and all("these reach 0.58 of the way" in line for line in lines)


@pytest.mark.parametrize(("direction", "points", "told"), [("x", ALONG_X, 0.0), ("y", ALONG_X, 0.577),
                                                           ("x", ALONG_Y, 0.577), ("y", ALONG_Y, 0.0)])  # fmt: skip
def test_a_shaken_run_asks_for_the_direction_in_which_it_rocked(direction, points, told):
    summary = laboratory.run(shaken("", points, direction)).summary
    values = [doubt.value for doubt in judgement_of(summary).doubts if doubt.name == "rocking"]
    assert sum(values) == pytest.approx(told, abs=1e-3)
