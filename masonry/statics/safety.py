"""The factor of safety on friction and cohesion: by what number strengths can be divided before nothing balances."""

from dataclasses import replace

from masonry.errors import SceneError
from masonry.statics.problem import Bodies, Contacts, Found
from masonry.statics.solve import EXACTLY, STANDS, Method, standing

CLOSE = 1e-6
"""Relative width of the bracket at the end."""
LARGEST = 1e4
"""A factor of safety beyond this, or below one over it, is none."""


def factor_of_safety(bodies: Bodies, contacts: Contacts, method: Method = EXACTLY) -> tuple[float, Found, Found]:
    """The factor by bisection, the forces at it, and the mechanism just beyond it.

    Friction (its tangent), cohesion and tensile strength are divided by one number; loads stay. Raises SceneError where
    no friction is enough, and where none is needed.
    """

    def at(by: float) -> Found:
        return standing(bodies, contacts.weakened(by), method)

    def stands(found: Found) -> bool:
        return found.status == "solved" and found.factor >= STANDS

    low = high = 1.0
    best = worst = at(1.0)
    while stands(best) and stands(worst):
        low, best, high = high, worst, 4.0 * high
        if low > LARGEST:
            raise SceneError("it stands without any friction or cohesion, so there is no factor of safety on them")
        worst = at(high)
    while not stands(best):
        high, worst, low = low, best, 0.25 * low
        if low < 1.0 / LARGEST:
            raise SceneError("no friction and no cohesion is enough for it to stand: it does not fall by sliding")
        best = at(low)
    while high > (1.0 + CLOSE) * low:
        middle = (low * high) ** 0.5
        found = at(middle)
        if stands(found):
            low, best = middle, found
        else:
            high, worst = middle, found
    return low, best, replace(worst, normal=best.normal, shear=best.shear)
