"""Elastic contact, eqs (5) and (6): sigma = kn un, tau = ks us, without limit; glue, plates and reference runs."""

from typing import NamedTuple


class Elastic(NamedTuple):
    """No strength, nothing to soften. (The field keeps the tuple from being empty.)"""

    strength: float = float("inf")


PARAMETERS: dict[str, str] = {}


def respond(shape, interface, c, opening, slip_x, slip_y, slip_z, state):
    """Eqs (5) and (6)."""
    ks = interface.shear_stiffness
    return interface.normal_stiffness * opening, ks * slip_x, ks * slip_y, ks * slip_z


def stored(shape, interface, c, opening, slip_x, slip_y, slip_z, state):
    """All of it is recoverable."""
    shear = slip_x * slip_x + slip_y * slip_y + slip_z * slip_z
    return 0.5 * (interface.normal_stiffness * opening * opening + interface.shear_stiffness * shear)
