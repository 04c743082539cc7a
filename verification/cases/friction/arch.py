"""A semicircular arch of voussoirs under its own weight: the thickness at which it falls.

          .-----.
        .'       '.        t/R at the least (R the mean radius): 0.1075 for an arch that can open anywhere
       /           \\       (Milankovitch 1907); less with few voussoirs, which open at their joints alone
      |             |
    __|__         __|__

Limit analysis (Heyman 1966; Livesley 1978) as a linear program: the arch stands iff forces at the ends of its joints,
that do not pull and keep inside the friction cone, carry its weight. Joints here have their points on the edges and
bear no tension, so the same forces are open to them, and springs without tension find them where there are any. The
load is gravity; the thickness is bisected between 3 % above and 3 % below the program's. Nothing slides at 0.7.
"""

from functools import partial

from verification.case import Case, Findings, Tolerance
from verification.fixtures.arches import least_thickness
from verification.fixtures.thresholds import threshold
from verification.scene_runs import run as run_scene

FRICTION, DENSITY, NORMAL, G = 0.7, 2000.0, 1e11, 9.81
MILANKOVITCH = 0.1075
VOUSSOIRS = (7, 15)

SCENE = "arch-of-voussoirs"


def falls(findings: Findings, voussoirs: int, thickness: float) -> bool:
    """Whether the arch goes on moving: it turns too far, or has gone 30 times as far as its springs let it."""
    ran = run_scene(SCENE, {"specimen.voussoirs": voussoirs, "specimen.thickness": f"{thickness!r} m"})
    result = findings.note(f"{voussoirs} voussoirs, t/R = {thickness:.5f}", ran)
    thrust = DENSITY * G * 1.0 / NORMAL
    return not ran.ok or bool(abs(result.history.frames[-1].corners).max() > 30 * voussoirs * thrust / thickness)


def run() -> Findings:
    """Few voussoirs and many; and the program for so many that the arch can open nearly anywhere."""
    findings = Findings()
    for n in VOUSSOIRS:
        limit = least_thickness(n, FRICTION)
        value, width = threshold(partial(falls, findings, n), 1.03 * limit, 0.97 * limit, 7)
        tolerance = Tolerance(
            2e-3,
            width / limit + 3e-4,
            "the catalogue's bracket of 3 %, halved seven times; springs without tension and forces at the ends of "
            "joints are what the program has too, so nothing else is missing but time to fall in",
            "limit analysis",
        )
        findings.check(f"t/R at which an arch of {n} voussoirs falls", "1", value, limit, tolerance)
    tolerance = Tolerance(
        2e-3, 5e-4, "201 voussoirs do not open quite anywhere; the reference is rounded to four digits"
    )
    value = least_thickness(201, FRICTION, 10)
    findings.check("t/R by the program, 201 voussoirs", "1", value, MILANKOVITCH, tolerance)
    return findings


CASE = Case(
    name="arch",
    row="A15",
    title="A semicircular arch stands or falls",
    area="Friction and stability",
    run=run,
    scene=SCENE,
    no_problems="a yes or no, bisected: the width that is left is the error, and each half of it costs a run",
)
