"""Collapse without dilation, by a row of limit analyses with friction surfaces that are turned flat: no bound.

Gilbert, M., Casapulla, C., Ahmed, H. M.: Limit analysis of masonry block structures with non-associative frictional
joints using linear programming. Computers & Structures 84 (2006) 873-887.

With friction that dilates, what slides also rises. Here each contact has in turn a surface |T| <= s N + c that is
almost flat (s is a small share of the friction mu), and goes through the point (N, mu N) for the normal force N that
the solutions before have there: c = (mu - s) N. Where N comes to rest, so does the factor, and no contact bears more
than mu N allows. The limit theorems do not hold, so this is neither a lower nor an upper bound, and it need not be the
only answer.
"""

from dataclasses import dataclass, replace

import numpy as np

from masonry.statics.problem import Bodies, Contacts, Found
from masonry.statics.solve import EXACTLY, UPWARD, Method, Range, largest_factor

LEAST_SLOPE, FLATTER = 1e-2, 0.3
"""Slope over friction at the end, and over the slope before on the way there. Flatter ones tell what slides from what
rises so weakly that the normal forces of some walls go to and fro between several answers."""
NEW, PATIENCE = 0.6, 40
"""Share of the last solution in the normal forces that surfaces go through, the rest is of those before; and analyses
after which it falls, by half after 20 more, since what has not come to rest by then goes to and fro."""
MOST, SAME, BEYOND = 100, 1e-6, 1e-6
"""Analyses at most; change of the factor, over the factor, and excess of shear at which they end."""


@dataclass(frozen=True)
class Flat:
    """What the row of analyses came to.

    found      the last one
    factors    of all of them, that with dilation first
    converged  whether the factor came to rest
    excess     largest shear force beyond friction and cohesion, over the largest shear strength of all contacts
    """

    found: Found
    factors: list[float]
    converged: bool
    excess: float


def without_dilation(bodies: Bodies, contacts: Contacts, method: Method = EXACTLY, between: Range = UPWARD) -> Flat:
    """The factor at which the iteration comes to rest."""
    method = replace(method, centred=True)
    found = largest_factor(bodies, contacts, method, between)
    factors, share, normal, converged = [found.factor], 1.0, found.normal, False
    while found.status == "solved" and len(factors) < MOST and not converged:
        share = max(FLATTER * share, LEAST_SLOPE)
        slope = share * contacts.friction
        through = (contacts.friction - slope) * np.maximum(normal, 0.0)
        flatter = replace(contacts, friction=slope, cohesion=contacts.cohesion + through)
        found = largest_factor(bodies, flatter, method, between)
        new = NEW / (1.0 + max(len(factors) - PATIENCE, 0) / 20)
        normal = new * found.normal + (1.0 - new) * normal
        factors.append(found.factor)
        at_rest = abs(factors[-1] - factors[-2]) <= SAME * max(abs(factors[-2]), SAME)
        converged = at_rest and share == LEAST_SLOPE and _excess(contacts, found) <= BEYOND
    return Flat(found, factors, converged, _excess(contacts, found))


def standing_without_dilation(bodies: Bodies, contacts: Contacts, method: Method = EXACTLY) -> Flat:
    """As `standing`, but without dilation: what cannot stand loses ever more of its loads from analysis to analysis."""
    own = replace(bodies, dead=np.zeros_like(bodies.dead), live=bodies.dead)
    return without_dilation(own, contacts, method, (0.0, 1.0))


def _excess(contacts: Contacts, found: Found) -> float:
    """Shear of the polygons beyond what their normal forces allow."""
    loose = ~contacts.solid
    if not loose.any():
        return 0.0
    _, patch = np.unique(contacts.patch[loose], return_inverse=True)
    strength = np.bincount(patch, (contacts.friction * found.normal + contacts.cohesion)[loose])
    shear = np.stack([np.bincount(patch, found.shear[loose, i]) for i in range(3)], axis=1)
    beyond = np.linalg.norm(shear, axis=1) - strength
    return float(max(beyond.max(), 0.0) / max(strength.max(), 1e-300))
