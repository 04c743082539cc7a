"""A small wall in which every term of the energy ledger is at work, and what is asked of the ledger."""

from collections.abc import Sequence

import numpy as np

from masonry.configuration import energy
from masonry.laboratory.result import Result
from verification import balance
from verification.case import Findings, Line, Tolerance
from verification.scene_runs import assembled

TERMS = ("elastic_blocks", "elastic_contacts", "fracture_mode_1", "fracture_mode_2", "friction", "damping", "kinetic")


def identity(findings: Findings, words: str, result: Result, absent: tuple[str, ...] = ()) -> None:
    """The balance at every row, which of its terms are on, and that no dissipation is ever given back."""
    findings.note(words, result)
    rows = result.history.rows
    work = float(np.abs(rows["external_work"]).max())
    on = sum(float(np.abs(rows[term]).max()) > 1e-6 * work for term in TERMS)
    fall = min(float(np.diff(rows[key]).min()) for key in (*balance.DISSIPATED, "damping") if key in rows)
    tolerance = Tolerance(1e-12, 1e-15, "an identity of leapfrog with trapezoids: rounding")
    value = np.abs(balance.residual(rows)).max()
    findings.check(f"{words}: balance of all terms, largest at any row", "J", value, 0.0, tolerance, scale=work)
    tolerance = Tolerance(1e-14, 0.0, "more than 1e-6 of the external work, else the scene shows nothing")
    findings.check(f"{words}: terms that are on", "1", on, len(TERMS) - len(absent), tolerance)
    quantity = f"{words}: dissipation and damping never fall, largest fall"
    findings.check(quantity, "J", min(fall, 0.0), 0.0, Tolerance(1e-12, 1e-15, "rounding of sums"), scale=work)
    lines = tuple(Line(t.replace("_", " "), 1e3 * rows["time"], rows[t]) for t in (*TERMS, "external_work"))
    findings.plot(f"Energies, {words}", "time (ms)", "energy (J)", *lines)


def planted(findings: Findings, scene: str) -> None:
    """A joule put into each of the works that a ledger sums up must be missing in the program's own balance."""
    model = assembled(scene).model
    moving = next(body for body in model.bodies if body is not None)
    for column, name in enumerate(("contacts", "damping", "external")):
        view, still = energy.observe(model), energy.velocities(model)
        before = energy.ledger(model, view, still)["imbalance"]
        moving.work[0, column] += 1.0
        after = energy.ledger(model, view, still)["imbalance"]
        tolerance = Tolerance(1e-12, 1e-15, "a sum of a few numbers: rounding")
        findings.check(f"a joule planted in the work of {name} shows as imbalance", "J", after - before, 1.0, tolerance)


def two_sums(findings: Findings, words: str, runs: Sequence[Result], expected: float) -> None:
    """Dissipation booked by the laws against the work taken less the energy stored: equal as the step, halved from run
    to run, vanishes; `expected` is their difference over the first in the second run.

    Rounding decides in which step a contact starts to soften: over one halving the order comes out between 0.84 and
    1.02, over two between 0.90 and 0.98.
    """
    off = [balance.mismatch(result) for result in runs]
    tolerance = Tolerance(3.0 * expected, expected, "of first order in the step, by what a contact slips in one")
    findings.check(f"{words}: the two sums of the dissipation, over the first", "1", off[1], 0.0, tolerance, scale=1.0)
    tolerance = Tolerance(0.2, 0.05, "each contact starts to soften somewhere in a step, so the constant varies")
    value = float(np.log2(off[0] / off[-1])) / (len(off) - 1)
    findings.check(f"{words}: order of their difference in dt", "1", value, 1.0, tolerance)
