"""A block that rocks on a joint without tension whose toe crushes: its moment against its turn, and the limit of it.

         N = 1 MPa L t            closed      M = kn t L^3/12 th                          up to N L/6
           |                      open        x = sqrt(2 N/(kn t th)),  M = N (L/2 - x/3)
      ____ v ____                 crushed     xe = fc/(kn th),  xp = N/(t fc) - xe/2
     |           |                            M = N L/2 - t fc (xp^2/2 + xe/2 (xp + xe/3))
     |           |--> F           limit       N L/2 (1 - N/(L t fc))
     |           |
    _|___________|_    M = F h, h: height of the middle of the block, which the drive holds; it may turn and rise
        th    |####|
              xe  xp   elastic and crushed part of the pressed length x

Small displacement, law `friction` with a cut-off that bears its strength for ever. Gauss points stand in the middle of
strips: half a strip of the stress block decides, so that the error of the moment is of the order of 1/n, or better.

Reference: stresses over a plane section, by hand.
"""

import numpy as np

from masonry.laboratory.result import Result
from verification.case import Case, Findings, Line, Tolerance
from verification.scene_runs import result_of

SCENE = "rocking-joint"
LENGTH, THICKNESS, STIFFNESS, STRENGTH, HIGH = 1.0, 0.2, 5e10, 5e6, 1.0
FORCE = 1e6 * LENGTH * THICKNESS
LIMIT = 0.5 * FORCE * LENGTH * (1.0 - FORCE / (LENGTH * THICKNESS * STRENGTH))
POINTS = 10


def moment(turn: np.ndarray) -> np.ndarray:
    """N m at a turn (rad) that grows from 0."""
    turn = np.maximum(turn, 1e-300)
    closed = STIFFNESS * THICKNESS * LENGTH**3 / 12.0 * turn
    pressed = np.sqrt(2.0 * FORCE / (STIFFNESS * THICKNESS * turn))
    opened = FORCE * (0.5 * LENGTH - pressed / 3.0)
    elastic = STRENGTH / (STIFFNESS * turn)
    crushed = FORCE / (THICKNESS * STRENGTH) - 0.5 * elastic
    block = 0.5 * crushed**2 + 0.5 * elastic * (crushed + elastic / 3.0)
    full = 0.5 * FORCE * LENGTH - THICKNESS * STRENGTH * block
    return np.where(closed <= FORCE * LENGTH / 6.0, closed, np.where(crushed <= 0.0, opened, full))


def turns_and_moments(result: Result) -> tuple[np.ndarray, np.ndarray]:
    """Rad and N m at the rows of a run after its settling."""
    rows = result.history.rows
    moved = rows["displacement"] > 0.0
    turn = (rows["left"] - rows["right"])[moved] / LENGTH
    return turn, rows["stress"][moved] * result.specimen.section * HIGH


def run() -> Findings:
    """The whole curve with ten points, and its limit."""
    findings = Findings()
    result = findings.note("rocking", result_of(SCENE))
    turn, had = turns_and_moments(result)
    wanted = moment(turn)
    worst = int(np.argmax(np.abs(had - wanted)))
    tolerance = Tolerance(1.2e-2, 8e-3, f"{POINTS} points along the joint")
    quantity = "moment where it differs most, over the limit"
    findings.check(quantity, "N m", had[worst], wanted[worst], tolerance, scale=LIMIT)
    tolerance = Tolerance(5e-3, 1e-3, f"{POINTS} points along the joint")
    findings.check("moment at the end", "N m", had[-1], wanted[-1], tolerance)
    lines = (
        Line("run", 1e3 * turn, 1e-3 * had, "points"),
        Line("closed form", 1e3 * turn, 1e-3 * wanted, "dashed"),
        Line("limit", 1e3 * turn[[0, -1]], 1e-3 * LIMIT * np.ones(2), "dashed"),
    )
    findings.plot("Moment of a joint that rocks", "turn (mrad)", "moment (kN m)", *lines)
    return findings


CASE = Case(
    "rocking-joint-crushed",
    "A76",
    "A joint that rocks on a toe that crushes",
    area="Friction and stability",
    run=run,
    quick=True,
    scene=SCENE,
    problems=("rocking-joint",),
)
