"""A block that rocks on a patch whose toe crushes, in large displacement: the force that holds it, and what it crushes.

         N = 1 MPa L t, its line stays      x   pressed length: without crushing sqrt(2 N/(kn t th)), else xe + xp
          |                                 a   from the toe to the middle of what it bears: x/3, or
        __v___                                  t fc/N (xp^2/2 + xe/2 (xp + xe/3))
       /      /                             xe = fc/(kn th),  xp = N/(t fc) - xe/2
   F> /      /  turned by th about the      z = (L/2 - x) sin th + h/2 cos th, the height of the middle of the block
     /______/   end of what presses         F = N (L/2 - x + (x - a) cos th)/z
    __________

A patch is looked for again as the block turns, and its faces keep what its points crushed. These lie on rings round its
middle, twenty along an edge: a toe is a step of some of them, and the force is off by 1 %. The energy of crushing by
the stress block, fc t th xp^2/2, wants far more points: it is 30 % too large with these, 60 % with ten. The block turns
about a point of the patch, not about the end of what is crushed; the run says so.

Reference: moments about the toe in the turned shape, and stresses over a plane section, by hand.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.cases.crushing.rocking_joint import FORCE, LENGTH, STIFFNESS, STRENGTH, THICKNESS
from verification.scene_runs import result_of

SCENE, HEIGHT = "rocking-patch", 2.0
OPENS = 2.0 * FORCE / (STIFFNESS * THICKNESS * LENGTH**2)
"""Rad, from which on a part of it is open."""
REASON = "twenty points along an edge of the patch"


def crushed_length(turn: np.ndarray) -> np.ndarray:
    """m, of the toe at its strength; below 0 where nothing crushes."""
    return np.asarray(FORCE / (THICKNESS * STRENGTH) - 0.5 * STRENGTH / (STIFFNESS * turn))


def force_at(turn: np.ndarray) -> np.ndarray:
    """N along x at the middle of the block, from where it opens on, at a turn (rad)."""
    crushed, elastic = crushed_length(turn), STRENGTH / (STIFFNESS * turn)
    opened = np.sqrt(2.0 * FORCE / (STIFFNESS * THICKNESS * turn))
    block = THICKNESS * STRENGTH / FORCE * (0.5 * crushed**2 + 0.5 * elastic * (crushed + elastic / 3.0))
    pressed = np.where(crushed > 0.0, crushed + elastic, opened)
    arm = np.where(crushed > 0.0, block, opened / 3.0)
    height = (0.5 * LENGTH - pressed) * np.sin(turn) + 0.5 * HEIGHT * np.cos(turn)
    return np.asarray(FORCE * (0.5 * LENGTH - pressed + (pressed - arm) * np.cos(turn)) / height)


def run() -> Findings:
    """Force from where it opens to a drift of 1 %, compression of the toe, energy of crushing."""
    findings = Findings()
    result = findings.note("rocking", result_of(SCENE))
    rows = result.history.rows
    turn = np.arcsin(np.maximum(rows["left"] - rows["right"], 0.0) / LENGTH)
    rocks = turn > OPENS
    turn, had, crushing = turn[rocks], rows["force"][rocks], rows["crushing"][rocks]
    wanted, limit = force_at(turn), float(force_at(turn).max())
    worst = int(np.argmax(np.abs(had - wanted)))
    quantity = "force where it differs most, over the largest"
    findings.check(quantity, "N", had[worst], wanted[worst], Tolerance(2e-2, 1e-2, REASON), scale=limit)
    findings.check("force at the end", "N", had[-1], wanted[-1], Tolerance(5e-3, 1.1e-3, REASON))
    pressed = result.summary.compression_max_pa or 0.0
    tolerance = Tolerance(1e-9, 1e-10, "the accuracy of the return to the cut-off")
    findings.check("largest compression", "Pa", pressed, STRENGTH, tolerance)
    by_hand = STRENGTH * THICKNESS * turn[-1] * 0.5 * float(crushed_length(turn[-1:])[0]) ** 2
    share = float(crushing[-1]) / by_hand
    findings.at_most("energy of crushing over that of the stress block", "", share, 1.35, REASON)
    lines = Line("run", 1e3 * turn, 1e-3 * had, "points"), Line("closed form", 1e3 * turn, 1e-3 * wanted, "dashed")
    findings.plot("Force on a block that rocks", "turn (mrad)", "force (kN)", *lines)
    return findings


CASE = Case(
    "rocking-patch-crushed",
    "A77",
    "A block that rocks on a patch whose toe crushes",
    area="Friction and stability",
    run=run,
    scene=SCENE,
    no_problems="the toe is a step of a few points, whose places decide: the error does not fall from one number of "
    "points to the next; its law with their number is that of rocking-joint",
)
