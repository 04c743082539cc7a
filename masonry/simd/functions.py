"""Functions of mathematics that have no formula for lanes of their own: one lane after the other; `min` and `max`."""

import math
from typing import Any

from numba.extending import overload

from masonry.simd.arithmetic import Lanes
from masonry.simd.each import by_lane
from masonry.simd.select import maximum, minimum

ONE_BY_ONE = (
    *(math.log, math.log10, math.log1p, math.expm1, math.erf),
    *(math.sin, math.cos, math.tan, math.asin, math.acos, math.atan),
    *(math.sinh, math.cosh, math.tanh),
)


def _let(function: Any) -> None:
    """Let a function of one number work on lanes."""

    @overload(function)
    def _of(x):
        if not isinstance(x, Lanes):
            return None
        each = by_lane(function, x.width)
        return lambda x: each((x,))


for _function in ONE_BY_ONE:
    _let(_function)


@overload(max)
def _max(a, b):
    return (lambda a, b: maximum(a, b)) if isinstance(a, Lanes) or isinstance(b, Lanes) else None


@overload(min)
def _min(a, b):
    return (lambda a, b: minimum(a, b)) if isinstance(a, Lanes) or isinstance(b, Lanes) else None


@overload(math.fabs)
def _fabs(x):
    return (lambda x: abs(x)) if isinstance(x, Lanes) else None
