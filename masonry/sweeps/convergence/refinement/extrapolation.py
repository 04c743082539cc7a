"""Values at several resolutions and what they would be without end: Richardson's extrapolation with the observed order,
and an interval that several fits share.

After P. J. Roache, Verification in Computational Science and Engineering, 1998 (grid convergence index), and L. Eca and
M. Hoekstra, Journal of Computational Physics 262 (2014) 104: a fit where values are monotone, their range where not.
"""

from collections.abc import Sequence
from math import hypot, isclose, log, sqrt
from typing import NamedTuple

from scipy.stats import t as student

USUAL_ORDERS = (1.0, 2.0)
LOWEST_ORDER, HIGHEST_ORDER = 0.5, 2.0
"""Orders of convergence: those of what the program does, and between which an observed one is believed."""
ROUNDING = 1e-9
"""Relative difference of what is the same."""
OF_THREE = 1.25
"""Times the remainder behind three values that their bar reaches to both sides, after Roache."""
OF_TWO = 2.5
"""Times the remainder behind two values, at an order of one, that their bar reaches to both sides."""
WIDENED, GROWING = 1.5, 3.0
"""Times the largest difference that the bar reaches where values swing, and where they run away."""
FLAT = 3.0
"""Times the scatter, below which a difference is none."""


class Estimate(NamedTuple):
    """Value without end less the value of the scene, the half-width of its 95 % interval, and the observed order, None
    where two values or scatter give none."""

    change: float
    half_width: float
    order: float | None = None


def extrapolated(values: Sequence[tuple[float, float]], scatter: float = 0.0) -> Estimate:
    """Of one resolution.

    values   factor of refinement and value, that of the scene (factor 1) among them; at least two. Three have an order
             where they stand at equal ratios; otherwise the two finest count
    scatter  by which runs differ that differ in nothing
    Differences that are no larger than FLAT times the scatter change nothing; a last one that is but rounding has come
    to its end.
    """
    ladder = sorted(values)
    scene = next(value for factor, value in ladder if factor == 1.0)
    differences = [b - a for (_, a), (_, b) in zip(ladder, ladder[1:], strict=False)]
    ratio = ladder[-1][0] / ladder[-2][0]
    so_far = ladder[-1][1] - scene
    if max(map(abs, differences)) <= FLAT * scatter:
        return Estimate(0.0, max(map(abs, differences)))
    if len(ladder) == 2 or not isclose(ratio, ladder[-2][0] / ladder[-3][0]):
        return _of_two(differences[-1], ratio, so_far)
    before, last = differences[-2:]
    if abs(last) <= ROUNDING * abs(ladder[-1][1]):
        return Estimate(so_far, abs(last))
    if before * last > 0.0 and abs(before) > abs(last):
        order = log(before / last) / log(ratio)
        remains = [_remainder(last, ratio, p) for p in (_believed(order), *USUAL_ORDERS)]
        spread = max(abs(remainder - remains[0]) for remainder in remains)
        slower = _remainder(
            before / ratio**HIGHEST_ORDER, ratio, HIGHEST_ORDER
        )  # behind a last one not small by chance
        return Estimate(so_far + remains[0], max(spread, OF_THREE * abs(remains[0]), OF_THREE * abs(slower)), order)
    grows = before * last > 0.0
    return Estimate(so_far, (GROWING if grows else WIDENED) * max(abs(before), abs(last)))


def _of_two(difference: float, ratio: float, so_far: float) -> Estimate:
    """One difference: it goes on with one of the usual orders."""
    first, second = (_remainder(difference, ratio, order) for order in USUAL_ORDERS)
    return Estimate(so_far + 0.5 * (first + second), OF_TWO * abs(first))


def _remainder(difference: float, ratio: float, order: float) -> float:
    """The rest of a geometric series behind its last difference."""
    return difference / (ratio**order - 1.0)


def _believed(order: float) -> float:
    """An order above the highest is chance, and says no more than that values converge."""
    return max(order, LOWEST_ORDER) if order <= HIGHEST_ORDER * (1.0 + ROUNDING) else USUAL_ORDERS[0]


def scatter_bar(differences: Sequence[float]) -> float:
    """Half-width of the 95 % interval of one more difference of two runs, from those of runs that differ in nothing."""
    if len(differences) == 0:
        return 0.0
    mean_square = sum(difference**2 for difference in differences) / len(differences)
    return float(student.ppf(0.975, len(differences))) * sqrt(mean_square)


def together(parts: Sequence[Estimate], interaction: float | None, ratio: float, scatter: float) -> Estimate:
    """All resolutions at once.

    parts        of each resolution alone
    interaction  change of the run in which all were made finer by the ratio, less the sum of their changes alone; None
                 where there is no such run
    """
    change, width = sum(part.change for part in parts), sqrt(sum(part.half_width**2 for part in parts))
    if interaction is not None:
        crossed = _of_two(interaction, ratio, interaction)
        change, width = change + crossed.change, hypot(width, crossed.half_width)
    else:  # errors that multiply: the lesser of them may count once more
        width = hypot(width, sqrt(sum(change**2 for change in sorted(abs(part.change) for part in parts)[:-1])))
    orders = [part.order for part in parts if part.order is not None]
    return Estimate(change, hypot(width, scatter), orders[0] if len(orders) == 1 else None)
