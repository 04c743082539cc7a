"""Joints that press under the dead loads alone."""

import pytest

import masonry
from masonry.errors import SceneError
from masonry.modal_analysis.oscillator import oscillator_of
from masonry.modal_analysis.pressed import pressed
from verification.references.swinging_stack import STACK, boxes, keys_of
from verification.scene_runs import load

DRY = {
    "law": "friction",
    "contact.unit_unit.tan_friction_angle": 0.6,
    "gravity": {"z": "-9.81 m/s^2"},
    "settle.steps": 0,
}


def test_a_stack_under_its_weight_is_closed_and_swings_as_if_glued():
    dry = masonry.modes(load("stack", keys_of(STACK) | DRY), 6, pressed=True)
    assert dry.closed.all() and "takes" in dry.assumed
    assert dry.frequencies == pytest.approx(masonry.modes(load("stack", keys_of(STACK)), 6).frequencies)


def test_points_beyond_the_edge_of_the_pressure_are_open():
    """Four lines of points at 0.215 and 0.085 m from the middle; the resultant acts 0.12 m off it, so that a pressure
    that is linear over all of them ends at 0.174 m, and over three of them at 0.134 m: the fourth is open."""
    force = 0.12 * 9.81 * STACK.mass / (STACK.height / 2.0)
    push = {"traction": [{"on": "block 1.x+", "stress": {"x": f"{force / STACK.depth / STACK.height!r} Pa"}}]}
    more = {"specimen.box": boxes(STACK)[:2], "specimen.points_per_edge": 4}
    oscillator = oscillator_of(load("stack", keys_of(STACK) | DRY | push | more))
    closed = pressed(oscillator).closed
    assert closed.sum() == 12 and (oscillator.joints.point[~closed, 0] < -0.2).all()


def test_joints_that_would_pull_open_and_glue_holds_what_it_can():
    """A beam between two held blocks, with the weight of its middle: the bed beside it pulls at its upper edge."""
    row = [
        {"name": n, "origin": [f"{x} m", "0 m", "0 m"], "size": ["0.4 m", "0.2 m", "0.2 m"], "unit": k}
        for k, (n, x) in enumerate([("left", 0.0), ("middle", 0.4), ("right", 0.8)])
    ]
    scene = {
        "specimen.box": row,
        "support": [{"on": "left", "fix": "all"}, {"on": "right", "fix": "all"}],
        "motion": [{"on": "middle", "velocity": ["1 mm/s", 0, 0]}],
    }
    glue = {"gravity": {"z": "-9.81 m/s^2"}, "settle.steps": 0}
    assert masonry.modes(load("stack", scene | glue), 6, pressed=True).closed.all()
    with pytest.raises(SceneError, match="nothing presses the joints"):
        masonry.modes(load("stack", scene), 6, pressed=True)
    with pytest.raises(SceneError, match="nothing to rest on"):
        hung = {"support": [{"on": "left", "fix": "all"}], "motion": [{"on": "middle", "velocity": ["1 mm/s", 0, 0]}]}
        masonry.modes(load("stack", {"specimen.box": row} | hung | DRY), 6, pressed=True)
