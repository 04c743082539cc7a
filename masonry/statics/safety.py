"""The factor of safety on friction and cohesion: by what number strengths can be divided before nothing balances."""

from dataclasses import replace

import numpy as np

from masonry.errors import SceneError
from masonry.statics.jammed import jammed
from masonry.statics.no_dilation import standing_without_dilation
from masonry.statics.problem import RigidBodies, RigidContacts, Solution
from masonry.statics.solve import EXACTLY, STANDS, Method, standing

CLOSE = {True: 1e-6, False: 1e-4}
"""Relative width of the bracket at the end, with dilation and without."""
LARGEST = 1e4
"""A factor of safety beyond this, or below one over it, is none."""
ROUGH = 100.0
"""Times its friction, with which it is asked whether any friction holds what is jammed."""


def factor_of_safety(
    bodies: RigidBodies, contacts: RigidContacts, method: Method = EXACTLY, dilation: bool = True
) -> tuple[float, Solution, Solution]:
    """The factor by bisection, the forces at it, and the mechanism just beyond it.

    Friction (its tangent), cohesion and tensile strength are divided by one number; loads stay. Without dilation it is
    no bound (see no_dilation.py). Raises SceneError where no amount of friction makes it stand, where none is needed,
    and where the least of it is enough, as joints are jammed.
    """

    def at(by: float) -> tuple[Solution, bool]:
        weak = contacts.weakened(by)
        if dilation:
            solution = standing(bodies, weak, method)
            return solution, solution.status == "solved" and solution.factor >= STANDS
        flat = standing_without_dilation(bodies, weak, method)
        return flat.solution, flat.converged and flat.solution.factor >= STANDS

    low = high = 1.0
    best, stands = at(1.0)
    if not stands and not dilation and jammed(bodies, contacts.weakened(1.0 / ROUGH), method) is not None:
        raise SceneError(
            "no amount of friction makes it stand without dilation: something there is held only by joints that press "
            "against each other, and no load here makes them press; a run decides"
        )
    worst, stands_at_high = best, stands
    while stands_at_high:
        low, best, high = high, worst, 4.0 * high
        if low > LARGEST:
            raise SceneError(_why_none(bodies, contacts, method))
        worst, stands_at_high = at(high)
    while not stands:
        high, worst, low = low, best, 0.25 * low
        if low < 1.0 / LARGEST:
            raise SceneError("no amount of friction and cohesion makes it stand: joints open, or nothing presses them")
        best, stands = at(low)
    while high > (1.0 + CLOSE[dilation]) * low:
        middle = (low * high) ** 0.5
        solution, holds = at(middle)
        if holds:
            low, best = middle, solution
        else:
            high, worst = middle, solution
    result = best if best.unbalance > worst.unbalance else worst
    both = replace(worst, normal=best.normal, shear=best.shear, gap=max(best.gap, worst.gap))
    return low, best, replace(both, unbalance=result.unbalance, worst=result.worst)


def _why_none(bodies: RigidBodies, contacts: RigidContacts, method: Method) -> str:
    """Why there is no factor of safety where a small part of friction is enough: tried with none at all."""
    smooth = standing(bodies, contacts.weakened(np.inf), method)
    if smooth.status == "solved" and smooth.factor >= STANDS:
        return "it stands without any friction or cohesion, so there is no factor of safety on them"
    if jammed(bodies, contacts, method) is not None:
        return (
            "it stands only if it is jammed: the least friction is enough where joints press hard against each other, "
            "which no load here makes them do, and with none it falls; a run decides"
        )
    return f"less than a share of {1 / LARGEST:g} of its friction and cohesion is enough, but it does not stand without"
