"""Elastic contact, eqs (5) and (6): sigma = kn un, tau = ks us, without limit; glue, plates and reference runs."""

from typing import NamedTuple

from masonry.laws.state import StressUpdate


class Elastic(NamedTuple):
    """No strength, nothing to soften. (The field keeps the tuple from being empty.)"""

    strength: float = float("inf")


PARAMETERS: dict[str, str] = {}


def elastic_trial(parameters, joint, history, opening, tau_squared):
    """Eq. (5); there is no history to change."""
    return joint.normal_stiffness * opening, True


def return_mapping(parameters, joint, history, opening, total, tau):
    """Never needed; the elastic answer."""
    return StressUpdate(joint.normal_stiffness * opening, 1.0, history, 0.0, 0.0, 0.0)


def stored_energy(parameters, joint, history, opening, tau_squared):
    """All of it is recoverable; without shear stiffness (a frictionless glue) there is no shear to store."""
    normal = 0.5 * joint.normal_stiffness * opening * opening
    if joint.shear_stiffness == 0.0:
        return normal
    return normal + 0.5 * tau_squared / joint.shear_stiffness
