"""One case run to its end: whatever happens there becomes an outcome with a reason."""

import time
import traceback

from geometry.blocks import GeometryError
from masonry.errors import SceneError, Stopped
from verification.case import Case, Findings, RequiredFeature
from verification.outcome import Outcome, judge

EXPECTED = (SceneError, GeometryError, Stopped, MemoryError)
"""Errors that say themselves what is wrong; of any other one the place in the code is told as well."""
StressUpdate = tuple[Findings, str, str, float]
"""Findings, status, reason and seconds: an outcome but for its case."""


def run_case(case: Case) -> Outcome:
    """The outcome of a case; raises nothing but KeyboardInterrupt."""
    return Outcome(case, *answer(case))


def answer(case: Case) -> StressUpdate:
    """What a process that runs the case sends back: the case itself stays where it is."""
    begun = time.perf_counter()
    findings = Findings()
    try:
        findings = case.run()
        status, reason = judge(findings)
    except RequiredFeature as lacking:
        status, reason = "NOT BUILT", f"needs {str(lacking) or 'a feature'}"
    except EXPECTED as error:
        status, reason = "ERROR", f"{type(error).__name__}: {error}"
    except Exception as error:
        last = traceback.extract_tb(error.__traceback__)[-1]
        status, reason = "ERROR", f"{type(error).__name__}: {error} ({last.filename}, line {last.lineno})"
    return findings, status, reason, time.perf_counter() - begun
