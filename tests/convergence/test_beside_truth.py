"""The study of error bars: what its file says, and where it goes on."""

import json

import pytest

from masonry.scene import load
from verification.studies.error_bars import beside_truth
from verification.studies.error_bars.compared import append, compared_of, lines_of


@pytest.fixture
def small(monkeypatch):
    """A couplet that is run in a blink, of two points along each edge, whatever the seed."""
    couplet = {"base": "couplet", "drive": {"displacement": "0.03 mm"}, "settle": {"steps": 50}}
    monkeypatch.setattr(beside_truth, "scene_of", lambda kind, seed: load(couplet))
    return "couplet"


def test_a_number_reads_as_it_was_written_and_a_scene_in_the_file_is_not_run_again(small, tmp_path, monkeypatch):
    file = tmp_path / "numbers.jsonl"
    rows = beside_truth.numbers_of(small, 3, file)
    lines = list(lines_of(file))
    assert [line["answer"]["key"] for line in lines][:2] == ["peak_stress_pa", "displacement_at_peak_m"]
    assert lines[0]["settings"]["specimen.points_per_edge"]["x"] >= 16
    assert {"not_quasi_static", "energy_balance"} <= {indicator["name"] for indicator in lines[0]["indicators"]}
    again = [compared_of(line) for line in lines]
    assert [(row.real, row.stated, row.holds) for row in again] == [(row.real, row.stated, row.holds) for row in rows]
    monkeypatch.setattr(beside_truth, "compare", lambda *scene: pytest.fail("it was run again"))
    assert [str(row) for row in beside_truth.numbers_of(small, 3, file)] == [str(row) for row in rows]


def test_a_line_that_was_cut_off_is_written_anew(tmp_path):
    file = tmp_path / "numbers.jsonl"
    file.write_text('{"kind": "a", "seed": 1}\n{"kind": "b", "se')
    append(file, ['{"kind": "b", "seed": 2}\n'])
    assert [json.loads(line) for line in file.read_text().splitlines()] == list(lines_of(file))
    assert [line["seed"] for line in lines_of(file)] == [1, 2]
