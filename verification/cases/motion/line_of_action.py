"""A block that rocks under a load on top: one that goes with it, and one whose line of action stays in space.

       N                    pushed at its centroid by F, turned by th about its toe
      _v__
     |    |                 the load goes along:    F = N (b/2 cos th - h sin th) / z
   F>|    | h               it stays where it was:  F = N b/2 / z
     |____|
       b                    z = b/2 sin th + h/2 cos th, the height of the centroid

Work of the load that goes along: N times how far its point sinks. The joint is so stiff that the block is rigid but for
0.2 mm by which its toe gives way.

Reference: moments about the toe, by hand.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.scene_runs import result_of

SCENE, WIDE, HIGH, FORCE, SECTION = "block-pressed-and-pushed", 0.5, 1.0, 20e3, 0.1
LINES = {"moving": "goes along", "fixed": "stays in space"}


def run() -> Findings:
    """The force that holds the block at a drift of 6 %, and the work of the load."""
    findings, curves = Findings(), []
    turn = np.linspace(0.0, 0.08, 801)
    across = 0.5 * WIDE * (1.0 - np.cos(turn)) + 0.5 * HIGH * np.sin(turn)
    up = 0.5 * WIDE * np.sin(turn) + 0.5 * HIGH * np.cos(turn)
    levers = {"moving": 0.5 * WIDE * np.cos(turn) - HIGH * np.sin(turn), "fixed": np.full(len(turn), 0.5 * WIDE)}
    for line, words in LINES.items():
        result = findings.note(words, result_of(SCENE, {"traction.0.line_of_action": line}))
        rows, wanted = result.history.rows, FORCE * levers[line] / up
        place, force = rows["displacement"], rows["stress"] * SECTION
        late = (place > 0.02) & (place < 0.03)
        tolerance = Tolerance(5e-3, 8e-4, "the toe gives way, and the drive is paced roughly")
        reference = np.interp(place[late], across, wanted).mean()
        findings.check(f"mean force from 20 to 30 mm, the load {words}", "N", force[late].mean(), reference, tolerance)
        curves.append(Line(f"run, the load {words}", place, force))
        curves.append(Line(f"by hand, the load {words}", across, wanted, "dashed"))
    findings.plot("Force at the centroid", "displacement (m)", "force (N)", *curves)
    return findings


CASE = Case(
    name="line-of-action",
    row="A60",
    title="A load that goes with a rocking block, and one that stays in space",
    area="Friction and stability",
    run=run,
    scene=SCENE,
    no_problems="the moment of a load is exact at every step; what is left is the error of the drive",
)
