"""A load on top of a block that rocks: one that goes with its face, and one whose line of action stays in space."""

from functools import cache

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.loading.varying_loads import SharedLoads
from masonry.results.data import ResultData
from masonry.scene import Scene
from tests.scenes import box, listed, load, specimen, tables

WIDE, HIGH, DEEP, PRESSURE = 0.5, 1.0, 0.2, 0.2e6
FORCE = PRESSURE * WIDE * DEEP
FIXED, MOVING = 'line_of_action = "fixed"', ""


def pushed_over(line: str, x: float = 0.0, pace: str = 'accuracy = "20 %"', **changes: object) -> Scene:
    """A weightless block on a slab, pressed from above and pushed at the level of its centroid, at a place x (m)."""
    boxes = [box("slab", (x - 0.5, 0, -0.1), (1.5, 0.2, 0.1), "units", 0)]
    boxes.append(box("block", (x, 0, 0), (WIDE, DEEP, HIGH), "units", 1))
    contact = 'normal_stiffness = "2 GPa/m"\nshear_stiffness = "1 GPa/m"\ntan_friction_angle = 2.0'
    return load(
        'displacements = "large"\nlaw = "friction"\nkinematics = "rigid"\n'
        + specimen(boxes, WIDE * DEEP)
        + tables("material", {"units": 'density = "2000 kg/m^3"'})
        + tables("contact", {"unit_unit": contact})
        + listed("support", ['on = "slab"\nfix = "all"', 'on = "block"\nfix = ["y", "rotation x", "rotation z"]'])
        + listed("traction", [f'on = "block.z+"\nstress = {{z = "{-PRESSURE!r} Pa"}}\n{line}'])
        + f'[settle]\nsteps = 1500\n[drive]\non = "block"\ndirection = "x"\ndisplacement = "30 mm"\n{pace}',
        **changes,
    )


@cache
def pushed(line: str, x: float = 0.0) -> ResultData:
    return laboratory.run(pushed_over(line, x))


def by_hand(line: str, displacement: np.ndarray) -> np.ndarray:
    """N, at the centroid of a rigid block that turns about its toe: the force of the load times its lever there."""
    turn = np.linspace(0.0, 0.3, 3001)
    across = 0.5 * WIDE * (1.0 - np.cos(turn)) + 0.5 * HIGH * np.sin(turn)
    up = 0.5 * WIDE * np.sin(turn) + 0.5 * HIGH * np.cos(turn)
    lever = 0.5 * WIDE if line == FIXED else 0.5 * WIDE * np.cos(turn) - HIGH * np.sin(turn)
    return np.interp(displacement, across, FORCE * lever / up)


@pytest.mark.parametrize(("line", "x"), [(FIXED, 0.0), (FIXED, 300.0), (MOVING, 0.0)])
def test_the_restoring_moment_is_that_of_the_closed_form(line, x):
    rows = pushed(line, x).history.rows
    force, rocks = rows["stress"] * WIDE * DEEP, rows["displacement"] > 0.015
    assert force[rocks] == pytest.approx(by_hand(line, rows["displacement"][rocks]), rel=3e-3), "a drive paced roughly"


def test_one_that_goes_along_loses_twice_over():
    """At a drift of 6 %: half of the first moment is gone with the arm, and none of it where the line stays."""
    fixed, moving = (pushed(line).history.rows["stress"][-1] * WIDE * DEEP for line in (FIXED, MOVING))
    assert moving / fixed == pytest.approx(0.7638, abs=2e-3)


@pytest.mark.parametrize("line", [FIXED, MOVING])
def test_the_ledger_closes_and_knows_what_the_load_did(line):
    result = pushed(line)
    rows, summary = result.history.rows, result.summary
    assert summary.energy_imbalance < 1e-12
    force = rows["stress"] * WIDE * DEEP
    of_drive = float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(rows["displacement"])))
    assert summary.work_of_drive_j == pytest.approx(of_drive, rel=1e-3)


def test_a_load_that_goes_along_works_by_the_way_of_its_point():
    turn = np.linspace(0.0, 0.3, 3001)
    across = 0.5 * WIDE * (1.0 - np.cos(turn)) + 0.5 * HIGH * np.sin(turn)
    last = np.interp(0.03, across, turn)
    rise = 0.5 * WIDE * np.sin(last) + HIGH * (np.cos(last) - 1.0)
    work = pushed(MOVING).summary.work_of_loads_after_settling_j["traction.0"]
    assert work == pytest.approx(-FORCE * rise, abs=FORCE * 2e-4), "the toe sinks by 0.2 mm"


@pytest.mark.parametrize("line", [FIXED, MOVING])
def test_a_load_with_a_history_of_ones_is_the_one_that_stays(line):
    steps = "steps = 3000"
    dead = laboratory.run(pushed_over(line, pace=steps)).history.rows
    varying = laboratory.run(
        pushed_over(line + '\nhistory = "1 + 0 * t / 1 s"\nduration = "1e-4 s"', pace=steps)
    ).history.rows
    assert varying["stress"] == pytest.approx(dead["stress"], rel=1e-6, abs=1.0)


def test_where_nothing_can_turn_nothing_is_computed_for_it():
    supports = [{"on": "slab", "fix": "all"}, {"on": "block", "fix": ["y", "rotation"]}]
    assert not assemble(pushed_over(MOVING, support=supports)).model.elements
    assert [one.name for one in assemble(pushed_over(FIXED, support=supports)).model.elements] == ["point_loads"]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"displacements": "small"}, "in small displacement no load changes its place"),
        (
            {
                "kinematics": "affine",
                "material.units.young_modulus": "5 GPa",
                "material.units.poisson_ratio": 0.2,
                "support": [{"on": "slab", "fix": "all"}],
            },
            "acts on rigid ones",
        ),
        ({"traction.0.line_of_action": "still"}, "allowed: moving, fixed"),
    ],
)
def test_what_does_not_fit_is_refused(changes, message):
    with pytest.raises(SceneError, match=message):
        assemble(pushed_over(FIXED, **{key.replace(".", "__"): value for key, value in changes.items()}))


def test_the_moment_of_a_load_that_varies_is_about_the_same_axes_as_that_of_one_that_stays():
    """On a block whose principal axes are not x, y, z."""
    oblique = {
        "specimen__turned": {"about": "z", "angle": "30 deg"},
        "support": [{"on": "slab", "fix": "all"}],
        "drive__on": "block",
    }
    push = {"on": "block.z+", "stress": {"x": "10 kPa"}}
    dead = assemble(pushed_over("", pace="steps = 10", traction=[push], **oblique)).model
    history = {"history": "1 + 0 * t / 1 s", "duration": "1e-4 s"}
    varying = assemble(pushed_over("", pace="steps = 10", traction=[push | history], **oblique)).model
    SharedLoads(varying).pass_over(np.ones(1), np.ones(1), 1)
    assert varying.bodies.rigid.load == pytest.approx(dead.bodies.rigid.load, rel=1e-12, abs=1e-9)
    assert abs(dead.bodies.rigid.load[1, 4]) > 100.0
