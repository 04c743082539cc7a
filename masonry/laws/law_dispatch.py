"""Dispatch: the TYPE of a law's tuple picks its functions, in Python and in the compiled step alike.

A law is a NamedTuple in a file of its own beside three plain functions: `tension_intact`, `tension_area`,
`shear_intact`. They are found in the file in which the tuple's class is defined; no list names them. Those of another
package may have an `if` in them: their contacts are computed one at a time, unless their file says LANES = True.
"""

import sys
from functools import cache
from inspect import signature
from types import FunctionType, ModuleType
from typing import Any

from numba import njit
from numba.core.errors import NumbaError

from masonry.errors import SceneError
from masonry.jit.extending import overload, register_jitable
from masonry.jit.sources import is_ours
from masonry.simd import any_lane, eight, filled, where

DOUBLINGS, HALVINGS = 30, 60
"""Looks at a curve for a slip, from a micrometre to a kilometre."""
GIVEN_IN_SHEAR = 7
"""What `shear_intact` takes, `intact` among it; one less where a law gives its curve over the whole slip."""


def beside(parameters_class: type, name: str, default=None):
    """The function `name` in the file that defines the law, or the default."""
    return getattr(sys.modules[parameters_class.__module__], name, default)


def word_of(parameters) -> str:
    """Name of a law in a message; a law of another package has a hash behind the name of its class."""
    return type(parameters).__name__.partition("_")[0].lower()


def tension_intact(parameters, joint, opening):
    """Share of the tensile strength left on the envelope at an opening (m) beyond the elastic limit."""
    return beside(type(parameters), "tension_intact")(parameters, joint, opening)


def tension_area(parameters, joint, opening, intact):
    """Work per area (J/m2) under the tension curve from 0 to an opening (m), whose intact share is known."""
    return beside(type(parameters), "tension_area")(parameters, joint, opening, intact)


def shear_intact(parameters, joint, intact, slip, peak, residual, compression):
    """Share of (peak - residual) shear strength left after a slip (m) more, where `intact` was left; stresses in Pa."""
    if by_total_slip(type(parameters)):
        return after(parameters, joint, intact, slip, peak, residual, compression)
    return beside(type(parameters), "shear_intact")(parameters, joint, intact, slip, peak, residual, compression)


def shear_curve(parameters, joint, slip, peak, residual, compression):
    """The same share at a slip (m) beyond the peak, for a law that knows its curve alone."""
    return beside(type(parameters), "shear_intact")(parameters, joint, slip, peak, residual, compression)


@cache
def by_total_slip(parameters_class: type) -> bool:
    """Whether a law gives its curve in shear over the whole slip, and not what is left of a share."""
    curve = beside(parameters_class, "shear_intact")
    return len(signature(getattr(curve, "py_func", curve)).parameters) < GIVEN_IN_SHEAR


@register_jitable
def after(parameters, joint, intact, slip, peak, residual, compression):
    """Value of `shear_intact`, by the curve alone: search for the last slip that leaves `intact`, and on from there.

    By halves, from a micrometre on: as near as numbers come, but with some eighty looks at the curve.
    """
    low, high = filled(0.0, intact), filled(1e-6, intact)
    for _ in range(DOUBLINGS):
        leaves = shear_curve(parameters, joint, high, peak, residual, compression) >= intact
        if not any_lane(leaves):
            break
        low, high = where(leaves, high, low), where(leaves, 2.0 * high, high)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        leaves = shear_curve(parameters, joint, middle, peak, residual, compression) >= intact
        low, high = where(leaves, middle, low), where(leaves, high, middle)
    return shear_curve(parameters, joint, low + slip, peak, residual, compression)


def contacts_at_once(parameters):
    """Value whose type tells a kernel how many contacts of a law to compute at once: `eight()`, or a single number."""
    return 0.0


@overload(contacts_at_once)
def _contacts_at_once(parameters):
    law = parameters.instance_class
    return (lambda parameters: eight()) if beside(law, "LANES", is_ours(law.__module__)) else (lambda parameters: 0.0)


@overload(tension_intact, strict=False)
def _tension_intact(parameters, joint, opening):
    return _compilable("tension_intact", parameters, joint, opening)


@overload(tension_area, strict=False)
def _tension_area(parameters, joint, opening, intact):
    return _compilable("tension_area", parameters, joint, opening, intact)


@overload(shear_intact, strict=False)
def _shear_intact(parameters, joint, intact, slip, peak, residual, compression):
    if by_total_slip(parameters.instance_class):
        return after
    return _compilable("shear_intact", parameters, joint, intact, slip, peak, residual, compression)


@overload(shear_curve, strict=False)
def _shear_curve(parameters, joint, slip, peak, residual, compression):
    return _compilable("shear_intact", parameters, joint, slip, peak, residual, compression)


def _compilable(name: str, *kinds: Any) -> Any:
    """The function `name` of a law for arguments of some Numba types, the first of them that of the law's NamedTuple.

    Raises SceneError, saying why, where the function of another package cannot be compiled.
    """
    curve = beside(kinds[0].instance_class, name)
    if is_ours(curve.__module__):
        return curve
    curve = getattr(curve, "py_func", curve)
    _let_in(sys.modules[curve.__module__])
    try:
        njit(error_model="numpy")(curve).compile(kinds)
    except NumbaError as error:
        said = [line.strip() for line in str(error).splitlines() if line.strip()]
        why = " ".join(line for line in said if not line.startswith(("Failed in", "During:", "File ")))[:400]
        lanes = " for lanes (LANES = True), which have no `if`" if beside(kinds[0].instance_class, "LANES") else ""
        raise SceneError(f"{curve.__module__}.{curve.__name__} cannot be compiled by Numba{lanes}: {why}") from None
    return curve


@cache
def _let_in(module: ModuleType) -> None:
    """Let compiled code call the functions of a module; once for each."""
    for function in vars(module).values():
        if isinstance(function, FunctionType) and function.__module__ == module.__name__:
            register_jitable(function)
