"""records.json grows by version, and two versions can be compared."""

import json

import pytest

from masonry.errors import SceneError
from tests.verification import samples
from tests.verification.samples import case
from verification import records, runner
from verification.case import BOUND
from verification.comparison import compare, last_version


@pytest.fixture(scope="module")
def new() -> list[dict]:
    outcomes = runner.run([case(samples.holds), case(samples.off), case(samples.lacking)], 0)
    return [r for o in outcomes for r in records.records_of(o)]


def older(entries: list[dict], **changed) -> list[dict]:
    return [entry | {"source_hash": "older", **changed} for entry in entries]


def test_there_is_one_record_per_case_and_quantity(new):
    assert [(r["case"], r["quantity"], r["status"]) for r in new] == [
        ("holds", "peak", "PASS"),
        ("off", "peak", "FAIL"),
        ("off", "loose one", "FAIL"),
        ("lacking", None, "NOT BUILT"),
    ]
    assert new[0]["error"] == pytest.approx(4e-4) and new[1]["energy_imbalance"] == 1e-6
    fields = "value reference kind_of_reference seconds steps knobs kinetic_over_internal unbalanced processor packages"
    assert set(fields.split()) <= set(new[0])
    assert new[2]["too_loose"] and not new[0]["too_loose"]


def test_a_new_run_replaces_its_own_records_and_those_of_no_other_version_or_case(new, tmp_path):
    records.save(older(new), tmp_path)
    records.save(new, tmp_path)
    again = [r | {"value": 1.0} for r in new if r["case"] == "off"][:1]
    path = records.save(again, tmp_path)
    content = json.loads(path.read_text(encoding="utf-8"), parse_constant=pytest.fail)
    assert [r["source_hash"] == "older" for r in content] == [True] * 4 + [False] * 3
    assert [(r["case"], r["value"]) for r in content[4:] if r["case"] == "off"] == [("off", 1.0)]
    assert sorted(p.name for p in tmp_path.iterdir()) == ["records.json"]


def test_a_file_that_is_damaged_or_something_else_is_refused_and_left_as_it_is(new, tmp_path):
    for text in ("[{", '{"a": 1}', '[{"a": 1}]'):
        (tmp_path / "records.json").write_text(text, encoding="utf-8")
        with pytest.raises(SceneError, match="holds no records"):
            records.save(new, tmp_path)
        assert (tmp_path / "records.json").read_text(encoding="utf-8") == text
    with pytest.raises(SceneError, match="cannot read"):
        records.load(tmp_path / "none.json")


def test_a_number_that_moved_by_more_than_its_tolerance_is_told_and_others_are_not(new):
    was = older(new)
    was[0] = was[0] | {"value": was[0]["value"] * 1.005}
    was[2] = was[2] | {"value": was[2]["value"] * 1.005}
    (change,) = compare(was, new)
    assert change.bad and change.where == "holds, peak" and "-5.0e-03" in change.sentence


def test_a_value_that_moved_below_its_bound_is_not_told(new):
    bound = new[0] | {"kind_of_reference": BOUND, "reference": 3e6, "tolerance": 0.0}
    assert not compare(older([bound]), [bound | {"value": 0.5 * bound["value"]}])
    (change,) = compare(older([bound]), [bound | {"status": "FAIL"}])
    assert change.bad


def test_a_time_that_changed_by_half_is_told_on_the_same_processor_only(new):
    was, now = older(new, seconds_stepping=1.0), [r | {"seconds_stepping": 1.6} for r in new]
    told = [c.sentence for c in compare(was, now)]
    assert told and all("1.6 times slower" in sentence for sentence in told)
    assert not compare([r | {"processor": "another"} for r in was], now)
    assert not compare(was, [r | {"seconds_stepping": 1.4} for r in new])


def test_a_case_that_no_longer_holds_and_a_quantity_that_is_gone_are_told(new):
    was = older(new)
    was[1] = was[1] | {"status": "PASS"}
    gone = older([new[2] | {"quantity": "old one"}])
    changes = compare([*was, *gone], new)
    assert [(c.where, c.bad) for c in changes] == [("off, peak", True), ("off, old one", True)]


def test_the_last_version_but_one_is_what_a_file_is_compared_with(new):
    both = [*older(new), *new]
    assert last_version(both, records.version_of(new[0])) == older(new)
    assert last_version(both) == new
