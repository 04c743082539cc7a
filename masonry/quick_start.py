"""Spares each start a third of a second: Numba asks for scipy's linear algebra, which no step of ours contains."""

import sys


def leave_out_blas() -> None:
    """Load Numba's array functions without all of scipy.linalg, which it imports only to see that it is there.

    A compiled function that does contain a product of matrices still asks for it when it is compiled.
    """
    if "numba.np.arraymath" in sys.modules or "scipy.linalg" in sys.modules:
        return
    from numba.np import linalg

    usual = linalg.ensure_blas
    linalg.ensure_blas = lambda: None
    try:
        from numba.np import arraymath
    finally:
        linalg.ensure_blas = usual
    arraymath.ensure_blas = usual
