"""Ways of an import past gaps and overlaps that stopped it: each is tried before it is named."""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from geometry.blocks import GeometryError
from geometry.joints.gaps import Unmended, rounded_up
from geometry.joints.heal import SUSPICIOUS
from geometry.polyhedra.overlaps import Overlapping
from masonry.errors import SceneError

NARROWEST = 1e-3
"""m, of a gap over which joints are tried to be laid."""
ROUNDS = 3
"""Tolerances that are tried, each of them what the last one lacked."""
PATIENCE = 30.0
"""s that trials may take: a large file gets no hint."""


def with_ways_out(error: GeometryError, ways: Sequence[str]) -> GeometryError:
    """The error with what was found to lead past it."""
    if ways:
        return GeometryError(f"{error}; tried: {', or '.join(ways)}")
    return GeometryError(f"{error}; mend it where it was made")


def ways_out(attempt: Callable[[Any], Any], wishes: Any, error: GeometryError, bridging: bool = True) -> list[str]:
    """Options with which an import succeeds, in words; attempt(wishes) imports, or raises GeometryError or SceneError.

    bridging: whether joints over gaps may be tried
    """
    needed, end = needed_by(error), time.monotonic() + PATIENCE
    if needed is None:
        return []

    def refused(**more: Any) -> Exception | None:
        if time.monotonic() > end:
            return TimeoutError()
        try:
            attempt(replace(wishes, **more))
        except (GeometryError, SceneError) as said:
            return said
        return None

    ways, maximum = [], SUSPICIOUS * wishes.tolerance
    tolerance, wider = 0.0, needed
    for _ in range(ROUNDS):
        if not tolerance < wider <= maximum:
            break
        tolerance = wider
        said = refused(tolerance=tolerance)
        if said is None:
            ways.append(f"--tolerance {tolerance * 1e3:.3g}mm mends them")
            break
        wider = needed_by(said) or 0.0
    if not wishes.open_gaps and refused(open_gaps=True) is None:
        ways.append("--open-gaps leaves gaps as they are")
    gap = max(NARROWEST, needed)
    for overlap in (wishes.tolerance, needed) if bridging and wishes.gap is None else ():
        if overlap <= maximum and refused(gap=gap, tolerance=overlap) is None:
            and_more = f" --tolerance {overlap * 1e3:.3g}mm" if overlap > wishes.tolerance else ""
            return [*ways, f"--gap '{gap * 1e3:.3g} mm'{and_more} lays joints between the blocks as they are"]
    return ways


def needed_by(error: Exception) -> float | None:
    """The tolerance (m) that gaps and overlaps ask for, by an error; None for other errors."""
    if isinstance(error, Unmended):
        return error.needed
    if isinstance(error, Overlapping):
        return rounded_up(max(overlap.depth for overlap in error.overlaps))
    return None
