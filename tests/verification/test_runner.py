"""Cases are run side by side, and each ends as PASS, FAIL, NOT BUILT or ERROR with its reason, whatever it does."""

import math

import pytest

from masonry.errors import SceneError
from tests.verification import samples
from tests.verification.samples import case
from verification import catalogue, runner
from verification.case import Check, Findings, Tolerance
from verification.outcome import judge, off

ENDS = {
    samples.holds: ("PASS", ""),
    samples.off: ("FAIL", "error +2.00e-02, tolerance 1e-03"),
    samples.lacking: ("NOT BUILT", "large rotations"),
    samples.refused: ("ERROR", "SceneError: contact.unit_unit: no law"),
    samples.mistaken: ("ERROR", "ZeroDivisionError"),
    samples.empty: ("FAIL", "no check was made"),
}


@pytest.mark.parametrize("workers", [0, 2])
def test_every_end_of_a_case_has_its_status_and_reason(workers):
    lines = []
    outcomes = runner.run([case(run) for run in ENDS], workers, lines.append)
    assert [o.case.name for o in outcomes] == [run.__name__ for run in ENDS]
    for outcome, (status, reason) in zip(outcomes, ENDS.values(), strict=True):
        assert outcome.status == status and reason in outcome.reason
        assert outcome.seconds >= 0.0
    assert len(lines) == len(ENDS) and "left" in lines[0] and "in all" in lines[-1]


def test_an_error_of_the_code_says_where():
    (outcome,) = runner.run([case(samples.mistaken)], 0)
    assert "samples.py, line" in outcome.reason


def test_a_process_that_dies_or_hangs_costs_its_own_case_only_and_leaves_no_file(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    runs = samples.dying, samples.endless, samples.holds, samples.littering
    dying, endless, holds, littering = runner.run([case(run) for run in runs], 2, limit=10.0)
    assert [o.status for o in (dying, endless, holds, littering)] == ["ERROR", "ERROR", "PASS", "ERROR"]
    assert "exit code 7" in dying.reason and "no result after 10 s" in endless.reason
    assert str(tmp_path) in littering.reason and not list(tmp_path.iterdir())


def test_a_value_that_is_not_a_number_does_not_hold():
    check = Check("x", "1", math.nan, 1.0, Tolerance(1.0, 0.1, ""))
    assert not check.holds and math.isinf(check.used)
    assert judge(Findings([check]))[0] == "FAIL"
    assert judge(Findings([samples.check(1.375e6)], imbalance={"run": math.nan}))[0] == "FAIL"


def test_a_bound_holds_or_not_and_is_never_near_or_loose():
    findings = Findings()
    for value in (0.1, 0.95, math.nan):
        findings.at_most("strength left", "1", value, 0.9, "it must crack")
    kept, broken, unknown = findings.checks
    assert kept.holds and kept.used == 0.0 and not kept.too_loose
    assert not broken.holds and math.isinf(broken.used) and not broken.too_loose
    assert not unknown.holds
    assert judge(Findings([kept]))[0] == "PASS"
    assert judge(Findings([broken])) == ("FAIL", off(broken))
    assert off(broken) == "strength left is 0.95, but may be at most 0.9 (it must crack)"


def test_the_nearest_case_is_suggested():
    known = {"sdof-damping": case(samples.holds, "sdof-damping")}
    with pytest.raises(SceneError, match="no case 'sdof-dampng': did you mean 'sdof-damping'"):
        catalogue.chosen(["sdof-dampng"], known)
    assert catalogue.chosen(["SDOF_damping", "sdof-damping"], known) == [known["sdof-damping"]]


def test_every_case_of_the_catalogue_is_named_and_placed_as_the_report_needs_it():
    areas = (
        *("Contact laws", "Elastic assemblies", "Fracture", "Friction and stability"),
        *("Dynamics", "Invariance", "Quasi-static loading"),
    )
    for name, entry in catalogue.catalogue().items():
        assert name == name.lower() and "_" not in name and " " not in name
        assert entry.area in areas, f"{name}: area '{entry.area}'"
        assert catalogue.formula(entry), f"{name}: say the formula in the docstring of its module"


def test_a_module_without_a_case_is_an_error_and_does_not_vanish(monkeypatch, tmp_path):
    (tmp_path / "without_its_case.py").write_text('"""Lost its last lines."""\n', encoding="utf-8")
    monkeypatch.setattr(catalogue.cases, "__path__", [*catalogue.cases.__path__, str(tmp_path)])
    catalogue.catalogue.cache_clear()
    with pytest.raises(ValueError, match="without_its_case holds no case"):
        catalogue.catalogue()
    catalogue.catalogue.cache_clear()


def test_a_module_may_hold_several_cases_but_no_two_of_one_name(monkeypatch, tmp_path):
    held = "CASES = tuple(Case('twice', '1', 'Twice', 'Dynamics', Findings) for _ in range(2))\n"
    text = '"""A table."""\nfrom verification.case import Case, Findings\n' + held
    (tmp_path / "a_table.py").write_text(text, encoding="utf-8")
    monkeypatch.setattr(catalogue.cases, "__path__", [*catalogue.cases.__path__, str(tmp_path)])
    catalogue.catalogue.cache_clear()
    with pytest.raises(ValueError, match="two cases are called 'twice', one of .*a_table"):
        catalogue.catalogue()
    catalogue.catalogue.cache_clear()


def test_rows_stand_in_the_order_of_the_catalogue():
    rows = ["A10", "2.2", "A9", "2.1", "A9b"]
    assert sorted(rows, key=catalogue._row) == ["2.1", "2.2", "A9", "A9b", "A10"]
