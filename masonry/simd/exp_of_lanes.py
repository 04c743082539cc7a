"""exp of lanes: reduction to |r| <= ln(2)/2 by Cody and Waite, a polynomial of degree 11, relative error 1e-14.

The compiler has no vector library here; calling its exp lane by lane takes four times as long.
"""

import math

from llvmlite import ir
from numba.extending import intrinsic

from masonry.jit.extending import overload
from masonry.simd.arithmetic import Lanes
from masonry.simd.select import where

PER_LOG_2 = 1.4426950408889634
LOG_2_HIGH, LOG_2_LOW = 6.93147180369123816490e-01, 1.90821492927058770002e-10
"""ln(2) in two parts, the first with so few digits that its product with a whole number is exact."""
TO_WHOLE = 6755399441055744.0
"""1.5 * 2^52: added to a small number it leaves the nearest whole number in the last bits."""
C2, C3, C4, C5, C6, C7, C8, C9, C10, C11 = (1.0 / math.factorial(k) for k in range(2, 12))
LEAST, MOST = -708.0, 709.0


@intrinsic
def _scale(context, value, power):
    """Value * 2^n, with n in the last bits of `power`."""

    def generate(context, builder, sig, args):
        bits = ir.VectorType(ir.IntType(64), value.width)
        shift = ir.Constant(bits, [52] * value.width)
        exponent = builder.shl(builder.bitcast(args[1], bits), shift)
        return builder.bitcast(builder.add(builder.bitcast(args[0], bits), exponent), args[0].type)

    return value(value, power), generate


@overload(math.exp)
def _exp(x):
    if not isinstance(x, Lanes):
        return None

    def of_lanes(x):
        within = where(x < LEAST, LEAST, where(x > MOST, MOST, x))
        power = within * PER_LOG_2 + TO_WHOLE
        n = power - TO_WHOLE
        r = (within - n * LOG_2_HIGH) - n * LOG_2_LOW
        r2 = r * r
        low = 1.0 + r + r2 * (C2 + r * C3) + r2 * r2 * (C4 + r * C5)
        high = C6 + r * C7 + r2 * (C8 + r * C9) + r2 * r2 * (C10 + r * C11)
        result = _scale(low + r2 * r2 * r2 * high, power)
        return where(x < LEAST, 0.0, where(x > MOST, math.inf, result))

    return of_lanes
