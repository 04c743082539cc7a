"""The load at which something gives way, found by bisection between a value that stands and one that falls."""

from collections.abc import Callable


def threshold(falls: Callable[[float], bool], stands: float, fails: float, halvings: int) -> tuple[float, float]:
    """(the middle of the last interval, half its width); ValueError where an end does not do what it should."""
    if falls(stands):
        raise ValueError(f"falls at {stands:g} already")
    if not falls(fails):
        raise ValueError(f"stands at {fails:g} still")
    low, high = stands, fails
    for _ in range(halvings):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if falls(middle) else (middle, high)
    return 0.5 * (low + high), 0.5 * abs(high - low)
