"""Supports, drive and dead loads are in balance; joints carry what statics says; loads do the work of their way."""

import re

import numpy as np
import pytest

from masonry import scene
from masonry.assembly.assemble import assemble
from masonry.laboratory import laboratory
from masonry.monitors.reactions import moved_by, open_by
from masonry.rows.history import Standing
from tests.large.made import G, dry
from tests.scenes import ELASTIC, MATERIAL, box, listed, load, specimen, tables
from verification.fixtures.scene_text import loaded
from verification.scene_runs import result_of, text_of

WALL = "energy-of-all-kinds"
KINDS = {
    "rigid": "rigid",
    "affine": "affine",
    "tets": "tets",
    "mixed": {"hard": "rigid", "fine": "affine", "soft": "tets"},
}


def moving(balance: dict, key: str) -> float:
    """What damping and inertia make together, over the largest of all forces or moments."""
    acts = [np.array(value[key]) for name, value in balance.items() if isinstance(value, dict) and name != "sum"]
    both = np.array(balance["damping"][key]) + np.array(balance["inertia"][key])
    return float(np.abs(both).max() / max(np.abs(act).max() for act in acts))


def left(balance: dict, key: str) -> float:
    """What is left of the sum of forces or moments, over the largest of them."""
    acts = [np.array(value[key]) for name, value in balance.items() if isinstance(value, dict) and name != "sum"]
    return float(np.abs(balance["sum"][key]).max() / max(np.abs(act).max() for act in acts))


@pytest.mark.parametrize("kinematics", KINDS.values(), ids=KINDS)
def test_at_rest_the_reactions_are_the_loads_in_force_and_moment(kinematics):
    text = re.sub(r"\[drive\][^\[]*", "", text_of(WALL))
    with loaded(text, {"kinematics": kinematics, "settle.steps": 12000}) as scene:
        balance = laboratory.run(scene).summary["reactions"]["end"]
    assert {"support.0", "support.1", "traction.0", "traction.1", "gravity"} <= balance.keys()
    volume = 5 * 0.2 * 0.1 * 0.08
    assert balance["gravity"]["force_n"] == pytest.approx([0.0, 1900 * volume, -9.81 * 1900 * volume], rel=1e-9)
    assert balance["traction.0"]["force_n"] == pytest.approx([40.0, 0.0, -2000.0], rel=1e-9)
    assert balance["traction.0"]["moment_nm"] == pytest.approx(
        list(np.cross([0.4, 0.05, 0.16], [40.0, 0.0, -2000.0])), rel=1e-9
    )
    assert left(balance, "force_n") < 1e-13 and left(balance, "moment_nm") < 1e-13
    assert moving(balance, "force_n") < 1e-9 and moving(balance, "moment_nm") < 1e-9


@pytest.mark.parametrize("kinematics", KINDS.values(), ids=KINDS)
def test_a_drive_that_has_come_to_rest_is_in_balance_with_the_supports(kinematics):
    waits = [["0 s", "0 mm"], ["1 s", "0.02 mm"], ["8 s", "0.02 mm"]]
    result = result_of(WALL, {"kinematics": kinematics, "drive.history": waits, "drive.steps": 20000})
    balance = result.summary["reactions"]["end"]
    assert balance["drive"]["force_n"][0] == pytest.approx(result.history.rows["force"][-1], rel=1e-12)
    assert left(balance, "force_n") < 1e-13 and left(balance, "moment_nm") < 1e-13
    assert moving(balance, "force_n") < 1e-9 and moving(balance, "moment_nm") < 1e-9


@pytest.mark.parametrize("masses", ["scaled", "real"])
@pytest.mark.parametrize("kinematics", KINDS.values(), ids=KINDS)
def test_in_the_midst_of_motion_inertia_and_damping_close_the_balance(kinematics, masses):
    keys = {"kinematics": kinematics, "solver.masses": masses, "solver.damping": 0.3}
    summary = result_of(WALL, keys | {"settle.steps": 40, "drive.steps": 200}).summary
    balance = summary["reactions"]["end"]
    assert moving(balance, "force_n") > 1e-3 and moving(balance, "moment_nm") > 1e-3
    assert left(balance, "force_n") < 1e-12 and left(balance, "moment_nm") < 1e-12
    assert summary["force_balance"] < 1e-12 and summary["motion_at_end"] > 1e-3


def leaning(push: str, more: str = ""):
    """A block of 0.2 x 0.1 x 0.4 m on a fixed one, pressed by 10 kN and pushed along x on its top."""
    blocks = [
        box("base", (0, 0, 0), (0.2, 0.1, 0.1), "units", 0),
        box("block", (0, 0, 0.1), (0.2, 0.1, 0.4), "units", 1),
    ]
    return (
        'kinematics = "rigid"\n'
        + specimen(blocks, 0.02)
        + tables("material", {"units": MATERIAL})
        + tables("contact", {"unit_unit": ELASTIC})
        + listed("support", ['on = "base"\nfix = "all"'])
        + listed("traction", [f'on = "block.z+"\nstress = {{x = "{push}", z = "-0.5 MPa"}}'])
        + "[settle]\nsteps = 6000\n"
        + more
    )


