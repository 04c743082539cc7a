"""The time loop seen from outside: supports hold, the drive arrives, confinement stays, runs repeat bit by bit."""

import numpy as np
import pytest

from masonry import scene
from masonry.assembly.assemble import assemble
from masonry.laboratory import laboratory
from masonry.loading.programs import program
from masonry.monitors.frames import Frames, block_of_points
from tests.scenes import ELASTIC, MATERIAL, box, listed, load, specimen, tables

CRACKING = """law = "exponential"
normal_stiffness = "150 GPa/m"
shear_stiffness = "70 GPa/m"
tensile_strength = "0.2 MPa"
cohesion = "0.3 MPa"
tan_friction_angle = 0.9
tan_residual_friction_angle = 0.6
fracture_energy_mode_1 = "5 N/m"
fracture_energy_mode_2 = "40 N/m"
"""
SLIDE = """[drive]
on = "top"
direction = "{direction}"
displacement = "{displacement}"
{pace}
[[traction]]
on = "top.z+"
stress = {{z = "-0.5 MPa"}}
[settle]
steps = {settle}
[solver]
masses = "{masses}"
damping = {damping!r}
rows = {rows}
"""


def couplet(kinematics: str, law=CRACKING, settle=3000, masses="scaled", damping=0.8, rows=300, **drive) -> str:
    """A block that slides on another under confinement; top guided, so that it only slides and lifts."""
    drive = {"direction": "x", "displacement": "0.1 mm", "pace": "steps = 4000"} | drive
    boxes = [
        box(n, (0, 0, z), (0.2, 0.1, 0.05), "units", k, (2, 1, 1))
        for k, (n, z) in enumerate((("low", 0), ("top", 0.05)))
    ]
    return (
        f'kinematics = "{kinematics}"\n'
        + specimen(boxes, 0.02, "60 mm")
        + tables("material", {"units": MATERIAL})
        + tables("contact", {"unit_unit": law, "within_units": ELASTIC})
        + listed("support", ['on = "low"\nfix = "all"', 'on = "top"\nfix = ["y", "rotation"]'])
        + SLIDE.format(settle=settle, masses=masses, damping=damping, rows=rows, **drive)
    )


def bits(result) -> list[bytes]:
    """Every number of the rows and of the last frame."""
    frame = result.history.frames[-1]
    fields = ("corners", "nodes", "opening", "slip", "normal_stress", "shear_stress", "damage_tension", "stress")
    return [v.tobytes() for v in result.history.rows.values()] + [getattr(frame, f).tobytes() for f in fields]


@pytest.mark.parametrize("kinematics", ["rigid", pytest.param("affine", marks=pytest.mark.slow), "tets"])
def test_the_same_scene_gives_the_same_bits_twice_and_on_two_threads(kinematics):
    text = couplet(kinematics, settle=400, pace="steps = 800", displacement="0.02 mm")
    once, again, threaded = (laboratory.run(load(text), threads=n) for n in (1, 1, 2))
    assert bits(once) == bits(again)
    assert bits(once) == bits(threaded)
    assert once.history.rows["stress"].max() > 1e5


MESHED = pytest.param(["kinematics=tets", "specimen.mesh_size=60 mm"], marks=pytest.mark.slow, id="tets")


@pytest.mark.parametrize("changes", [pytest.param([], id="rigid"), MESHED])
def test_a_wall_that_cracks_gives_the_same_bits_on_one_and_on_two_threads(changes):
    wall = scene.load("wallette-mode-1", ["specimen.divisions=[4, 2]", "drive.rate=50 mm/s", *changes])
    one, two = (laboratory.run(wall, threads=n) for n in (1, 2))
    assert bits(one) == bits(two)
    rows = one.history.rows
    assert rows["stress"][-1] < 0.7 * rows["stress"].max() and rows["fracture_mode_1"][-1] > 0.0, "it cracked"


@pytest.mark.parametrize("kinematics", ["rigid", "affine", "tets"])
@pytest.mark.parametrize("direction", ["x", "-x"])
@pytest.mark.parametrize("pace", ["steps = 701", 'rate = "20 mm/s"\nramp = 0.4'])
def test_the_drive_makes_exactly_the_asked_displacement(kinematics, direction, pace):
    settle = 100
    scene = load(couplet(kinematics, ELASTIC, settle, displacement="0.02 mm", direction=direction, pace=pace))
    assembly = assemble(scene)
    result = laboratory.run(scene)
    rows, frame = result.history.rows, result.history.frames[-1]
    sign = -1.0 if direction == "-x" else 1.0
    top = np.unique(np.concatenate([corner_numbers(result, b) for b in result.specimen.sets["top"]]))
    assert frame.corners[top, 0] == pytest.approx(sign * 2e-5, rel=1e-11)
    assert rows["displacement"][-1] == pytest.approx(2e-5, rel=1e-12)
    assert np.diff(rows["displacement"]).min() >= 0.0
    assert rows["step"][-1] == assembly.plan.steps
    assert rows["stress"][-1] > 1e5, "stress is counted along the drive, whichever way it points"
    assert rows["support_stress"][-1] == pytest.approx(rows["stress"][-1], rel=0.05)
    if "rate" in pace:
        assert np.abs(assembly.plan.speed).max() == pytest.approx(
            0.02, rel=0.05 if assembly.plan.steps > settle + 60 else 0.3
        )


