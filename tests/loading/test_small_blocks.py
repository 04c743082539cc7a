"""Small blocks on large ones: what a run says of them is asked of each block, and not of the sum over all."""

from math import atan, cos, degrees, radians, sin

import numpy as np
import pytest

import masonry
from masonry.assembly.assemble import assemble
from masonry.configuration import energy
from masonry.errors import Stopped
from masonry.judgement.sentence import trust
from masonry.loading.moves.drift import Drift
from masonry.loading.moves.travels import Limits, Travels
from masonry.monitors.unrest import EachBlock
from masonry.rows.rest_criterion import LONE, RestCriterion
from tests.scenes import MATERIAL, box, listed, load, specimen, tables

TILT = 'pattern = "tilt"\nabout = "y"\naccuracy = "1 %"'
PUSH = 'pattern = "weight"\ndirection = "-x"\naccuracy = "1 %"'


def pair(
    size: float, slenderness: float = 4.0, friction: float = 0.65, more: str = "", gravity: float = 0.0, **changes
):
    """A block of 2 m on a held one, and a small one on it: its width in m, and its height over that; gravity: degrees
    by which that leans to the left."""
    boxes = [
        box("ground", (-2, 0, -0.5), (8, 2, 0.5), "units", 0),
        box("large", (0, 0, 0), (2, 2, 2), "units", 1),
        box("small", (1, 1, 2), (size, size, slenderness * size), "units", 2),
    ]
    stiff = f'normal_stiffness = "30 GPa/m"\nshear_stiffness = "12 GPa/m"\ntan_friction_angle = {friction}'
    x, z = -9.81 * sin(radians(gravity)), -9.81 * cos(radians(gravity))
    return load(
        'law = "friction"\n'
        + specimen(boxes, 1.0, more='contact_points = "vertex"')
        + tables("material", {"units": MATERIAL})
        + tables("contact", {"unit_unit": stiff})
        + listed("support", ['on = "ground"\nfix = "all"'])
        + f'[gravity]\nx = "{x!r} m/s^2"\nz = "{z!r} m/s^2"\n{more}',
        **changes,
    )


@pytest.mark.parametrize("limit", [TILT, PUSH])
@pytest.mark.parametrize(
    ("size", "slenderness", "friction"), [(0.03, 4.0, 0.65), (2e-3, 4.0, 0.65), (2e-4, 6.0, 0.3), (0.02, 2.0, 0.2)]
)
def test_a_small_block_on_a_large_one_tips_or_slides_as_by_itself(limit, size, slenderness, friction):
    result = masonry.run(pair(size, slenderness, friction, f"[settle]\nsteps = 4000\n[limit]\n{limit}"))
    collapse = result.summary["collapse_load"]
    known = min(1.0 / slenderness, friction)
    assert 0.5 * (collapse["borne"] + collapse["falls"]) == pytest.approx(known, rel=0.01)
    if friction * slenderness > 1.0:
        assert (collapse["moving"], collapse["first"], collapse["undecided"]) == (1, 2, 0)
    assert "with care" not in trust(result.summary) or size < 1e-3


def test_a_force_on_the_small_block_is_measured_by_its_own_weight():
    """Over the weight of both, it is nothing."""
    push = 'pattern = "force"\non = "small"\nforce = {x = "1 N"}\naccuracy = "1 %"\nup_to = 1000'
    result = masonry.run(pair(0.02, 4.0, 0.65, f"[limit]\n{push}")).summary["collapse_load"]
    assert 0.5 * (result["borne"] + result["falls"]) == pytest.approx(1900.0 * 9.81 * 0.02**2 * 0.08 * 0.25, rel=0.01)


@pytest.mark.parametrize("steps", [None, 2000])
def test_a_small_block_that_cannot_stand_under_its_weight_is_named(steps):
    """It tips at a slope of 0.25, and gravity leans by 0.26. With so few steps it has hardly begun to."""
    scene = pair(2e-3, gravity=degrees(atan(0.26)), more="" if steps is None else f"[settle]\nsteps = {steps}")
    if steps is None:
        with pytest.raises(Stopped, match="block 2 at|of what block 2 bears"):
            masonry.run(scene)
        return
    summary = masonry.run(scene).summary
    assert summary["unbalanced_after_settling"] < 1e-4 and summary["kinetic_after_settling"] < 1e-8
    assert summary["unrest_after_settling"]["block"] == 2
    assert "with care: block 2 at (1.001, 1.001, 2.004) m had not come to rest" in trust(summary)


def test_a_small_block_that_stands_at_a_slope_settles_without_a_word():
    result = masonry.run(pair(2e-3, gravity=degrees(atan(0.24))))
    assert {doubt.name for doubt in result.doubts} <= {"closed_joints"}, "of two points along an edge, not of rest"
    assert result.summary["moving_at_end"]["kinetic"] < 1e-6


