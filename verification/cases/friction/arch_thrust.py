"""The thrust of an arch whose abutment gives way, or is pushed in, by 1 mm: the least, or the greatest, of statics.

            o-----o           hinges of the least thrust: o at the outer end of joint i, high up,
         .'         '.        and * at the inner end of joint j, below it, on either side
        *             *
       /               \\      H (z_i - z_j) = V_i (x_j - x_i) + sum W_k (x_j - x_k),   V_i half the weight above i
   ===|                 |==>
                              least H: the largest over all i, j;  greatest H (o inside, * outside): the smallest

Heyman, The stone skeleton (1966): the arch stands as long as some line of thrust lies in it, and each movement of an
abutment, however small, opens hinges that make the line one of the two extreme ones. Voussoirs have plane faces, and
joints bear no tension; nothing slides at a friction of 0.7. Weights and centroids are those of the voussoirs.
"""

import numpy as np

from masonry.laboratory.result import Result
from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.arches import Arch, greatest_thrust, least_thrust
from verification.scene_runs import result_of

WEIGHT = 2000 * 9.81 * 0.3
"""N/m2: of the scene's stone, times its depth. The radius is 1 m."""
ARCHES = (
    ("semicircle of 15, spread", Arch(15, 0.15), "-1 mm"),
    ("semicircle of 15, pushed in", Arch(15, 0.15), "1 mm"),
    ("8 over 100 degrees, spread", Arch(8, 0.2, float(np.radians(100.0))), "-1 mm"),
)


def moved(arch: Arch, by: str) -> Result:
    """The packaged scene with this arch, its abutment moved."""
    sizes = {"voussoirs": arch.voussoirs, "thickness": f"{arch.thickness} m", "angle": f"{arch.angle!r} rad"}
    return result_of("arch-spread", {f"specimen.{k}": v for k, v in sizes.items()} | {"drive.history": [by]})


def largest_eccentricity(result: Result) -> float:
    """Of the thrust in any joint at the end; 1 is the edge."""
    table = result.resultants
    return float(table["eccentricity"][table["moment"] == "end"].max())


def run() -> Findings:
    """The thrust at the end, the line within the arch, and the thrust under the weight alone between the bounds."""
    findings, lines = Findings(), []
    for words, arch, by in ARCHES:
        result = findings.note(words, moved(arch, by))
        least, greatest = (WEIGHT * bound(arch) for bound in (least_thrust, greatest_thrust))
        limit, rows = least if by.startswith("-") else greatest, result.history.rows
        settled = float(rows["force"][np.flatnonzero(rows["displacement"] == 0.0)[-1]])
        tolerance = Tolerance(
            4e-12,
            1e-12,
            "points at the edges make hinges exact, joints keep their places: how far all has come to rest",
            "limit analysis",
        )
        findings.check(f"{words}: thrust", "N", rows["force"][-1], limit, tolerance)
        reason = "the line of thrust lies in the arch, and touches its edge at the hinges"
        value = largest_eccentricity(result)
        findings.at_most(f"{words}: eccentricity of the thrust, 1 at the edge", "1", value, 1.0 + 1e-9, reason)
        reason = "the safe theorem: any thrust that stands lies between the two"
        findings.at_most(f"{words}: least thrust over that of the weight alone", "1", least / settled, 1.0, reason)
        findings.at_most(f"{words}: thrust of the weight alone over the greatest", "1", settled / greatest, 1.0, reason)
        if arch.voussoirs == ARCHES[0][1].voussoirs:
            travel = np.abs(1e3 * rows["displacement"])
            lines += [Line(words, travel, rows["force"]), Line("by hand", travel[[0, -1]], np.full(2, limit), "dashed")]
    findings.plot("Semicircle of 15 voussoirs", "movement of the abutment (mm)", "thrust (N)", *lines)
    return findings


CASE = Case(
    name="arch-thrust",
    row="A15",
    title="Thrust of an arch whose abutment moves",
    area="Friction and stability",
    run=run,
    quick=True,
    scene="arch-spread",
    no_problems="exact at any setting: hinges at points of contact, and small displacements",
)
