"""Ground that moves beside gravity that turns, weight in layers, tractions that vary, and a drive."""

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.assembly.schedule import tilt_at
from masonry.errors import SceneError
from masonry.scene import load

GROUND = {"x": "0.1 g * sin(2 pi t / 0.05 s)", "y": "0.2 g * sin(2 pi t / 0.1 s)", "duration": "0.1 s"}


def planned(name, **keys):
    return assemble(load(name, {"ground": GROUND, "settle.steps": 300, **keys}))


def factors(assembly):
    """Of both components at each step, and what they should be after the settling."""
    plan, dt = assembly.plan, assembly.model.dt
    load_factors = plan.factors_at(np.arange(plan.steps + 1))
    own = load_factors[len(load_factors) - 2 :]
    half = dt * np.arange(plan.steps - plan.settle + 1)
    wanted = [np.diff(motion.velocity_at(half)) / dt for motion in assembly.scene.shaken.motions.values()]
    return own, plan.settle, np.array(wanted)


def require_all(assembly):
    own, settle, wanted = factors(assembly)
    assert np.abs(own[:, : settle + 1]).max() == 0.0
    assert own[:, settle + 1 :] == pytest.approx(wanted, abs=1e-9)
    assert len(assembly.model.varying) == len(assembly.plan.load_factors)


def test_gravity_that_turns_keeps_its_angle():
    tilt = {"about": "y", "angle": "5 deg", "duration": "0.2 s"}
    assembly = planned("arch", **{"gravity.tilt": tilt})
    require_all(assembly)
    angle = tilt_at(assembly.scene, assembly.plan, np.array([0, assembly.plan.steps]))
    assert np.degrees(angle) == pytest.approx([0.0, 5.0], abs=1e-6)


def test_weight_in_layers_has_come_before_the_ground_moves():
    require_all(planned("wall-tilted", **{"gravity.layers": 4, "limit": None}))


def test_a_traction_that_varies_goes_on_beside_it():
    wave = {"on": "top.z+", "stress": {"z": "-0.1 MPa"}, "history": "1 + 0.2 * sin(20 pi t / 1 s)", "duration": "0.3 s"}
    drive = {"drive.accuracy": None, "drive.rate": "1 m/s"}
    assembly = planned("couplet", **drive, traction=[wave])
    require_all(assembly)


def test_a_drive_with_an_accuracy_is_refused():
    with pytest.raises(SceneError, match="drive.accuracy: takes no time; beside .ground. give drive.rate"):
        load("couplet", {"ground": GROUND})
