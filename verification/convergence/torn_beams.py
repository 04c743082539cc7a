"""Beams of rigid blocks that a joint tears in two, opened and slid: the scenes of the cases dcb-force and enf.

    dcb-force   half a double cantilever beam, pulled apart at its end
    enf         an end-notched beam in three-point bending

How far these are from beam theory is in the cases; here the loading is held against the slowest one. Both tear by small
jumps, block by block, so that a drive paced by its error would take millions of steps: they are driven at constant
rates, and damped less than the default, which would eat a part of every jump.
"""

from verification.cases.fracture import dcb_force, enf
from verification.problem import RATE, Problem, dampings, steps


def problem(name: str, title: str, scene: str, fine: int) -> Problem:
    """The loading halved four times from `fine` steps, and the damping at a quarter of these."""
    counts = [fine >> k for k in (4, 3, 2, 1, 0)]
    knobs = {RATE: steps(*counts), "damping": dampings({"drive.steps": counts[2]}, 0.8, 0.5, 0.3, 0.2)}
    return Problem(name, title, scene, knobs, shipped=("", ""))


PROBLEMS = (
    problem("dcb-force", "Double cantilever beam", dcb_force.SCENE, 400_000),
    problem("enf", "End-notched beam", enf.SCENE, 400_000),
)
