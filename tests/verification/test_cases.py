"""Every case holds: the quick ones here, the others with `pytest -m slow`."""

import pytest

from verification.catalogue import catalogue
from verification.worker import run_case

CASES = catalogue()


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[] if case.quick else pytest.mark.slow) for name, case in CASES.items()]
)
def test_the_case_holds(name):
    outcome = run_case(CASES[name])
    assert outcome.status in ("PASS", "NOT BUILT"), outcome.reason
    assert not outcome.too_loose, [check.quantity for check in outcome.too_loose]
