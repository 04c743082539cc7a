"""The self-test of `masonry doctor`: is what this machine computes right, and how fast is it? Ten seconds."""

from collections.abc import Iterator

from masonry.laboratory import machine_speed
from verification.case import Case, Check
from verification.cases.contact_law import tension_by_law
from verification.cases.crushing import areas_of_crushing
from verification.cases.fracture import couplet
from verification.cases.friction import incline
from verification.outcome import CaseOutcome, run_case
from verification.reference_step.speed import measure
from verification.text import failures

LAW = next(case for case in tension_by_law.CASES if case.name == "tension-exponential")
CASES: tuple[Case, ...] = (LAW, areas_of_crushing.CASE, couplet.CASE, incline.CASE)
"""One contact torn and crushed, the couplet of the paper, and friction: each against a closed form, all quick."""
Finding = tuple[str, bool, list[str]]


def findings() -> Iterator[Finding]:
    """Of each part, as it is done: name, whether all is well, and lines that say what came out."""
    for case in CASES:
        outcome = run_case(case)
        yield case.name, outcome.proves, [_passed(outcome)] if outcome.proves else failures(outcome) or [outcome.reason]
    yield _speed()


def _passed(outcome: CaseOutcome) -> str:
    checks = outcome.findings.checks
    nearest = max(checks, key=lambda check: check.used)
    return (
        f"{len(checks)} numbers against closed forms, {outcome.seconds:.1f} s; nearest to its limit: {_said(nearest)}"
    )


def _said(check: Check) -> str:
    unit = f" {check.unit}" if check.unit not in ("", "1") else ""
    if check.is_bound:
        return f"{check.quantity} is {check.value:.7g}{unit}, at most {check.reference:.7g}{unit}"
    return (
        f"{check.quantity} is {check.value:.7g}{unit}, known {check.reference:.7g}{unit}, "
        f"off by {abs(check.error):.1e}, allowed {check.tolerance.limit:.1e}"
    )


def _speed() -> Finding:
    speed = measure()
    if not speed.agree:
        return (
            "speed",
            False,
            ["a wall's forces are not those of the hand-written step: the compiled code is wrong here"],
        )
    machine_speed.keep(speed.ours)
    lines = [
        f"a step takes {speed.ours:.1f} ns per contact point, the one written by hand {speed.by_hand:.1f} ns: "
        f"{speed.ratio:.2f} of it ({speed.points} points, one thread, spread {100 * speed.spread:.0f} %)",
        f"`masonry check` foretells times from now on by that: {machine_speed.ratio():.2f} of those of the machine on "
        "which its costs were measured",
    ]
    return "speed", True, lines
