"""What `masonry check` says of the effort is about what a run then takes."""

import pytest

from masonry.assembly.assemble import assemble
from masonry.laboratory import laboratory
from masonry.laboratory.cost import expected
from masonry.scene import load


@pytest.mark.parametrize(
    ("name", "over"),
    [
        ("couplet", {}),
        ("couplet", {"drive.accuracy": 0.003}),
        ("couplet", {"drive.accuracy": None, "drive.steps": 2000}),
        ("couplet-cyclic", {}),
        ("wallette-mode-1", {}),
        ("wallette-mode-1", {"drive.accuracy": 0.05}),
        ("wallette-mode-2", {}),
        ("wallette-cyclic", {}),
    ],
)
def test_steps_and_rows_come_within_a_factor(name, over):
    scene = load(name, over)
    result = laboratory.run(scene)
    ratio = laboratory.check(scene)["steps"] / result.summary["steps"]
    assert 1 / 1.6 < ratio < 1.6
    assert 1 / 1.6 < expected(assemble(scene)).rows / len(result.history.rows["step"]) < 1.6


def test_a_finer_accuracy_is_expected_to_take_longer():
    for name in ("wallette-mode-1", "wallette-cyclic"):
        coarse, fine = (laboratory.check(load(name, {"drive.accuracy": a})) for a in (0.01, 0.001))
        for key in ("steps", "expected_seconds"):
            assert 5.0 < fine[key] / coarse[key] < 10.0
