"""The one door: the TYPE of a law's tuple picks its functions, in Python and in the compiled step alike.

A law is a NamedTuple in a file of its own beside three plain functions: `tension_intact`, `tension_area`,
`shear_intact`. They are found in the file in which the tuple's class is defined; no list names them. Those of another
package may be written for single numbers, with `if`: `fitting` has them called lane by lane.
"""

import sys

from numba.extending import overload

from masonry.laws.fitting import fitting


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


def shear_intact(shape, interface, slip, peak, residual, compression):
    """Share of (peak - residual) shear strength left at a slip (m) beyond the peak; stresses in Pa."""
    return beside(type(shape), "shear_intact")(shape, interface, slip, peak, residual, compression)


@overload(tension_intact)
def _tension_intact(shape, interface, opening):
    own, each = fitting(beside(shape.instance_class, "tension_intact"), shape, (shape, interface, opening))
    return own or (lambda shape, interface, opening: each((shape, interface, opening)))


@overload(tension_area)
def _tension_area(shape, interface, opening, intact):
    own, each = fitting(beside(shape.instance_class, "tension_area"), shape, (shape, interface, opening, intact))
    return own or (lambda shape, interface, opening, intact: each((shape, interface, opening, intact)))


@overload(shear_intact)
def _shear_intact(shape, interface, slip, peak, residual, compression):
    own, each = fitting(
        beside(shape.instance_class, "shear_intact"), shape, (shape, interface, slip, peak, residual, compression)
    )
    return own or (
        lambda shape, interface, slip, peak, residual, compression: each(
            (shape, interface, slip, peak, residual, compression)
        )
    )
