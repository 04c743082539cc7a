"""Where the energy goes: the balance of a wall of rigid blocks that cracks and slides, at every row.

    external work = kinetic + elastic + damping + work taken by the contacts            (an identity)
    work taken by the contacts = stored + fracture I + fracture II + friction           (O(dt))

The kinetic energy is v(n-1/2) m v(n+1/2)/2 and every force's work a trapezoid: leapfrog then keeps the first balance at
any step and with any damping. The second compares two sums that know nothing of each other: forces times moves, and the
areas that the laws book.

            4 -> u         five blocks in running bond, 0 and 1 held; weight, tractions on 3 and 4;
          2    3           quasi-static, and in real time; without damping: in the case of all kinds
        0    1

Reference: by hand, the sum of v(n+1/2) - v(n-1/2) = F dt/m times v.
"""

from verification.case import Case, Findings
from verification.checks.ledgers import identity, planted, two_sums
from verification.scene_runs import result_of

SCENE = "energy-of-five-blocks"
SOLVERS = {"scaled masses, damped": "scaled", "real masses, damped": "real"}

EXPECTED = 1.5e-4
"""Difference of the two sums of the dissipation at the finer step, over the first."""


def finer(times: int, **solver: object) -> dict[str, object]:
    """Keys of the scene in so many times its steps, each shorter by as much."""
    keys = {"drive.steps": 3000 * times, "settle.steps": 800 * times, "solver.step_fraction": 0.9 / times}
    return keys | {f"solver.{key}": value for key, value in solver.items()}


def run() -> Findings:
    """Two ways of stepping, each at three steps; the ledger of the coarsest."""
    findings = Findings()
    planted(findings, SCENE)
    for words, masses in SOLVERS.items():
        runs = [result_of(SCENE, finer(times, masses=masses)) for times in (2, 4, 8)]
        identity(findings, words, runs[0], ("elastic_blocks",))
        findings.note(f"{words}, half the step", runs[1])
        findings.note(f"{words}, a quarter of the step", runs[2])
        two_sums(findings, words, runs, EXPECTED)
    return findings


CASE = Case(
    "energy-identity",
    "A21",
    "Where the energy goes: rigid blocks",
    area="Dynamics",
    run=run,
    quick=True,
    scene=SCENE,
    no_problems="an identity: it holds at any setting",
)
