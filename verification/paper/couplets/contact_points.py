"""How much depends on the number of contact points: under uniform stress, and where a unit is free to turn."""

from collections.abc import Iterator

from verification.paper.couplets.laws import CONFINEMENTS, words
from verification.paper.couplets.measures import apart, spread, work_to
from verification.paper.experiment import Claim, Done, Run, claim

POINTS = (2, 3, 5, 10, 20)
TURNING, DENSE = "{} law, unit free to turn, {} points along the joint", "5 x 5 points, {}"
_, MIDDLE, HIGH = CONFINEMENTS
SAME, FEW = 1e-3, 0.02
"""Tolerances: curves that are the same, in shares of the peak; peaks that have enough points."""


def runs() -> Iterator[tuple[str, Run]]:
    """Label and run of each."""
    dense = {"law": "exponential", "confinement": MIDDLE, "specimen.points_per_edge": 5}
    yield DENSE.format(MIDDLE), Run("couplet", dense)
    for law in ("brittle", "exponential"):
        for n in POINTS:
            free = {"support.1.fix": ["y"], "specimen.points_per_edge": {"x": n, "y": 2, "z": 2}}
            given = {"law": law, "confinement": HIGH, "drive.displacement": "0.5 mm", **free}
            yield TURNING.format(law, n), Run("couplet", given, pace_check=n == POINTS[-1])


def claims(done: Done) -> list[Claim]:
    """Section 4 on the contact surface, section 8 on the number of contact points."""
    return [uniform(done), points(done)] if DENSE.format(MIDDLE) in done.runs else []


def uniform(done: Done) -> Claim:
    """More points where stress is uniform."""
    rigid, dense = done[f"exponential, {MIDDLE}"], done[DENSE.format(MIDDLE)]
    work = work_to(dense.history.rows, 1e-3) / work_to(rigid.history.rows, 1e-3) - 1.0
    return claim("Two blocks that interact along one surface show the behaviour of the contact itself", "4, Fig. 5",
                 f"25 contact points in place of 4: curve within {SAME:.1%} of the peak",
                 f"{apart(rigid, dense):.1e}; work {work:+.1e}",
                 apart(rigid, dense) <= SAME, "stress is not uniform")  # fmt: skip


def points(done: Done) -> Claim:
    """A unit that may turn: peaks by the number of contact points, brittle and softening."""
    peaks = {law: [done.peak(TURNING.format(law, n)) for n in POINTS] for law in ("brittle", "exponential")}
    spreads = {law: spread(values) for law, values in peaks.items()}
    return claim("Dependency on the number of contact points, as of brittle models, is considerably minimised",
                 "8, second conclusion",
                 f"upper unit free to turn, 1.0 MPa, {words(POINTS, 'd')} points along the joint: peaks spread by less "
                 f"than {FEW:.0%} with softening, and by more than twice that when brittle",
                 "; ".join(f"{law} {words(v / 1e6 for v in peaks[law])} MPa ({spreads[law]:.1%})" for law in peaks),
                 spreads["exponential"] < FEW and spreads["brittle"] > 2.0 * FEW,
                 "the spreads are not that far apart")  # fmt: skip
