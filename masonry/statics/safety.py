"""The factor of safety on friction and cohesion: by what number strengths can be divided before nothing balances."""

from dataclasses import replace

from masonry.errors import SceneError
from masonry.statics.no_dilation import standing_without_dilation
from masonry.statics.problem import Bodies, Contacts, Found
from masonry.statics.solve import EXACTLY, STANDS, Method, standing

CLOSE = {True: 1e-6, False: 1e-4}
"""Relative width of the bracket at the end, with dilation and without."""
LARGEST = 1e4
"""A factor of safety beyond this, or below one over it, is none."""


def factor_of_safety(
    bodies: Bodies, contacts: Contacts, method: Method = EXACTLY, dilation: bool = True
) -> tuple[float, Found, Found]:
    """The factor by bisection, the forces at it, and the mechanism just beyond it.

    Friction (its tangent), cohesion and tensile strength are divided by one number; loads stay. Without dilation it is
    no bound (see no_dilation.py). Raises SceneError where no friction is enough, and where none is needed.
    """

    def at(by: float) -> tuple[Found, bool]:
        weak = contacts.weakened(by)
        if dilation:
            found = standing(bodies, weak, method)
            return found, found.status == "solved" and found.factor >= STANDS
        flat = standing_without_dilation(bodies, weak, method)
        return flat.found, flat.converged and flat.found.factor >= STANDS

    low = high = 1.0
    best, stands = at(1.0)
    worst, beyond = best, stands
    while beyond:
        low, best, high = high, worst, 4.0 * high
        if low > LARGEST:
            raise SceneError("it stands without any friction or cohesion, so there is no factor of safety on them")
        worst, beyond = at(high)
    while not stands:
        high, worst, low = low, best, 0.25 * low
        if low < 1.0 / LARGEST:
            raise SceneError("no friction and no cohesion is enough for it to stand: it does not fall by sliding")
        best, stands = at(low)
    while high > (1.0 + CLOSE[dilation]) * low:
        middle = (low * high) ** 0.5
        found, holds = at(middle)
        if holds:
            low, best = middle, found
        else:
            high, worst = middle, found
    return low, best, replace(worst, normal=best.normal, shear=best.shear)