SLIDES = """
displacements = "large"
law = "friction"

[specimen]
kind = "boxes"
section = "1 m^2"
contact_points = "vertex"
box = [
  {name = "large", origin = ["0 m", "0 m", "0.05 m"], size = ["2 m", "2 m", "2 m"], group = "units", unit = 0},
  {name = "small", origin = ["3 m", "1 m", "0 m"], size = ["5 mm", "5 mm", "2 mm"], group = "units", unit = 1},
]

[material.units]
density = "1900 kg/m^3"

[contact.default]
normal_stiffness = "2 GPa/m"
shear_stiffness = "1 GPa/m"
tan_friction_angle = 0.02
normal_dashpot = 1.0

[floor]
size = ["10 m", "6 m"]

[gravity]
z = "-9.81 m/s^2"

[settle]
steps = 0

[[motion]]
on = "small"
velocity = ["0.05 m/s", "0 m/s", "0 m/s"]

[[gauge]]
name = "slides"
at = "small"
direction = "x"

[solver]
masses = "real"
damping = 0
duration = "1 s"
until = "rest"
"""


def test_a_run_until_rest_waits_for_the_small_block_that_slides_on():
    """It is far less than 1e-8 of the energy with which the large one came down; it comes to rest v^2 / 2 mu g on."""
    result = masonry.run(load(SLIDES))
    ends = result.history.rows["time"][-1]
    assert 0.05 / (0.02 * 9.81) < ends < 0.4
    assert result.summary["gauges"]["slides"]["final_m"] == pytest.approx(0.05**2 / (2.0 * 0.02 * 9.81), rel=0.02)
    short = masonry.run(load(SLIDES, solver__duration="0.2 s"))
    assert any("(3.002, 1.002, 0.001) m, was not at rest" in line for line in short.summary["warnings"])


def test_a_gauge_has_to_stand_still_where_all_blocks_rest():
    """Beside the farthest that it has moved: by a hundredth of that it moves, by a ten-thousandth it does not."""
    gauge = '[[gauge]]\nname = "top"\nat = "small.z+"\ndirection = "x"\n'
    assembly = assemble(pair(0.02, more=f"[limit]\n{TILT}\n{gauge}"))
    travels = Travels(assembly.model, Limits(RestCriterion(1e-4, 1e-8), 1e-3, 0.005, 10.0), assembly.recording.gauges)
    place, still = assembly.model.bodies.rigid.q, energy.velocities(assembly.model)
    place[2, 0] = 1e-3
    assert not travels.moves_alone(still, calm=0)
    place[2, 0] += 1e-7
    assert not travels.moves_alone(still, calm=1)
    place[2, 0] += 1e-5
    assert travels.moves_alone(still, calm=2)


def test_a_block_is_measured_by_what_it_bears_and_by_what_its_contacts_store_under_that():
    model = assemble(pair(0.02)).model
    body, mass = model.bodies.rigid, model.masses["rigid"]
    still, speed, weight = energy.velocities(model), 1e-9, 1900.0 * 9.81 * 0.02**2 * 0.08
    body.v[2, 2] = speed
    unrest = EachBlock(model).look(still)
    assert unrest.force[2] == pytest.approx(mass[2, 2] * speed / model.dt / weight)
    assert unrest.energy[2] == pytest.approx(mass[2, 2] * speed**2 * 30e9 * 0.02**2 / weight**2)
    assert unrest.force[:2].tolist() == unrest.energy[:2].tolist() == [0.0, 0.0]
    force, moving = float(unrest.force[2]) / LONE, float(unrest.energy[2]) / LONE**2
    for share, moves in ((0.99, True), (1.01, False)):
        assert unrest.alone(RestCriterion(share * force, 1.0))[2] == moves
        assert unrest.alone(RestCriterion(1.0, share * moving))[2] == moves
    body.v[2, 2], body.v[2, 4] = 0.0, speed
    about = mass[2, 4] * speed / model.dt / (0.02**2 * 0.08) ** (1 / 3)
    assert EachBlock(model).look(still).force[2] == pytest.approx(about / weight), "what turns about its middle moves"


def test_a_block_that_creeps_alone_under_damping_is_let_go_until_it_falls():
    """Dragged, it creeps back and forth for 50,000 steps half a per cent above its collapse."""
    stiff = {"contact.unit_unit.normal_stiffness": "128 GPa/m", "contact.unit_unit.shear_stiffness": "51 GPa/m"}
    scene = pair(2.67e-3, 4.307, 0.349, f"[settle]\nsteps = 4000\n[limit]\n{TILT}").with_(stiff)
    result = masonry.run(scene)
    collapse = result.summary["collapse_load"]
    assert 0.5 * (collapse["borne"] + collapse["falls"]) == pytest.approx(1.0 / 4.307, rel=0.01)
    assert collapse["undecided"] == 0 and result.summary["steps"] < 60_000


def test_a_block_that_drifts_alone_is_not_braked_and_all_others_are():
    """The large block, 1e6 times as heavy, swings back along the way that it came."""
    model = assemble(pair(0.02)).model
    body = model.bodies.rigid
    moved, velocity, alone = np.zeros((3, 6)), np.zeros((3, 6)), np.arange(3) == 2
    moved[1, 0], moved[2, 0], velocity[1, 0], velocity[2, [0, 2]] = 1e-6, 1e-5, -1e-7, (2e-5, 4e-6)
    body.v[...] = velocity
    drift = Drift({"rigid": moved}, fades=0.9)
    assert drift.brake(model, [velocity.copy()], 0.5, alone) == pytest.approx(2.0)
    assert body.v[2, [0, 2]] == pytest.approx([2e-5, 2e-6]) and body.v[1, 0] == pytest.approx(-0.5e-7)
    body.v[...] = velocity
    assert drift.brake(model, [velocity.copy()], 0.5) < 0.0, "together they go back"
