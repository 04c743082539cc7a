"""The balance of a run is added up from its terms: a program that reports a balance of its own is found out."""

from dataclasses import replace

import numpy as np
import pytest

from masonry import scene
from masonry.laboratory import laboratory
from verification import balance
from verification.case import Findings
from verification.outcome import judge


@pytest.fixture(scope="module")
def ran():
    return laboratory.run(scene.load("couplet", {"drive.steps": 2000}))


def changed(result, **columns):
    """The result with other columns; the summary stays as the program told it."""
    return replace(result, history=replace(result.history, rows=result.history.rows | columns))


def test_a_sound_run_closes_to_rounding(ran):
    assert balance.open_by(ran) < 1e-12 and balance.mismatch(ran) == pytest.approx(
        ran.summary["dissipation_mismatch"], rel=1e-9
    )


@pytest.mark.parametrize("term", ["external_work", *balance.TAKEN])
def test_a_term_that_is_wrong_is_found_whatever_the_program_says_of_the_balance(ran, term):
    rows = ran.history.rows
    wrong = rows.get(term, 0.0) + 1e-3 * np.abs(rows["external_work"])
    hidden = changed(ran, **{term: wrong, "imbalance": np.zeros_like(wrong)})
    hidden.summary |= {"energy_imbalance": 0.0}
    findings = Findings()
    findings.note("run", hidden)
    assert not findings.imbalance["run"] < 1e-4
    assert judge(findings)[0] == "FAIL"


def test_a_balance_that_is_not_the_sum_of_its_terms_is_found(ran):
    rows = ran.history.rows
    told = changed(ran, imbalance=rows["imbalance"] + 1e-6 * rows["external_work"])
    assert np.isinf(balance.open_by(told))
