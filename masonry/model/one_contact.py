"""One contact of unit area taken along a path by the laws themselves, in Python: nothing is compiled.

The same functions that the step has compiled (`laws.mechanism`), in the order in which `kernels.contact` calls them.
They reckon with numbers of numpy, which divide by zero as compiled code does: a formula may give inf or nan where its
answer is not chosen.
"""

from math import inf
from typing import Any, NamedTuple

import numpy as np

from masonry.laws.mechanism import elastic_trial, return_mapping, stored_energy
from masonry.laws.state import TOUCHING, ContactHistory, Interface


class Path(NamedTuple):
    """What a contact did along N points, after each: all arrays are (N,), of the opening and the slip (m) it was given.

    sigma, tau     Pa, tension positive, shear along the slip
    fracture, friction, stored   J/m2, spent so far in fracture of both modes and in friction; recoverable
    """

    opening: np.ndarray
    slip: np.ndarray
    sigma: np.ndarray
    tau: np.ndarray
    fracture: np.ndarray
    friction: np.ndarray
    stored: np.ndarray


def follow(shape: Any, interface: Interface, opening: np.ndarray, slip: np.ndarray) -> Path:
    """Take a contact that nothing has happened to along openings and slips (m), both (N,)."""
    with np.errstate(all="ignore"):
        return _follow(_of_numpy(shape), _of_numpy(interface), opening, slip)


def _follow(shape: Any, interface: Interface, opening: np.ndarray, slip: np.ndarray) -> Path:
    memory, plastic = _of_numpy(_fresh(interface)), 0.0
    ks = interface.shear_stiffness
    fracture = friction = 0.0
    rows = np.empty((len(opening), 5))
    for k, (e, s) in enumerate(zip(opening, slip, strict=True)):
        tau = ks * (s - plastic)
        sigma, unchanged = elastic_trial(shape, interface, memory, e, tau * tau)
        if not unchanged:
            answer = return_mapping(shape, interface, memory, e, abs(s), abs(tau))
            memory, sigma = answer.memory, answer.sigma
            fracture += answer.mode_1 + answer.mode_2
            friction += answer.friction
            plastic += (1.0 - answer.share) * tau / ks
            tau *= answer.share
        rows[k] = sigma, tau, fracture, friction, stored_energy(shape, interface, memory, e, tau * tau)
    return Path(opening, slip, *rows.T)


def _of_numpy(fields: Any) -> Any:
    """The same NamedTuple with numbers of numpy; None stays."""
    return type(fields)(*(value if value is None else np.float64(value) for value in fields))


def _fresh(interface: Interface) -> ContactHistory:
    """What a contact remembers at first; None where its options need nothing."""
    limit = 0.0 if interface.tensile_strength is None else interface.tensile_strength / interface.normal_stiffness
    return ContactHistory(
        opening_max=inf if interface.tensile_strength is None else max(limit, TOUCHING),
        intact_n=1.0,
        intact_s=1.0,
        secant=interface.normal_stiffness if limit > 0.0 else 0.0,
        uplift=None if interface.tan_dilation is None else 0.0,
        gap=0.0 if interface.elastic_unloading is not None else None,
        run=None if interface.tan_dilation is None else 0.0,
    )
