"""Weight that comes on layer by layer: what rests at the end, in which order, and what friction remembers of it."""

import numpy as np
import pytest

import masonry
from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from masonry.scene import load as load_scene
from tests.scenes import MATERIAL, box, listed, load, specimen, tables

COUNT, SIDE, DENSITY = 4, 0.1, 1900.0
WEIGHT = DENSITY * 9.81 * SIDE**3


STIFFNESS = 1e9 * SIDE**2


def stack(layers: int, kinematics: str = "rigid", more: str = "", settle: str = "steps = 8000"):
    """Blocks on each other and on a held one, 1 m2 of joint for 100; gauges at the top of each."""
    contact = 'normal_stiffness = "1 GPa/m"\nshear_stiffness = "1 GPa/m"'
    boxes = [box(f"b{k}", (0, 0, SIDE * (k - 1)), (SIDE, SIDE, SIDE), "units", k) for k in range(COUNT + 1)]
    gauges = listed("gauge", [f'name = "b{k}"\nat = "b{k}"\ndirection = "-z"' for k in range(1, COUNT + 1)])
    return load(
        f'law = "elastic"\nkinematics = "{kinematics}"\n'
        + specimen(boxes, SIDE**2)
        + tables("material", {"units": MATERIAL})
        + tables("contact", {"unit_unit": contact})
        + listed("support", ['on = "b0"\nfix = "all"'])
        + f'[gravity]\nz = "-9.81 m/s^2"\nlayers = {layers}\n[settle]\n{settle}\n{more}'
        + gauges
    )


@pytest.fixture(scope="module")
def laid():
    return masonry.run(stack(COUNT))


def test_the_lowest_joint_bears_what_has_been_laid_so_far(laid):
    rows = laid.history.rows
    borne = STIFFNESS * rows["b1"] / WEIGHT
    program = assemble(stack(COUNT)).plan
    assert program.layers.shape == (COUNT, 8001)
    come = program.layers.sum(axis=0)[rows["step"].astype(int)]
    assert borne == pytest.approx(come, abs=0.03)
    slot = 4000 / COUNT
    assert [round(float(np.interp(slot * k, rows["step"], come)), 2) for k in (1, 2, 3, 4)] == [1.0, 2.0, 3.0, 4.0]


@pytest.mark.parametrize("kinematics", ["rigid", "tets"])
def test_without_friction_the_end_is_that_of_all_weight_at_once(laid, kinematics):
    settle = f"steps = {8000 if kinematics == 'rigid' else 32000}"
    layered = laid if kinematics == "rigid" else masonry.run(stack(COUNT, kinematics, settle=settle))
    once = masonry.run(stack(1, kinematics, settle=settle))
    for k in range(1, COUNT + 1):
        at_end = layered.history.rows[f"b{k}"][-1]
        assert at_end == pytest.approx(once.history.rows[f"b{k}"][-1], rel=1e-6), k
    known = [sum(COUNT + 1 - j for j in range(1, k + 1)) * WEIGHT / STIFFNESS for k in range(1, COUNT + 1)]
    if kinematics == "rigid":
        assert [laid.history.rows[f"b{k}"][-1] for k in range(1, COUNT + 1)] == pytest.approx(known, rel=1e-6)


def test_the_ledger_closes_and_the_works_of_the_layers_add_up(laid):
    summary, work = laid.summary, laid.summary["work_of_loads_j"]
    assert summary["energy_imbalance"] < 1e-12 and summary["force_balance"] < 1e-9
    assert list(work) == [f"gravity, layer {k}" for k in range(1, COUNT + 1)]
    assert sum(work.values()) == pytest.approx(laid.history.rows["external_work"][-1], rel=1e-3)


def test_a_traction_comes_after_the_last_layer_and_in_full():
    push = '[[traction]]\non = "b4.z+"\nstress = {z = "-1 kPa"}\n'
    result = masonry.run(stack(COUNT, more=push))
    rows, force = result.history.rows, 1e3 * SIDE**2
    before = 4000 * COUNT / (COUNT + 1)
    assert np.interp(before, rows["step"], rows["b1"]) == pytest.approx(COUNT * WEIGHT / STIFFNESS, rel=0.02)
    assert rows["b1"][-1] == pytest.approx((COUNT * WEIGHT + force) / STIFFNESS, rel=1e-6)


def test_a_drive_to_an_accuracy_begins_when_all_layers_are_there():
    drive = '[drive]\non = "b4"\ndirection = "-z"\ndisplacement = "0.01 mm"\naccuracy = "1 %"\n'
    result = masonry.run(stack(COUNT, more=drive))
    assert result.summary["energy_imbalance"] < 1e-12 and result.summary["force_balance"] < 1e-9
    in_series = STIFFNESS / COUNT
    rows = result.history.rows
    settled = rows["force"][rows["step"] == 8000][0]
    assert rows["force"][-1] - settled == pytest.approx(in_series * 1e-5, rel=1e-3)


@pytest.mark.parametrize(
    ("layers", "more", "said"),
    [
        (0, "", "layers"),
        (500, "", "too few for 500 layers of weight; give 10000 or more"),
        (2, "[gravity.tilt]\nabout = 'y'\nangle = '1 deg'\nsteps = 100\n", "leave out history and tilt"),
    ],
)
def test_what_layers_cannot_be_is_said(layers, more, said):
    with pytest.raises(SceneError, match=said):
        stack(layers, more=more)


def test_what_friction_remembers_of_the_order_moves_the_collapse_load_of_wall_1_by_little():
    result = masonry.run(load_scene("wall-tilted", {"gravity.layers": 15}))
    collapse = result.summary["collapse_load"]
    assert 0.630 < collapse["borne"] < collapse["falls"] < 0.6435 and collapse["moving"] == 12
    assert result.summary["energy_imbalance"] < 1e-12
