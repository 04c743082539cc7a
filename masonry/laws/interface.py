"""What every contact of a group has, whatever its softening: stiffness, strength, friction, dilation and the options.

An absent feature is None: its type then prunes the branch that would serve it from the compiled step.
"""

from typing import NamedTuple


class Interface(NamedTuple):
    """Properties of one contact group, SI (Pa/m, Pa, 1).

    The stress is sigma > 0 in tension, so the Coulomb line of eq. (8) reads |tau| <= c - sigma tan(phi).
    `tan_dilation` (eqs 9, 10) holds up to `dilation_cutoff` (m) of plastic slip. The last three are options:
    1.0 or None.
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
