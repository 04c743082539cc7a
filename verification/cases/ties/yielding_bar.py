"""A bar that is pulled beyond its strength and pushed back, with and without compression.

    N = k (e - p),  least <= N <= most,   p grows where N would be more:   k = E A / L,  most = f A
    a tie      least = 0: it goes slack there, and p stays as it is
    a strut    least = -most: it yields there as well
    energies   stored N^2 / (2 k);  taken by yielding, the sum of N dp

The force follows its law to round-off whatever the step, in small displacement and in large, as it is computed from the
elongation of now; what yielding took is N times p.

Reference: by hand.
"""

import numpy as np

from verification import balance
from verification.case import Case, Findings, Line, Tolerance
from verification.scene_runs import run as run_scene

STIFFNESS, MOST = 1e6, 1e3
"""N/m and N, of the bar in the scene."""


def by_hand(elongation: np.ndarray, least: float) -> tuple[np.ndarray, float]:
    """Forces (n,) N, and J that yielding took."""
    plastic = taken = 0.0
    forces = []
    for e in elongation.tolist():
        force = min(max(STIFFNESS * (e - plastic), least), MOST)
        if force > 0.0 or least < 0.0:
            more = e - plastic - force / STIFFNESS
            plastic, taken = plastic + more, taken + force * more
        forces.append(force)
    return np.array(forces), taken


def run() -> Findings:
    """Of ties and struts, in small and large displacement."""
    findings = Findings()
    for words, compression, least in (("tie", False, 0.0), ("strut", True, -MOST)):
        for displacements in ("small", "large"):
            name = f"{words}, {displacements} displacement"
            result = run_scene(
                "block-on-a-bar", {"bar.0.compression": compression, "displacements": displacements}
            ).result
            assert result is not None
            findings.note(name, result)
            rows = result.history.rows
            force, taken = by_hand(rows["displacement"], least)
            off = float(np.abs(rows["bar"] - force).max())
            tolerance = Tolerance(1e-11, 1e-13, "the law of now: rounding")
            findings.check(f"{name}: force, largest difference", "N", off, 0.0, tolerance, scale=MOST)
            tolerance = Tolerance(1e-11, 1e-13, "sums of the law: rounding")
            findings.check(f"{name}: what yielding took", "J", rows["plastic_bars"][-1], taken, tolerance)
            stored = 0.5 * float(rows["bar"][-1]) ** 2 / STIFFNESS
            tolerance = Tolerance(1e-13, 1e-15, "one number: rounding")
            findings.check(f"{name}: stored at the end", "J", rows["elastic_bars"][-1], stored, tolerance, scale=taken)
            quantity = f"{name}: stored and taken less the work, over what was taken"
            findings.at_most(quantity, "1", balance.mismatch(result), 1e-5, "the step in which it begins to yield")
            if displacements == "small":
                findings.plot(f"Force of the {words}", "elongation (mm)", "force (N)",
                              Line("run", 1e3 * rows["displacement"], rows["bar"]),
                              Line("by hand", 1e3 * rows["displacement"], force))  # fmt: skip
    return findings


CASE = Case(
    name="yielding-bar",
    row="A66",
    title="A bar that yields, goes slack and yields again",
    area="Elastic assemblies",
    run=run,
    quick=True,
    scene="block-on-a-bar",
    no_problems="the force of a bar follows its law whatever the step",
)
