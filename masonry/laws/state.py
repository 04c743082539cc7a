"""The history of contacts: arrays for all of them, plain numbers for one (so that a law never counts references)."""

from typing import Any, NamedTuple

import numpy as np
from numba import types

from masonry.jit.extending import overload
from masonry.simd.rows import aligned

TOUCHING = 1e-9
"""m: a contact that stands open by no more than this counts as closed. It is far above the rounding of displacements
and far below an opening that matters; without tensile strength it is where faces come apart."""


class ContactState(NamedTuple):
    """History of C contact points; None where no law of the group needs it (all of it for an elastic group).

    opening_max        (C,) m, largest opening so far, never below the elastic limit or TOUCHING
    intact_n           (C,) share of the tensile strength left, 1 .. 0
    intact_s           (C,) share of the shear strength above the residual left, 1 .. 0
    secant             (C,) Pa/m, stiffness in tension on the way back: follows from the three above, kept so that no
                       step divides; 0 where there is no strength, or elastic unloading
    slip               (C, 3) m, plastic slip
    dissipated         (C, 3) J/m2 so far: fracture mode I, fracture mode II, friction
    dilation           (C,) m, opening made by dilation
    permanent_opening  (C,) m, opening that stays on elastic unloading
    plastic_slip       (C,) m, length of the path of plastic slip
    crushed            (C, 3) plastic closing (m), hardening of the cap (m), and what crushing took (J/m2)
    """

    opening_max: Any = None
    intact_n: Any = None
    intact_s: Any = None
    secant: Any = None
    slip: Any = None
    dissipated: Any = None
    dilation: Any = None
    permanent_opening: Any = None
    plastic_slip: Any = None
    crushed: Any = None


class ContactHistory(NamedTuple):
    """The history of one contact point, in numbers; units as in ContactState."""

    opening_max: Any
    intact_n: Any
    intact_s: Any
    secant: Any
    dilation: Any
    permanent_opening: Any
    plastic_slip: Any


class StressUpdate(NamedTuple):
    """How a contact answers when its history changes.

    sigma      Pa
    fraction   of the elastic shear stress that is left after the return to the Coulomb line
    history    its new history
    mode_1, mode_2, friction  J/m2 dissipated now
    """

    sigma: float
    fraction: float
    history: ContactHistory
    mode_1: float
    mode_2: float
    friction: float


class RisingUpdate(NamedTuple):
    """A StressUpdate of a contact that dilates.

    floats  whether nothing holds it: what it loses of the stress is no slip
    """

    sigma: float
    fraction: float
    history: ContactHistory
    mode_1: float
    mode_2: float
    friction: float
    floats: Any


def grown(history, value):
    """History + value, or None where it is absent (numbers, not arrays)."""
    return None if history is None else history + value


@overload(grown)
def _grown(history, value):
    if not isinstance(history, types.NoneType):
        return lambda history, value: history + value
    return lambda history, value: None


def fresh(
    elastic_limit: np.ndarray,
    normal_stiffness: np.ndarray,
    dilates: bool,
    permanent_opening: bool,
    crushes: bool = False,
) -> ContactState:
    """State of contacts that nothing has happened to; elastic_limit (C,) m, normal_stiffness (C,) Pa/m."""
    count = len(elastic_limit)
    none = np.zeros(count)
    return ContactState(
        opening_max=aligned(np.maximum(elastic_limit, TOUCHING)),
        intact_n=aligned(np.ones(count)),
        intact_s=aligned(np.ones(count)),
        secant=aligned(np.where(elastic_limit > 0.0, normal_stiffness, 0.0)),
        slip=aligned(np.zeros((count, 3))),
        dissipated=aligned(np.zeros((count, 3))),
        dilation=aligned(none) if dilates else None,
        permanent_opening=aligned(none) if permanent_opening else None,
        plastic_slip=aligned(none) if dilates else None,
        crushed=aligned(np.zeros((count, 3))) if crushes else None,
    )


class JointProperties(NamedTuple):
    """Properties of one contact group, SI (Pa/m, Pa, 1).

    The stress is sigma > 0 in tension, so the Coulomb line of eq. (8) reads |tau| <= c - sigma tan(phi).
    `tan_dilation` (eqs 9, 10) holds up to `dilation_cutoff` (m) of plastic slip. The next three are options:
    1.0 or None. The last ones are those of crushing (compression_cap.py), None where it is not modelled: strength (Pa),
    energy (N/m, None where nothing softens), and of the cap the closing at its peak (m) and the weight of shear.
    """

    normal_stiffness: float
    shear_stiffness: float
    tensile_strength: float | None = None
    cohesion: float | None = None
    tan_friction: float | None = None
    residual_cohesion: float | None = None
    tan_residual_friction: float | None = None
    tan_dilation: float | None = None
    dilation_cutoff: float | None = None
    elastic_unloading: float | None = None
    plastic_softening: float | None = None
    combined: float | None = None
    compressive_strength: float | None = None
    crushing_energy: float | None = None
    closing_at_peak: float | None = None
    cap_shear_factor: float | None = None


def softens_in_shear(joint: JointProperties) -> bool:
    """Whether contacts of a law with strengths that slid bear less shear than those that did not."""
    cohesion, friction = joint.residual_cohesion or 0.0, joint.tan_residual_friction or 0.0
    return bool(np.any((joint.cohesion or 0.0) > cohesion) or np.any((joint.tan_friction or 0.0) > friction))


def has_strength(joint: JointProperties) -> bool:
    """Whether contacts hold more than faces that slide on each other: elastic ones always, those that dilate too."""
    if joint.tensile_strength is None or joint.tan_dilation is not None:
        return True
    return bool(np.any(joint.tensile_strength > 0.0)) or softens_in_shear(joint)
