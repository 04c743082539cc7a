"""How a contact answers: the softening mechanism, unless the law's own file brings its own `respond` and `stored`."""

from numba.extending import overload

from masonry.laws import softening
from masonry.laws.door import beside


def respond(shape, interface, c, opening, slip_x, slip_y, slip_z, state):
    """Stresses (Pa: normal, then the three components of shear) of contact c; its state is written only on change."""
    chosen = beside(type(shape), "respond", softening.respond)
    return chosen(shape, interface, c, opening, slip_x, slip_y, slip_z, state)


def stored(shape, interface, c, opening, slip_x, slip_y, slip_z, state):
    """Recoverable energy per area (J/m2) of contact c, from its state alone."""
    chosen = beside(type(shape), "stored", softening.stored)
    return chosen(shape, interface, c, opening, slip_x, slip_y, slip_z, state)


@overload(respond)
def _respond(shape, interface, c, opening, slip_x, slip_y, slip_z, state):
    return beside(shape.instance_class, "respond", softening.respond)


@overload(stored)
def _stored(shape, interface, c, opening, slip_x, slip_y, slip_z, state):
    return beside(shape.instance_class, "stored", softening.stored)
