"""Blocks that start in motion: free flight by hand for rigid and affine blocks and tets, and the energy they have."""

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from tests.scenes import ELASTIC, MATERIAL, box, listed, load, specimen, tables

KINDS = ("rigid", "affine", "tets")
SIZE, LOW, DENSITY, G, TIME = np.array([0.2, 0.1, 0.3]), np.array([1.0, 2.0, 3.0]), 1900.0, 9.81, 0.01
VELOCITY, SPIN = np.array([0.3, -0.2, 0.5]), np.array([0.4, -1.1, 0.7])
MASS = DENSITY * SIZE.prod()
MOMENTS = MASS / 12 * (np.square(SIZE).sum() - np.square(SIZE))
MOTION = f"""on = "free"
velocity = {[f"{v} m/s" for v in VELOCITY.tolist()]}
spin = {[f"{w} rad/s" for w in SPIN.tolist()]}"""
GRAVITY = '[gravity]\nz = "-9.81 m/s^2"\n[settle]\nsteps = 0\n'


def flight(kinematics="rigid", motion=(MOTION,), gravity="", divisions=(1, 1, 1), turned="", step="2e-6 s", more=""):
    """A block that nothing holds, beside one that is held."""
    boxes = [box("base", (0, 0, 0), (0.1, 0.1, 0.1), "units", 0), box("free", LOW, SIZE, "units", 1, divisions)]
    return load(
        f'kinematics = "{kinematics}"\n'
        + specimen(boxes, 0.01, "200 mm", turned)
        + tables("material", {"units": MATERIAL})
        + tables("contact", {"unit_unit": ELASTIC, "within_units": ELASTIC})
        + listed("support", ['on = "blocks at z = 0 m"\nfix = "all"'])
        + listed("motion", list(motion))
        + gravity
        + f'[solver]\nmasses = "real"\ndamping = 0\nduration = "{TIME} s"\ntime_step = "{step}"\nrows = 100\n{more}'
    )


@pytest.mark.parametrize("kinematics", KINDS)
def test_a_free_block_flies_by_its_velocity_spin_and_weight(kinematics):
    scene = flight(kinematics, gravity=GRAVITY)
    result = laboratory.run(scene)
    rows = result.history.rows
    time = rows["time"][-1]
    assert time == pytest.approx(TIME, rel=1e-3)
    corners = result.specimen.blocks.points[-8:]
    frame = result.history.frames[-1]
    arm = corners - (LOW + 0.5 * SIZE)
    fall = VELOCITY * time - 0.5 * G * time**2 * np.array([0, 0, 1])
    wanted = fall + np.cross(SPIN * time, arm)
    turned = np.linalg.norm(SPIN) * time
    assert frame.corners[-8:] == pytest.approx(wanted, abs=0.2 * turned**2), "small displacements: linear in the turn"
    assert frame.corners[-8:].mean(axis=0) == pytest.approx(fall, rel=1e-9), "half a step of weight is in the start"
    assert np.abs(wanted).max() > 5 * 0.2 * turned**2
    first = VELOCITY - 0.5 * assemble(scene).model.dt * G * np.array([0, 0, 1])
    start = 0.5 * MASS * first @ first + 0.5 * MOMENTS @ np.square(SPIN)
    if kinematics != "tets":  # whose mass sits in their nodes
        assert rows["kinetic"][0] == pytest.approx(start, rel=1e-12)
    assert rows["external_work"][0] == pytest.approx(rows["kinetic"][0], rel=1e-14)
    assert rows["external_work"][-1] - rows["external_work"][0] == pytest.approx(-MASS * G * fall[2], rel=1e-2)
    assert np.abs(rows["imbalance"]).max() < 1e-12 * rows["external_work"].max()


