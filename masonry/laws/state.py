"""What a contact remembers, and the small readers that make an absent memory cost nothing."""

from typing import NamedTuple

import numpy as np
from numba.extending import register_jitable


class ContactState(NamedTuple):
    """History of C contact points. The optional ones are None in a scene in which no law needs them.

    opening_max   (C,) m, largest opening so far, never below the elastic limit
    intact_n      (C,) share of the tensile strength left, 1 .. 0
    intact_s      (C,) share of the shear strength above the residual left, 1 .. 0
    slip          (C, 3) m, plastic slip
    spent         (C, 3) J/m2 dissipated so far: fracture mode I, fracture mode II, friction
    uplift        (C,) m, opening made by dilation
    gap           (C,) m, opening that stays on elastic unloading
    run           (C,) m, length of the path of plastic slip
    """

    opening_max: np.ndarray
    intact_n: np.ndarray
    intact_s: np.ndarray
    slip: np.ndarray
    spent: np.ndarray
    uplift: np.ndarray | None = None
    gap: np.ndarray | None = None
    run: np.ndarray | None = None


@register_jitable
def read(memory, c):
    """memory[c], or 0 where that memory is absent."""
    if memory is None:
        return 0.0
    return memory[c]


@register_jitable
def add(memory, c, value):
    """memory[c] += value where that memory is present."""
    if memory is not None:
        memory[c] += value
