"""How near the contacts are to their first damage."""

import numpy as np

from masonry.model import Model


def utilisation(model: Model, seen: np.ndarray) -> float:
    """Largest share of its strength that a contact uses, in tension or in shear; 1 is damage. seen: as in energy.py.

    Strength that is zero, as of rollers, has no share to use. Under constant confinement it grows less than the load.
    """
    _, interfaces, _, bounds = model.groups
    most = 0.0
    for g, interface in enumerate(interfaces):
        if interface.tensile_strength is None:
            continue
        sigma, tau = seen[bounds[g] : bounds[g + 1], 2:4].T
        strength = interface.cohesion - sigma * interface.tan_friction
        shares = [np.divide(tau, strength, out=np.zeros_like(tau), where=strength > 0.0)]
        if np.all(interface.tensile_strength > 0.0):
            shares.append(sigma / interface.tensile_strength)
        most = max(most, *(float(share.max(initial=0.0)) for share in shares))
    return most
