"""The one door: the TYPE of a law's tuple picks its functions, in Python and in the compiled step alike.

A law is a NamedTuple in a file of its own beside three plain functions: `tension_intact`, `tension_area`,
`shear_intact`. They are found in the file in which the tuple's class is defined; no list names them. Those of another
package may be written for single numbers, with `if`: `fitting` has them called lane by lane.
"""

import sys
from functools import cache
from inspect import signature

from numba.extending import overload, register_jitable

from masonry.laws.fitting import fitting
from masonry.simd import any_lane, filled, where

DOUBLINGS, HALVINGS = 30, 60
"""Looks at a curve for a slip, from a micrometre to a kilometre."""


def beside(shape_class: type, name: str, default=None):
    """The function `name` in the file that defines the law, or the default."""
    return getattr(sys.modules[shape_class.__module__], name, default)


def word_of(shape) -> str:
    """What a law is called in a message; a law of another package has a hash behind the name of its class."""
    return type(shape).__name__.partition("_")[0].lower()


def tension_intact(shape, interface, opening):
    """Share of the tensile strength left on the envelope at an opening (m) beyond the elastic limit."""
    return beside(type(shape), "tension_intact")(shape, interface, opening)


def tension_area(shape, interface, opening, intact):
    """Work per area (J/m2) under the tension curve from 0 to an opening (m), whose intact share is known."""
    return beside(type(shape), "tension_area")(shape, interface, opening, intact)


def shear_intact(shape, interface, intact, slip, peak, residual, compression):
    """Share of (peak - residual) shear strength left after a slip (m) more, where `intact` was left; stresses in Pa."""
    if by_total_slip(type(shape)):
        return after(shape, interface, intact, slip, peak, residual, compression)
    return beside(type(shape), "shear_intact")(shape, interface, intact, slip, peak, residual, compression)


def shear_curve(shape, interface, slip, peak, residual, compression):
    """The same share at a slip (m) beyond the peak, for a law that knows its curve alone."""
    return beside(type(shape), "shear_intact")(shape, interface, slip, peak, residual, compression)


@cache
def by_total_slip(shape_class: type) -> bool:
    """Whether a law gives its curve in shear over the whole slip, and not what is left of a share."""
    curve = beside(shape_class, "shear_intact")
    return "intact" not in signature(getattr(curve, "py_func", curve)).parameters


@register_jitable
def after(shape, interface, intact, slip, peak, residual, compression):
    """What `shear_intact` answers, by the curve alone: look for the last slip that leaves `intact`, and go on from it.

    By halves, from a micrometre on: as near as numbers come, but with some eighty looks at the curve.
    """
    low, high = filled(0.0, intact), filled(1e-6, intact)
    for _ in range(DOUBLINGS):
        leaves = shear_curve(shape, interface, high, peak, residual, compression) >= intact
        if not any_lane(leaves):
            break
        low, high = where(leaves, high, low), where(leaves, 2.0 * high, high)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        leaves = shear_curve(shape, interface, middle, peak, residual, compression) >= intact
        low, high = where(leaves, middle, low), where(leaves, high, middle)
    return shear_curve(shape, interface, low + slip, peak, residual, compression)


@overload(tension_intact)
def _tension_intact(shape, interface, opening):
    own, each = fitting(beside(shape.instance_class, "tension_intact"), shape, (shape, interface, opening))
    return own or (lambda shape, interface, opening: each((shape, interface, opening)))


@overload(tension_area)
def _tension_area(shape, interface, opening, intact):
    own, each = fitting(beside(shape.instance_class, "tension_area"), shape, (shape, interface, opening, intact))
    return own or (lambda shape, interface, opening, intact: each((shape, interface, opening, intact)))


@overload(shear_intact)
def _shear_intact(shape, interface, intact, slip, peak, residual, compression):
    if by_total_slip(shape.instance_class):
        return after
    given = (shape, interface, intact, slip, peak, residual, compression)
    own, each = fitting(beside(shape.instance_class, "shear_intact"), shape, given)
    return own or (
        lambda shape, interface, intact, slip, peak, residual, compression: each(
            (shape, interface, intact, slip, peak, residual, compression)
        )
    )


@overload(shear_curve)
def _shear_curve(shape, interface, slip, peak, residual, compression):
    given = (shape, interface, slip, peak, residual, compression)
    own, each = fitting(beside(shape.instance_class, "shear_intact"), shape, given)
    return own or (
        lambda shape, interface, slip, peak, residual, compression: each(
            (shape, interface, slip, peak, residual, compression)
        )
    )
