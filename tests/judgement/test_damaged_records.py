"""A summary with values of other types: its file is refused in one message; what a summary does as a table."""

import json
import math

import pytest

from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.laboratory.text import summary_text
from masonry.results.summary import FirstFall, Summary, read_summary
from tests.results.sample import sample


@pytest.mark.parametrize("other", ["abc", 5, [1], True])
def test_what_is_no_record_is_not_there(other):
    keys = ("collapse", "collapse_load", "moving_at_end", "gauges")
    summary = Summary.read({"scene": "couplet", **dict.fromkeys(keys, other)})
    assert all(summary[key] is None for key in keys) and summary.scene == "couplet"


def test_what_is_no_record_of_a_list_or_a_table_is_left_out():
    summary = Summary.read({"gauges": {"top": {"final_m": 1.0}, "a": 1}, "sudden_cracks": [5, {"place": "bed"}]})
    assert summary.gauges is not None and summary.sudden_cracks is not None
    assert [*summary.gauges] == ["top"] and [crack.place for crack in summary.sudden_cracks] == ["bed"]
    assert Summary.read({"sudden_cracks": {"a": 1}}).sudden_cracks is None


WRONG = [
    ({"energy_j": 5}, "energy_j is 5, allowed: a table"),
    ({"cycles": True}, "cycles is true, allowed: a list"),
    ({"steps": "a"}, 'steps is "a", allowed: a whole number'),
    ({"steps": 5.5}, "steps is 5.5, allowed: a whole number"),
    ({"peak_stress_pa": [1.0, 2.0]}, "peak_stress_pa is [1.0, 2.0], allowed: a number"),
    ({"peak_stress_pa": True}, "peak_stress_pa is true, allowed: a number"),
    ({"stopped": 1}, "stopped is 1, allowed: text"),
    ({"interrupted": 0}, "interrupted is 0, allowed: true or false"),
    ({"energy_j": {"friction": "2 J"}}, 'energy_j.friction is "2 J", allowed: a number'),
    ({"cycles": [{"closed": True}, {"dissipated_j": "a"}]}, 'cycles.1.dissipated_j is "a", allowed: true or false or'),
    ({"gauges": {"top": [1.0]}}, "gauges.top is [1.0], allowed: a table"),
    ({"gauges": {"top": {"final_m": "a"}}}, 'gauges.top.final_m is "a", allowed: a number'),
    ({"reactions": {"end": {"support.0": {"force_n": ["a"]}}}}, 'reactions.end.support.0.force_n.0 is "a", allowed'),
    ({"reactions": {"end": {"step": "a"}}}, 'reactions.end.step is "a", allowed: a number or a table'),
    ({"collapse": {"began": {"time_s": None}}}, "collapse.began.time_s is null, allowed: a number"),
    ({"scene": ["a" * 99]}, f'scene is ["{"a" * 38}..., allowed: text'),
]


@pytest.mark.parametrize(("changes", "words"), WRONG)
def test_a_file_with_a_value_of_another_type_is_refused_with_its_key_what_it_is_and_what_is_allowed(
    changes, words, tmp_path
):
    (tmp_path / "summary.json").write_text(json.dumps(Summary(scene="couplet").copy() | changes))
    with pytest.raises(SceneError) as error:
        read_summary(tmp_path / "summary.json")
    assert f"summary.json' is damaged: {words}" in str(error.value) and str(error.value).endswith(
        "; run the scene again"
    )


def test_null_a_whole_number_for_a_number_and_keys_of_newer_versions_are_read(tmp_path):
    keys = {"peak_stress_pa": 5, "steps": None, "energy_j": {"friction": None}, "of_a_newer_version": 5}
    (tmp_path / "summary.json").write_text(json.dumps(keys))
    assert summary_text(Summary.read(read_summary(tmp_path / "summary.json"))).startswith("peak stress")


def test_a_command_ends_with_exit_code_2_and_the_message(tmp_path, capsys):
    sample().save_numbers(tmp_path)
    summary = json.loads((tmp_path / "summary.json").read_text())
    (tmp_path / "summary.json").write_text(json.dumps(summary | {"cycles": 5}))
    assert main(["plot", str(tmp_path)]) == 2
    assert "is damaged: cycles is 5, allowed: a list; run the scene again" in capsys.readouterr().err


def test_a_summary_is_a_table_beside_others_and_json_holds_its_copy():
    fall = FirstFall(block=3, sets=["wall"])
    summary = Summary(scene="couplet", steps=3, collapse=fall)
    assert (summary | {"steps": 4}).steps == 4 and ({"steps": 4, "mine": 1} | summary)["steps"] == 3
    copy = summary.copy()
    copy["steps"] = 5
    assert json.loads(json.dumps(copy))["collapse"]["block"] == 3 and summary.steps == 3
    with pytest.raises(SceneError, match="Summary has no key 'step'; known here: .* did you mean 'steps'"):
        _ = summary | {"step": 4}


def test_without_a_drive_the_peak_is_no_number():
    result = sample()
    result.summary |= {"reactions": {"end": {"support.0": {}}}}
    assert not result.has_drive and all(map(math.isnan, result.peak))
