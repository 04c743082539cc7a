"""The couplet of the paper, sheared back and forth by the solver, beside its closed form."""

import numpy as np

from masonry import laboratory, scene
from verification.case import Check, Findings, Line, Plot
from verification.closed_forms import Joint
from verification.cyclic_forms import Sheared, followed

COMPRESSION, AREA = 0.5e6, 0.2 * 0.05
JOINT = Joint(beta=2.1 + 0.8 * 4 / 9)
SPENT = ("fracture_mode_1", "fracture_mode_2", "friction")
BOOKED = (1e-5, 1e-6, "the trapezoid of the envelope: second order in the step")
"""Tolerance, expected error and reason of what softening by displacement dissipates."""


Allowed = tuple[float, float, str]


def cycled(findings: Findings, law: str, variable: str, curve: Allowed, spent: Allowed = BOOKED) -> None:
    """A run of the scene couplet-cyclic: its whole curve over the peak, and what it dissipates."""
    of, keys = f"{law}, {variable}", {"law": law, "contact.unit_unit.softening_variable": variable}
    given = scene.load("couplet-cyclic", keys)
    result = findings.note(of, laboratory.run(given))
    rows, settled = result.history.rows, given.settle.steps if given.settle else 0
    moved = rows["step"] > settled
    place, stress = rows["displacement"][moved], rows["stress"][moved]
    wanted, gone = followed(Sheared(law, JOINT, COMPRESSION, variable), place)
    lost = float(sum(rows[key][-1] for key in SPENT))
    findings.checks += [
        Check(f"curve, {of}, largest deviation", "Pa", float(np.abs(stress - wanted).max()), 0.0, "closed form", *curve,
              float(JOINT.peak(COMPRESSION))),
        Check(f"dissipated, {of}", "J", lost, AREA * float(gone[-1]), "closed form", *spent),
    ]  # fmt: skip
    some = slice(None, None, 10)
    lines = (
        Line("couplet", 1e3 * place, 1e-6 * stress),
        Line("closed form", 1e3 * place[some], 1e-6 * wanted[some], "points"),
    )
    findings.plots.append(Plot(f"Couplet, {of}", "slip (mm)", "shear stress (MPa)", lines))