@pytest.mark.parametrize("kinematics", KINDS)
def test_blocks_of_one_entry_start_as_one_rigid_body_and_strain_nothing(kinematics):
    turned = 'turned = {about = "z", angle = "30 deg"}'
    built = assemble(flight(kinematics, divisions=(2, 1, 1), turned=turned))
    layout, motion = built.model.layout, built.model.motion
    chosen = built.specimen.sets["free"]
    centre = np.average(layout.centroid[chosen], axis=0, weights=layout.volume[chosen])
    for b in chosen:
        place = layout.centroid[b]
        if kinematics == "tets":
            nodes = np.arange(layout.mesh.node_start[b], layout.mesh.node_start[b + 1])
            wanted = VELOCITY + np.cross(SPIN, layout.mesh.nodes[nodes] - centre)
            assert motion["tets"][nodes] == pytest.approx(wanted)
            continue
        v = motion[kinematics][layout.local[b]]
        assert v[:3] == pytest.approx(VELOCITY + np.cross(SPIN, place - centre))
        if kinematics == "rigid":
            assert layout.axes[b] @ v[3:] == pytest.approx(SPIN)
        else:
            gradient = v[3:].reshape(3, 3) @ layout.axes[b].T
            assert gradient + gradient.T == pytest.approx(np.zeros((3, 3)), abs=1e-15)
            assert gradient @ [1, 2, 3] == pytest.approx(np.cross(SPIN, [1, 2, 3]))
    assert built.model.bodies[KINDS.index(kinematics)].v == pytest.approx(motion[kinematics])


def test_a_spin_about_a_point_leaves_it_where_it_is():
    corner = [f"{x} m" for x in LOW.tolist()]
    scene = flight(motion=[f'on = "free"\nspin = [0, "1 rad/s", 0]\nabout = {corner}'])
    v = assemble(scene).model.bodies.rigid.v[1]
    assert v[:3] + np.cross((0, 1, 0), -0.5 * SIZE) == pytest.approx(np.zeros(3), abs=1e-15)
    assert v[3:] == pytest.approx((0, 1, 0))


def standing(velocity: str, settle: int):
    """A block that slides without friction and weighs on its base."""
    slippery = ELASTIC.replace("80 GPa/m", "0 GPa/m").replace("200 GPa/m", "1 GPa/m")
    boxes = [box("base", (0, 0, 0), (1, 0.1, 0.1), "units", 0), box("free", (0.4, 0, 0.1), (0.2, 0.1, 0.1), "units", 1)]
    return load(
        specimen(boxes, 0.01)
        + tables("material", {"units": MATERIAL})
        + tables("contact", {"unit_unit": slippery})
        + listed("support", ['on = "base"\nfix = "all"', 'on = "free"\nfix = ["y", "rotation"]'])
        + listed("motion", [f'on = "free"\nvelocity = {velocity}'])
        + f'[gravity]\nz = "-9.81 m/s^2"\n[settle]\nsteps = {settle}\n'
        + '[solver]\nmasses = "real"\ndamping = 0.1\nduration = "0.01 s"\nslip_limit = 10\n'
    )


def test_a_blow_upon_what_moves_already_is_booked_to_rounding():
    rows = laboratory.run(standing('[0, 0, "1 mm/s"]', 7)).history.rows
    assert np.abs(rows["imbalance"]).max() < 1e-12 * np.abs(rows["external_work"]).max()


def test_a_block_that_stands_is_set_off_once_its_weight_has_settled():
    scene = standing('["1 m/s", 0, 0]', 2500)
    built = assemble(scene)
    assert not built.model.bodies.rigid.v.any(), "it settles first"
    assert 2500 in built.plan.marks
    rows = laboratory.run(scene).history.rows
    mass, before = DENSITY * 0.002, rows["step"] <= 2500
    assert rows["kinetic"][before][-1] < 1e-3 * 0.5 * mass
    assert rows["kinetic"][~before][0] == pytest.approx(0.5 * mass, rel=2e-2)
    assert np.diff(rows["external_work"])[before.sum() - 1] == pytest.approx(0.5 * mass, rel=1e-2)
    assert np.abs(rows["imbalance"]).max() < 1e-12 * rows["external_work"].max()


def test_a_flight_whose_time_step_nothing_limits_needs_one():
    with pytest.raises(SceneError, match="nothing here limits the time step; give one"):
        assemble(flight(step="0.9 s", gravity=GRAVITY).with_({"solver.time_step": "gershgorin"}))


def test_what_is_held_or_no_whole_block_cannot_be_set_in_motion():
    with pytest.raises(SceneError, match="a support or the drive holds what this sets in motion"):
        assemble(flight(motion=['on = "base"\nvelocity = ["1 m/s", 0, 0]']))
    with pytest.raises(SceneError, match="whole blocks start in motion; name a set"):
        assemble(flight(motion=['on = "free.z+"\nvelocity = ["1 m/s", 0, 0]']))
