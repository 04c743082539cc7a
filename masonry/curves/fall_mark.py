"""Where the first block fell, in a curve."""

from collections.abc import Callable
from math import degrees
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from masonry.results.data import ResultData

BEGINS, FALLEN = "the fall begins", "a block has fallen"


def mark_fall(
    panels: list[Any],
    result: "ResultData",
    over: Callable[[np.ndarray], np.ndarray],
    more: str = "",
    begins: bool = True,
) -> None:
    """A line in each panel where the first block had fallen, and a dotted one where the fall began; none without.

    over    from steps to what is drawn across
    more    what is said of the first line besides
    begins  whether the second line is wanted
    """
    if (fallen := result.summary.collapse) is None:
        return
    marks = [(fallen.step, "--", f"{FALLEN}{more}")]
    if begins and (began := fallen.began) is not None:
        tilt = "" if began.tilt_rad is None else f", at {degrees(began.tilt_rad):.4g} deg"
        marks = [(began.step, ":", f"{BEGINS}{tilt}"), *marks]
    for step, style, label in marks:
        place = float(over(np.array([float(step)]))[0])
        for axes in panels:
            axes.axvline(
                place, linestyle=style, color="0.35", linewidth=1.2, label=label if axes is panels[0] else None
            )
