"""A summary whose parts are something else than records: these are not there, and the others are."""

import pytest

from masonry.results.summary import Summary


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
