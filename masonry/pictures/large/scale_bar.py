"""A bar that says how long something is in a picture."""

from typing import Any

import numpy as np

SHARE = 0.25
"""Of the width of a picture, the longest that the bar may be."""
BELOW = 10.0
"""Points between the axes and the bar."""
COLOUR = "0.2"


def draw_scale_bar(axes: Any) -> None:
    """Draw a bar of round length below the left corner of axes whose limits (m) stay."""
    from matplotlib.transforms import offset_copy

    start, right = axes.get_xlim()
    length = round_length(SHARE * abs(right - start))
    end = start + np.sign(right - start) * length
    place = offset_copy(axes.get_xaxis_transform(), axes.figure, y=-BELOW, units="points")
    axes.plot([start, end], [0.0, 0.0], "|-", color=COLOUR, lw=1.5, ms=7.0, transform=place, clip_on=False)
    under = offset_copy(place, axes.figure, y=-0.5 * BELOW, units="points")
    axes.text(0.5 * (start + end), 0.0, words(length), transform=under, ha="center", va="top", fontsize=9, color=COLOUR)


def round_length(longest: float) -> float:
    """The longest length (m) of one, two or five times a power of ten that is not longer."""
    power = float(10.0 ** np.floor(np.log10(longest) + 1e-9))
    return max(digit * power for digit in (1.0, 2.0, 5.0) if digit * power <= longest * (1.0 + 1e-9))


def words(length: float) -> str:
    """A length (m) in the unit that suits it."""
    return f"{length:g} m" if length >= 0.1 else f"{1e3 * length:g} mm"
