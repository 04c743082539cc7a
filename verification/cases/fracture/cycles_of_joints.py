"""Opening, closing, pressing, sliding back and forth: three scenes of tets in cycles, against the interface model.

     stress                         joint pulled open from one side: secants to the origin, pressed with all of kn
       |   /\\      /\\               couplet: unloading by ks, friction the other way, peak and residual at -slip
       |  /  \\____/  \\___           two courses: both at once; what one mode has damaged the other one misses
       | / ///   ///
     --+/-------------- place of the drive
       |

The history is the largest opening, the largest slip beyond t_max/ks while the point slips, and plastic slip. On the way
back slip is measured from where the joint was made, not from where it turned: the law's own variable, in both models.
"""

from functools import partial

import numpy as np

from verification.case import Case, Findings
from verification.cases.fracture import couplet_of_tets, eccentric_tension, wallette_of_two_courses
from verification.checks.beside_pair import Allowed, compare
from verification.scene_runs import assembled

UM = 1e-6


def through(*reversals: float, step: float) -> list[float]:
    """Places (m) of the drive on its way from 0 to each reversal, about `step` apart."""
    places, last = [], 0.0
    for reversal in reversals:
        count = max(2, round(abs(reversal - last) / step))
        places += np.linspace(last, reversal, count + 1)[1:].tolist()
        last = reversal
    return places


def run() -> Findings:
    """Curves and nodes of all three."""
    findings = Findings()
    for name, scene, places, allowed in (
        (
            *("opened, pressed, opened, half closed, opened", eccentric_tension),
            through(20 * UM, -3 * UM, 40 * UM, 5 * UM, 60 * UM, step=UM),
            Allowed(elastic=(1e-12, 1e-11), softening=(3e-7, 3e-6), nodes=(2e-6, 1e-5)),
        ),
        (
            *("couplet, back and forth", couplet_of_tets),
            through(60 * UM, -60 * UM, 120 * UM, step=4 * UM),
            Allowed(elastic=(1e-14, 1e-12), softening=(4e-6, 2e-5), nodes=(1e-6, 1e-5)),
        ),
        (
            *("two courses, pulled and pushed", wallette_of_two_courses),
            through(12 * UM, 0.0, 30 * UM, -5 * UM, 60 * UM, step=UM),
            Allowed(elastic=(1e-9, 1e-8), softening=(1e-5, 5e-5), nodes=(1e-7, 1e-6)),
        ),
    ):
        make = partial(assembled, scene.SCENE)
        compare(findings, name, make, scene.conditions, places, allowed, move=3000, wait=1000, parts=8)
    return findings


CASE = Case(
    "cycles-of-joints",
    "A7",
    "Unloading, closing and reversal of slip, against the interface model on the same tets",
    area="Fracture",
    run=run,
    problems=("eccentric-tension", "couplet-of-tets", "two-courses-of-tets"),
)
