"""Elastic contact, eqs (5) and (6): sigma = kn un, tau = ks us, without limit; glue, plates and reference runs."""

from typing import NamedTuple

from masonry.laws.state import StressUpdate


class Elastic(NamedTuple):
    """No strength, nothing to soften. (The field keeps the tuple from being empty.)"""

    strength: float = float("inf")


PARAMETERS: dict[str, str] = {}


def elastic_trial(shape, interface, memory, opening, tau_squared):
    """Eq. (5); there is no history to change."""
    return interface.normal_stiffness * opening, True


def return_mapping(shape, interface, memory, opening, total, tau):
    """Never needed; the elastic answer."""
    return StressUpdate(interface.normal_stiffness * opening, 1.0, memory, 0.0, 0.0, 0.0)


def stored_energy(shape, interface, memory, opening, tau_squared):
    """All of it is recoverable; without shear stiffness (a frictionless glue) there is no shear to store."""
    normal = 0.5 * interface.normal_stiffness * opening * opening
    if interface.shear_stiffness == 0.0:
        return normal
    return normal + 0.5 * tau_squared / interface.shear_stiffness