def test_the_normal_force_of_a_joint_acts_where_statics_has_it():
    result = laboratory.run(load(leaning("50 kPa")))
    table = result.resultants
    (row,) = np.flatnonzero(table["moment"] == "end")
    assert (table["unit_a"][row], table["unit_b"][row]) == (0, 1)
    force = [table[f"force_{axis}"][row] for axis in "xyz"]
    assert force == pytest.approx([1e3, 0.0, -1e4], rel=1e-9, abs=1e-6), "what the block does to the base"
    words = repr(result)
    assert "support.0 (base): -1000, " in words and ", 1e+04 N" in words and "peak stress" not in words
    off = 1e3 * 0.4 / 1e4
    assert table["place_x"][row] == pytest.approx(0.1 + off, rel=1e-9)
    assert table["place_z"][row] == pytest.approx(0.1, rel=1e-12)
    assert table["eccentricity"][row] == pytest.approx(off / 0.1, rel=1e-9)
    assert table["area"][row] == pytest.approx(0.02, rel=1e-12)


def test_blocks_of_one_unit_have_no_joint_and_divided_units_have_one():
    whole = laboratory.run(load(leaning("50 kPa"))).resultants
    text = leaning("50 kPa").replace("divisions = [1, 1, 1]", "divisions = [2, 1, 2]")
    text += tables("contact", {"within_units": ELASTIC})
    divided = laboratory.run(load(text, settle__steps=20000)).resultants
    assert len(divided["moment"]) == len(whole["moment"])
    for name in ("area", "force_x", "force_z", "place_x", "eccentricity"):
        assert divided[name][-1] == pytest.approx(whole[name][-1], rel=1e-7), name


def test_a_drive_that_lifts_a_load_works_against_it():
    drive = '[drive]\non = "block"\ndirection = "z"\ndisplacement = "0.02 mm"\nsteps = 4000\n'
    result = laboratory.run(load(leaning("0 Pa", drive)))
    assert result.summary["work_of_loads_after_settling_j"] == {"traction.0": pytest.approx(-1e4 * 2e-5, rel=1e-9)}
    assert result.summary["work_of_drive_j"] > 0.19
    assert "traction.0 -0.2 J (the drive" in repr(result)
    rows, settled = result.history.rows, 6000
    k = int(np.flatnonzero(rows["step"] >= settled)[0])
    both = (
        result.summary["work_of_loads_j"]["traction.0"] - result.summary["work_of_loads_after_settling_j"]["traction.0"]
    )
    assert both == pytest.approx(rows["external_work"][k], rel=2e-3), "while it rose nothing else did work"


def test_forces_that_are_but_rounding_at_the_end_are_measured_by_those_of_the_peak():
    def standing(force: float) -> Standing:
        act = np.array([[force, 0.0, 0.0, 0.0, 2.0 * force, 0.0]])
        return Standing(1, 0.0, act, -act, np.zeros(6), 1e-3 * act[0], np.zeros((0, 3)))

    peak, end = standing(1e3), standing(1e-13)
    assert open_by([end], 1.0) == pytest.approx(1e-3)
    assert open_by([peak, end], 1.0) == pytest.approx(1e-3) and moved_by(end, [peak, end], 1.0) < 1e-18
    assert moved_by(peak, [peak], 0.5) == pytest.approx(1e-3), "moments count over the size: 4 kN here"
    assert open_by([], 1.0) == 0.0


def test_a_floor_bears_the_weight_of_the_specimen_and_none_of_its_own():
    shipped = scene.load("block-rocking", {"solver.duration": "0.01 s"})
    result, weight = laboratory.run(shipped), float(assemble(shipped).model.masses["rigid"][0, 0]) * G
    assert result.summary["reactions"]["end"]["gravity"]["force_n"][2] == pytest.approx(-weight, rel=1e-9)


def test_rounding_of_what_flies_freely_is_not_measured_by_itself():
    """A cube that deforms and spins without weight and supports: all that acts on it is rounding."""
    spin = '[[motion]]\non = "cube"\nspin = ["10 rad/s", "20 rad/s", "30 rad/s"]\n'
    cube = box("cube", (0.0, 0.0, 0.0), (0.2, 0.2, 0.2), "units", 0)
    made = dry([cube], duration=0.1, more=spin, supports=())
    elastic = {"young_modulus": "1 GPa", "poisson_ratio": 0.2, "density": "2000 kg/m^3"}
    made = made.with_({"kinematics": "affine", "material.units": elastic, "gravity": None, "settle": None})
    assert laboratory.run(made).summary["force_balance"] < 1e-9
