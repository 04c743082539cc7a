"""Several numbers at once: a Numba type for the processor's vectors, so that one formula serves one number or eight.

`Lanes` are 4 or 8 doubles that add, multiply and compare like one; `where` takes the place of `if`. With
MASONRY_LANES=0 the functions of `load_store.py` and `rows.py` hand out plain numbers one by one instead, and the same
kernels, compiled for numbers, do the same work.
"""

from masonry.simd import exp_of_lanes  # noqa: F401  math.exp learns of lanes
from masonry.simd.arithmetic import PLAIN
from masonry.simd.eight_rows import eight_rows
from masonry.simd.gather import gather, gather_corners, put_rows, scatter, take_slopes
from masonry.simd.load_store import EIGHT, FOUR, eight, four, local, or_zero, put, put_where, take, width_of
from masonry.simd.rows import numbers, pack, part, plus, put_row, take_row
from masonry.simd.select import any_lane, below, filled, maximum, minimum, total, unless, where

__all__ = [
    "PLAIN",
    "EIGHT",
    "FOUR",
    "eight",
    "eight_rows",
    "four",
    "width_of",
    "take",
    "put",
    "put_where",
    "or_zero",
    "below",
    "where",
    "filled",
    "maximum",
    "local",
    "minimum",
    "any_lane",
    "total",
    "unless",
    "gather",
    "gather_corners",
    "put_rows",
    "scatter",
    "take_slopes",
    "numbers",
    "pack",
    "part",
    "plus",
    "put_row",
    "take_row",
]