def corner_numbers(result, b):
    blocks = result.specimen.blocks
    return np.concatenate(
        [blocks.face_points[blocks.face_start[f] : blocks.face_start[f + 1]] for f in blocks.faces_of(b)]
    )


@pytest.mark.parametrize(
    "settle, steps, ramp", [(0, 1, 0.3), (0, 2, 0.0), (0, 3, 1.0), (10, 1, 0.3), (10, 500, 0.0), (7, 40, 1.0)]
)
def test_the_program_of_any_length_adds_up_to_the_displacement(settle, steps, ramp):
    p = program(1e-3, settle, -2e-3, steps, None, ramp)
    assert np.isfinite(p.speed).all()
    assert p.speed[:-1].sum() * 1e-3 == pytest.approx(-2e-3, rel=1e-12)
    assert p.dead_load[0] == 0.0
    assert p.dead_load[-1] == (1.0 if settle else 0.0)
    assert np.all(np.abs(p.speed[:settle]) == 0.0), "it waits for the dead loads"


def test_confinement_stays_while_the_top_slides():
    """Cracking, then sliding: the normal force on the joint is the traction, to one part in a million, all along."""
    for kinematics in ("rigid", "affine"):
        result = laboratory.run(load(couplet(kinematics, settle=6000, displacement="0.3 mm", pace="steps = 20000")))
        force = []
        for frame in result.history.frames:
            bed = np.abs(result.joints.normal[:, 2]) > 0.5
            force.append((frame.normal_stress * result.joints.area)[bed].sum())
        after = np.array([f.step for f in result.history.frames]) >= 6000
        assert after.sum() > 15
        assert np.array(force)[after] == pytest.approx(-0.5e6 * 0.02, rel=1e-6)
        assert result.history.frames[-1].damage_shear.max() > 0.5
        assert result.history.rows["stress"].max() > 0.3e6


def test_what_is_held_does_not_move_and_rollers_let_slide():
    text = couplet("tets", ELASTIC, settle=2000, pace="steps = 500", displacement="0.01 mm")
    text = text.replace(
        'on = "low"\nfix = "all"', 'on = "low.z-"\nfix = ["z"]\n[[support]]\non = "low.x-"\nfix = ["x"]'
    )
    result = laboratory.run(load(text))
    nodes, moved = result.mesh.nodes, result.history.frames[-1].nodes
    bottom, left = np.abs(nodes[:, 2]) < 1e-9, (np.abs(nodes[:, 0]) < 1e-9) & (nodes[:, 2] < 0.05 - 1e-9)
    assert np.all(moved[bottom, 2] == 0.0)
    assert np.all(moved[left, 0] == 0.0)
    assert np.abs(moved[bottom, 0]).max() > 1e-7
    assert np.abs(moved[left, 2]).max() > 1e-8


def test_a_rigid_face_as_a_roller_neither_lifts_nor_turns():
    text = couplet("rigid", ELASTIC, settle=2000, pace="steps = 500", displacement="0.01 mm")
    text = text.replace(
        'on = "low"\nfix = "all"', 'on = "low.z-"\nfix = ["z"]\n[[support]]\non = "low.x-"\nfix = ["x"]'
    )
    frame = laboratory.run(load(text)).history.frames[-1]
    low = slice(0, 16)
    assert np.all(frame.corners[low, 2] == 0.0)
    assert np.abs(frame.corners[low, 0]).max() > 1e-8, "the second block of the bottom gives way along x"


def test_ctrl_c_ends_a_run_with_what_there_is():
    seen = []

    def impatient(step: int, steps: int, note: str) -> None:
        seen.append(step)
        assert 0 <= step <= steps
        if len(seen) == 10:
            raise KeyboardInterrupt

    result = laboratory.run(load(couplet("rigid", settle=400, pace="steps = 2000")), progress=impatient)
    assert result.summary["interrupted"] is True
    assert result.summary["steps"] == seen[-1] < 2400
    assert result.history.rows["step"][-1] == seen[-1]
    count = len(result.history.rows["step"])
    assert count == len(set(seen) | {0})
    complete = laboratory.run(load(couplet("rigid", settle=400, pace="steps = 2000")))
    assert complete.summary["interrupted"] is False
    for key, values in result.history.rows.items():
        assert np.array_equal(values, complete.history.rows[key][:count]), key


def test_threads_are_as_many_as_asked(monkeypatch):
    import numba

    asked = []
    right = numba.set_num_threads
    monkeypatch.setattr(numba, "set_num_threads", lambda n: (asked.append(n), right(n)))
    laboratory.run(load(couplet("rigid", settle=40, pace="steps = 80")), threads=2)
    assert 2 in asked


def test_a_corner_moves_with_the_nodes_of_its_own_block_where_two_blocks_have_one_there():
    model = assemble(scene.load("couplet", ["kinematics=tets", "specimen.mesh=fan"])).model
    mesh, displacement = model.layout.mesh, model.contacts.u
    for block in range(model.blocks.count):
        displacement[mesh.node_start[block] : mesh.node_start[block + 1]] = block + 1.0
    moved = Frames(model).corners()
    np.testing.assert_array_equal(moved[:, 0], block_of_points(model.blocks) + 1.0)
