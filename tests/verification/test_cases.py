"""Every case holds: the quick ones here, the others with `pytest -m slow`."""

import pytest

from verification.catalogue import catalogue
from verification.outcome import run_case

CASES = catalogue()
NOT_BUILT = {"paper-experiments"}
"""What the solver, or the paper, lacks; no other case may come to say so."""


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[] if case.quick else pytest.mark.slow) for name, case in CASES.items()]
)
def test_the_case_holds(name):
    outcome = run_case(CASES[name])
    assert outcome.status == ("NOT BUILT" if name in NOT_BUILT else "PASS"), outcome.reason
    assert not outcome.too_loose, [check.quantity for check in outcome.too_loose]
    assert not outcome.ill_set, [check.quantity for check in outcome.ill_set]
    assert not outcome.worse, [check.quantity for check in outcome.worse]
