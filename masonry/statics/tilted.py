"""A tilt: gravity that turns keeps its size, while strengths and other loads do not turn with it."""

from dataclasses import replace

import numpy as np

from masonry.statics.no_dilation import Flat, without_dilation
from masonry.statics.problem import RigidBodies, RigidContacts, Solution
from masonry.statics.solve import Method, Range, largest_factor

SAME, MOST, UPRIGHT = 1e-9, 200, 1e6
"""Change of the factor at which the row of analyses ends, how many there are, and a factor that is as good as none."""
NEAR = 1e-4
"""The same change without dilation, where a load path finds each factor."""


def tilt_factor(bodies: RigidBodies, contacts: RigidContacts, steady: np.ndarray, method: Method) -> Solution:
    """The tangent of the first angle at which there is no equilibrium.

    With all forces over the cosine of the angle, the weight stays, its part sideways is the tangent, and strengths and
    steady loads (B, 6) grow by 1 / cosine. The row of factors rises from that for the cosine 1 to the first one that
    fits its own cosine. In dry joints under weight alone nothing grows, and the first is the answer.
    """
    solution = largest_factor(bodies, contacts, method)
    if not (steady.any() or contacts.has_strength):
        return solution
    for _ in range(MOST):
        if solution.status != "solved" or solution.factor > UPRIGHT:
            break
        grown, before = float(np.hypot(1.0, solution.factor)), solution.factor
        solution = largest_factor(
            replace(bodies, dead=bodies.dead + (grown - 1.0) * steady), contacts.with_strength(grown), method
        )
        if abs(solution.factor - before) <= SAME * max(1.0, before):
            return _in_place(solution, grown)
    return replace(solution, status="unbounded")


def tilt_without_dilation(
    bodies: RigidBodies, contacts: RigidContacts, steady: np.ndarray, method: Method, between: Range
) -> Flat:
    """As `tilt_factor`, of friction that does not dilate: strengths and steady loads are grown from the beginning of
    each load path."""
    grown = 1.0
    for _ in range(MOST):
        dead, strong = bodies.dead + (grown - 1.0) * steady, contacts.with_strength(grown)
        flat = without_dilation(replace(bodies, dead=dead), strong, method, between)
        if not (steady.any() or contacts.has_strength):
            return flat
        before, grown = grown, float(np.hypot(1.0, flat.solution.factor))
        if flat.solution.status != "solved" or flat.solution.factor > UPRIGHT:
            break
        if abs(grown - before) <= NEAR * before:
            bound = tilt_factor(bodies, contacts, steady, method)
            return replace(
                flat,
                solution=_in_place(flat.solution, before),
                with_dilation=bound.factor if bound.status == "solved" else np.inf,
            )
    return replace(flat, solution=replace(flat.solution, status="unbounded"))


def _in_place(solution: Solution, grown: float) -> Solution:
    """The forces at the angle itself."""
    return replace(solution, normal=solution.normal / grown, shear=solution.shear / grown)
