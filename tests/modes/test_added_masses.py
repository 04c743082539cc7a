"""Masses that are added to blocks: weight, inertia, time step, limit analysis, modes."""

import numpy as np
import pytest

import masonry
from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from verification.references.swinging_stack import STACK, keys_of
from verification.scene_runs import load

HEAVY = {"on": "block 4", "mass": f"{3.0 * STACK.mass!r} kg"}
REST = {"gravity": {"z": "-9.81 m/s^2"}, "settle.steps": 0}


def stack(*masses, **more):
    return load("stack", keys_of(STACK) | REST | {"mass": list(masses)} | more)


def test_a_mass_is_weight_and_inertia_of_its_blocks():
    plain, heavy = assemble(load("stack", keys_of(STACK) | REST)).model, assemble(stack(HEAVY)).model
    times = heavy.masses["rigid"][1:] / plain.masses["rigid"][1:]
    assert times == pytest.approx(np.array([1.0, 1.0, 1.0, 4.0])[:, None] * np.ones(6), rel=1e-12)
    assert heavy.bodies.rigid.load[4, 2] == pytest.approx(-9.81 * 4.0 * STACK.mass, rel=1e-12)
    assert heavy.bodies.rigid.load[3, 2] == plain.bodies.rigid.load[3, 2]


def test_blocks_share_a_mass_by_their_volumes_and_a_place_names_one():
    boxes = keys_of(STACK)["specimen.box"]
    boxes[2]["size"][2], boxes[3]["origin"][2], boxes[4]["origin"][2] = "0.5 m", "0.75 m", "1.0 m"
    shared = {"on": "blocks at z = 250 mm", "mass": "300 kg"}
    alone = {"on": "blocks at z = 250 mm", "mass": "300 kg", "at": [0, 0, "0.6 m"]}
    for mass, first, second in ((shared, 100.0, 200.0), (alone, 0.0, 300.0)):
        masses = assemble(stack(mass, **{"specimen.box": boxes})).model.masses["rigid"][:, 0]
        assert masses[1:3] == pytest.approx([STACK.mass + first, 2.0 * STACK.mass + second])


def test_a_light_block_with_a_mass_takes_longer_steps_and_no_mass_takes_the_same():
    plain, none = assemble(load("stack", keys_of(STACK) | REST)).model, assemble(stack()).model
    assert plain.dt == none.dt
    every = [{"on": f"block {k}", "mass": f"{3.0 * STACK.mass!r} kg"} for k in range(1, 5)]
    assert assemble(stack(*every)).model.dt == pytest.approx(2.0 * plain.dt, rel=1e-12)


def test_modes_and_the_check_see_it():
    every = [{"on": f"block {k}", "mass": f"{3.0 * STACK.mass!r} kg"} for k in range(1, 5)]
    slow, fast = masonry.modes(stack(*every), 3), masonry.modes(stack(), 3)
    assert slow.frequencies == pytest.approx(0.5 * fast.frequencies)
    assert "150 kg on block 4 of 'block 4', 3 times their own" in str(masonry.check(stack(HEAVY)))


def test_limit_analysis_takes_it_as_weight():
    """A block on another topples at a level force of b/h times the weight: at the same share of it with any mass."""
    rest = {"law": "friction", "contact.unit_unit.tan_friction_angle": 2.0, "settle.steps": 0}
    weight = {"limit": {"pattern": "weight", "direction": "x"}}
    push = {"limit": {"pattern": "force", "on": "block 4", "force": {"x": "1 N"}}}
    light, heavy = stack(**rest, **push), stack(HEAVY, **rest, **push)
    assert masonry.limit(light).factor == pytest.approx(4.0 * STACK.mass * 9.81 * 0.25 / 0.875, rel=1e-6)
    assert masonry.limit(heavy).factor == pytest.approx(7.0 * STACK.mass * 9.81 * 0.25 / 0.875, rel=1e-6)
    assert masonry.limit(stack(HEAVY, **rest, **weight)).factor == pytest.approx(0.25 / (0.5 + 0.375 * 3 / 7), rel=1e-6)


@pytest.mark.parametrize(
    ("mass", "reason"),
    [
        ({"on": "block 4", "mass": "0 kg"}, "out of range"),
        ({"on": "block 4", "mass": "3 kN"}, "is a force"),
        ({"on": "block 4.z+", "mass": "3 kg"}, "whole blocks bear a mass"),
        ({"on": "block 4", "mass": "3 kg", "at": [0, 0, "9 m"]}, "lies in no block of 'block 4'"),
        ({"on": "block 9", "mass": "3 kg"}, "selects nothing"),
    ],
)
def test_what_is_no_mass_is_refused(mass, reason):
    with pytest.raises(SceneError, match=reason):
        assemble(stack(mass))


def test_the_floor_bears_none():
    floor = {"floor": {}, "contact.default": {"normal_stiffness": "1 GPa/m", "shear_stiffness": "1 GPa/m"}}
    with pytest.raises(SceneError, match="the floor does not move"):
        assemble(stack({"on": "floor", "mass": "3 kg"}, displacements="large", **floor))
