"""`masonry verify`: what it says, where it writes, and the exit code."""

import json

import pytest

from masonry.cli.main import main
from tests.verification import samples
from tests.verification.samples import case
from verification import catalogue


@pytest.fixture(autouse=True)
def cases(monkeypatch):
    known = {
        c.name: c
        for c in (
            *(case(samples.holds, "joint-in-shear"), case(samples.lacking, "large-turns")),
            *(case(samples.off, "joint-in-tension", quick=False), case(samples.refused, "no-law", quick=False)),
        )
    }
    monkeypatch.setattr(catalogue, "catalogue", lambda: known)


def verify(*words: str) -> int:
    return main(["verify", *words, "--workers", "0"])


def test_the_quick_cases_hold_and_what_is_not_built_is_said(capsys):
    assert verify() == 0
    said = capsys.readouterr()
    assert "joint-in-shear" in said.out and "+4.0e-04" in said.out and "joint-in-tension" not in said.out
    assert "Not built:\n  large-turns: needs large rotations" in said.out
    assert "1 of 2 cases hold (1 numbers), 1 not built" in said.out
    assert "[1/2] joint-in-shear" in said.err


def test_no_case_and_cases_that_are_not_built_prove_nothing(monkeypatch, capsys):
    assert verify("large-turns") == 1
    assert "so nothing is proven" in capsys.readouterr().out
    monkeypatch.setattr(catalogue, "catalogue", lambda: {"slow": case(samples.holds, "slow", quick=False)})
    assert verify() == 1
    assert "0 of 0 cases hold (0 numbers), so nothing is proven" in capsys.readouterr().out


def test_what_is_worse_than_expected_and_a_tolerance_from_nowhere_are_said(monkeypatch, capsys):
    monkeypatch.setattr(catalogue, "catalogue", lambda: {"rough": case(samples.rough, "rough")})
    assert verify() == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "Worse than expected" in said and "rough: peak is off by 5.0e-04, expected 1e-04" in said
    assert "Tolerance that does not follow" in said and "rough: wide one: tolerance 5e-03, expected 1e-04" in said


def test_a_failure_says_where_what_it_found_and_what_it_should_be(capsys):
    assert verify("--full") == 1
    said = " ".join(capsys.readouterr().out.split())
    assert "joint-in-tension: peak is 1402500 Pa, but the closed form gives 1375000 Pa: error +2.00e-02" in said
    assert "the energy ledger of push is open by 1.0e-06" in said
    assert "no-law: SceneError: contact.unit_unit: no law" in said
    assert "Too loose" in said and "loose one is off by 1.0e-06, its tolerance is 1e-02" in said


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["joint-in-sheer"], "did you mean 'joint-in-shear'?"),
        (["--full", "joint-in-shear"], "name none beside it"),
        (["--compare", "nowhere.json"], "cannot read records from 'nowhere.json'"),
        (["--compare", "a", "b", "c"], "one or two files"),
        (["--format", "xml"], "invalid choice"),
        (["--out", "/proc/nowhere"], "cannot write records to '/proc/nowhere'"),
        (["--workers", "-1"], "0 (all in this process) or more"),
    ],
)
def test_wrong_words_give_one_message_and_exit_code_2(capsys, words, message):
    assert main(["verify", *words]) == 2
    said = capsys.readouterr()
    assert message in said.err and said.err.count("masonry:") == 1 and not said.out


def test_the_list_names_all_cases_and_runs_none(capsys):
    assert main(["verify", "--list"]) == 0
    said = capsys.readouterr().out
    assert "joint-in-tension" in said and "Sample off" in said and "full" in said


def test_json_and_markdown_are_what_they_say(capsys):
    verify("--format", "json")
    content = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert [r["status"] for r in content] == ["PASS", "NOT BUILT"]
    verify("--format", "md")
    assert "| joint-in-shear | T1 | PASS |" in capsys.readouterr().out


def test_records_and_page_are_written_and_a_later_run_is_compared_with_them(tmp_path, capsys):
    assert verify("joint-in-shear", "--out", str(tmp_path)) == 0
    path = tmp_path / "records.json"
    content = json.loads(path.read_text(encoding="utf-8"))
    path.write_text(json.dumps([r | {"source_hash": "older"} for r in content]), encoding="utf-8")
    assert "Sample holds" in (tmp_path / "verify.html").read_text(encoding="utf-8")
    assert verify("joint-in-shear", "--compare", str(path)) == 0
    assert "no number moved" in capsys.readouterr().out
    moved = tmp_path / "moved.json"
    moved.write_text(json.dumps([r | {"value": 2e6, "source_hash": "older"} for r in content]), encoding="utf-8")
    assert verify("joint-in-shear", "--compare", str(moved)) == 1
    assert main(["verify", "--compare", str(path), str(moved)]) == 1
    assert "Moved" in capsys.readouterr().out


def pressed(done):
    """A case at which somebody presses Ctrl-C, if `done` is still empty."""
    if not done:
        raise KeyboardInterrupt
    return samples.holds()


def test_ctrl_c_keeps_what_is_done_and_the_same_words_with_missing_go_on(tmp_path, monkeypatch, capsys):
    done: list[int] = []
    known = {"first": case(samples.holds, "first"), "second": case(lambda: pressed(done), "second")}
    monkeypatch.setattr(catalogue, "catalogue", lambda: known)
    out = tmp_path / "new" / "folder"
    assert verify("--full", "--out", str(out)) == 130
    said = capsys.readouterr()
    assert "first" in said.out and "1 of 1 cases hold" in said.out
    assert f"1 of 2 cases are done; continue with: masonry verify --full --out {out} --missing" in said.err
    assert [r["case"] for r in json.loads((out / "records.json").read_text())] == ["first"]
    assert "Sample holds" in (out / "verify.html").read_text(encoding="utf-8")
    done.append(1)
    assert verify("--full", "--out", str(out), "--missing") == 0
    assert "1 of 2 cases hold by the records" in capsys.readouterr().err
    assert [r["case"] for r in json.loads((out / "records.json").read_text())] == ["first", "second"]
    assert verify("--full", "--out", str(out), "--missing") == 0
    assert main(["verify", "--missing"]) == 2
    known["second"] = case(samples.off, "second")
    assert verify("second", "--out", str(out)) == 1
    assert verify("--full", "--out", str(out), "--missing") == 1, "a case that failed is run again"


def test_nothing_is_written_where_nothing_was_done(tmp_path, monkeypatch):
    monkeypatch.setattr(catalogue, "catalogue", lambda: {"first": case(lambda: pressed([]), "first")})
    assert verify("--out", str(tmp_path / "new")) == 130
    assert not (tmp_path / "new").exists()
