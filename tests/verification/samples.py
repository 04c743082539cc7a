"""Cases of the kinds that a harness meets: one that holds, one that fails, and those that end in other ways."""

import os
import tempfile
import time

from masonry import scene
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from verification.case import Case, Check, Findings, Line, Plot, RequiredFeature, Tolerance

FRICTION = "c0 + sigma tan(phi0) holds at every step, so rounding alone is left"


def check(value: float, tolerance: float = 1e-3, quantity: str = "peak") -> Check:
    return Check(quantity, "Pa", value, 1.375e6, Tolerance(tolerance, 1e-4, FRICTION))


def couplet() -> Findings:
    findings = Findings()
    result = findings.note("couplet", laboratory.run(scene.load("couplet", {"drive.steps": 4000})))
    findings.checks.append(check(result.summary["peak_stress_pa"]))
    rows = result.history.rows
    findings.plots.append(
        Plot("Shear", "slip [m]", "shear stress [Pa]", (Line("run", rows["displacement"], rows["stress"]),))
    )
    findings.remarks.append("a < b")
    return findings


def off() -> Findings:
    return Findings([check(1.375e6 * 1.02), check(1.375e6 * (1 + 1e-6), 1e-2, "loose one")], imbalance={"push": 1e-6})


def holds() -> Findings:
    return Findings([check(1.375e6 * 1.0004)])


def rough() -> Findings:
    return Findings([check(1.375e6 * (1 + 5e-4)), check(1.375e6 * (1 + 1e-4), 5e-3, "wide one")])


def lacking() -> Findings:
    raise RequiredFeature("large rotations")


def refused() -> Findings:
    raise SceneError("contact.unit_unit: no law")


def mistaken() -> Findings:
    return Findings([check(1.0 / 0.0)])


def dying() -> Findings:
    os._exit(7)


def littering() -> Findings:
    raise RuntimeError(tempfile.mkdtemp())


def endless() -> Findings:
    time.sleep(60.0)
    return Findings()


def empty() -> Findings:
    return Findings()


def case(run, name: str = "", quick: bool = True) -> Case:
    return Case(name or run.__name__, "T1", f"Sample {run.__name__}", "Contact laws", run, quick)
