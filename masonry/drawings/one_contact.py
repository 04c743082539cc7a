"""One contact of unit area taken along a path by the laws themselves, in Python: nothing is compiled.

The same functions that the step has compiled (`laws.mechanism`), in the order in which `kernels.contact` calls them.
They reckon with numbers of numpy, which divide by zero as compiled code does: a formula may give inf or nan where its
answer is not chosen.
"""

from math import inf
from typing import Any, NamedTuple

import numpy as np

from masonry.laws.compression_cap import is_within, return_to_cap, strength_left
from masonry.laws.cone import slip_of
from masonry.laws.mechanism import elastic_trial, return_mapping, stored_energy
from masonry.laws.state import TOUCHING, ContactHistory, JointProperties


class Path(NamedTuple):
    """State of a contact after each of N points: all arrays are (N,), of the opening and the slip (m) it was given.

    sigma, tau     Pa, tension positive, shear along the slip
    fracture, friction, stored   J/m2, spent so far in fracture of both modes and in friction; recoverable
    crushing       J/m2, spent so far in crushing
    """

    opening: np.ndarray
    slip: np.ndarray
    sigma: np.ndarray
    tau: np.ndarray
    fracture: np.ndarray
    friction: np.ndarray
    stored: np.ndarray
    crushing: np.ndarray


def follow(parameters: Any, joint: JointProperties, opening: np.ndarray, slip: np.ndarray) -> Path:
    """Take a contact that nothing has happened to along openings and slips (m), both (N,)."""
    with np.errstate(all="ignore"):
        return _follow(_of_numpy(parameters), _of_numpy(joint), opening, slip)


def _follow(parameters: Any, joint: JointProperties, opening: np.ndarray, slip: np.ndarray) -> Path:
    history, plastic = initial_history(joint), 0.0
    closing = hardening = None if joint.compressive_strength is None else np.float64(0.0)
    ks = joint.shear_stiffness
    fracture = friction = crushing = sigma = tau = 0.0
    rows = np.empty((len(opening), 6))
    for k, (e, s) in enumerate(zip(opening, slip, strict=True)):
        before, tau = (sigma, abs(tau)), ks * (s - plastic)
        e = e if closing is None else e + closing
        sigma, unchanged = elastic_trial(parameters, joint, history, e, tau * tau)
        bears = None if closing is None else strength_left(joint, hardening)
        inside = closing is None or is_within(joint, bears, sigma, tau * tau)
        if not (unchanged and inside):
            left = abs(tau)
            if not inside:
                squeezed = return_to_cap(joint, history, closing, hardening, bears, e, sigma, left, before)
                e, left, closing, hardening = squeezed[:4]
                crushing += squeezed.work
            update = return_mapping(parameters, joint, history, e, abs(s), left)
            history, sigma = update.history, update.sigma
            fracture += update.mode_1 + update.mode_2
            friction += update.friction
            fraction = update.fraction * left / abs(tau) if tau else update.fraction
            plastic += slip_of(update, (1.0 - fraction) * tau / ks)
            tau *= fraction
        stored = stored_energy(parameters, joint, history, e, tau * tau)
        rows[k] = sigma, tau, fracture, friction, stored, crushing
    return Path(opening, slip, *rows.T)


def _of_numpy(fields: Any) -> Any:
    """The same NamedTuple with numbers of numpy; None stays."""
    return type(fields)(*(value if value is None else np.float64(value) for value in fields))


def initial_history(joint: JointProperties) -> ContactHistory:
    """Initial history of a contact; None where its options need nothing."""
    limit = 0.0 if joint.tensile_strength is None else joint.tensile_strength / joint.normal_stiffness
    return _of_numpy(
        ContactHistory(
            opening_max=inf if joint.tensile_strength is None else max(limit, TOUCHING),
            intact_n=1.0,
            intact_s=1.0,
            secant=joint.normal_stiffness if limit > 0.0 else 0.0,
            dilation=None if joint.tan_dilation is None else 0.0,
            permanent_opening=0.0 if joint.elastic_unloading is not None else None,
            plastic_slip=None if joint.tan_dilation is None else 0.0,
        )
    )
