"""What contacts remember: arrays for all of them, plain numbers for one (so that a law never counts references)."""

from typing import Any, NamedTuple

import numpy as np
from numba import types
from numba.extending import overload, register_jitable


class ContactState(NamedTuple):
    """History of C contact points; None where no law of the group needs it (all of it for an elastic group).

    opening_max   (C,) m, largest opening so far, never below the elastic limit
    intact_n      (C,) share of the tensile strength left, 1 .. 0
    intact_s      (C,) share of the shear strength above the residual left, 1 .. 0
    slip          (C, 3) m, plastic slip
    spent         (C, 3) J/m2 dissipated so far: fracture mode I, fracture mode II, friction
    uplift        (C,) m, opening made by dilation
    gap           (C,) m, opening that stays on elastic unloading
    run           (C,) m, length of the path of plastic slip
    """

    opening_max: Any = None
    intact_n: Any = None
    intact_s: Any = None
    slip: Any = None
    spent: Any = None
    uplift: Any = None
    gap: Any = None
    run: Any = None


class Memory(NamedTuple):
    """The history of one contact point, in numbers; units as in ContactState."""

    opening_max: Any
    intact_n: Any
    intact_s: Any
    uplift: Any
    gap: Any
    run: Any


class Answer(NamedTuple):
    """How a contact answers when its history changes.

    sigma      Pa
    share      of the elastic shear stress that is left after the return to the Coulomb line
    memory     its new history
    mode_1, mode_2, friction  J/m2 spent now
    """

    sigma: float
    share: float
    memory: Memory
    mode_1: float
    mode_2: float
    friction: float


def recall(memory, c):
    """memory[c], or None where that memory is absent, so that what depends on it is compiled away."""
    return None if memory is None else memory[c]


@overload(recall)
def _recall(memory, c):
    if isinstance(memory, types.Array):
        return lambda memory, c: memory[c]
    return lambda memory, c: None


def grown(memory, value):
    """Memory + value, or None where it is absent (numbers, not arrays)."""
    return None if memory is None else memory + value


@overload(grown)
def _grown(memory, value):
    if isinstance(memory, types.Float):
        return lambda memory, value: memory + value
    return lambda memory, value: None


@register_jitable
def store(memory, c, value):
    """memory[c] = value where that memory is present."""
    if memory is not None:
        memory[c] = value


@register_jitable
def lift(uplift):
    """Opening made by dilation; 0 where nothing dilates."""
    if uplift is None:
        return 0.0
    return uplift


@register_jitable
def plastic_slip(slip, c):
    """The plastic slip vector of contact c; zero where there is none."""
    if slip is None:
        return 0.0, 0.0, 0.0
    return slip[c, 0], slip[c, 1], slip[c, 2]


@register_jitable
def add_slip(slip, c, x, y, z):
    """Plastic slip grows by a vector."""
    if slip is not None:
        slip[c, 0] += x
        slip[c, 1] += y
        slip[c, 2] += z


@register_jitable
def spend(spent, c, mode_1, mode_2, friction):
    """Book dissipated energy."""
    if spent is not None:
        spent[c, 0] += mode_1
        spent[c, 1] += mode_2
        spent[c, 2] += friction


def fresh(count: int, elastic_limit: np.ndarray, uplift: bool, gap: bool, run: bool) -> ContactState:
    """Memory of contacts that nothing has happened to; elastic_limit (C,) m."""
    return ContactState(
        opening_max=elastic_limit,
        intact_n=np.ones(count),
        intact_s=np.ones(count),
        slip=np.zeros((count, 3)),
        spent=np.zeros((count, 3)),
        uplift=np.zeros(count) if uplift else None,
        gap=np.zeros(count) if gap else None,
        run=np.zeros(count) if run else None,
    )
