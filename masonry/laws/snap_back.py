"""Fracture energies in shear below which a law's curve snaps back: refused at input, and looked for during a run.

A law file that has such a limit brings `least_mode_2_energy(parameters, joint, compression, intact)`: N/m, at a
compression in Pa and where a share of the strength above the residual is left; None where its curve never snaps back.
"""

from typing import NamedTuple

from masonry.laws.law_dispatch import beside


class Refusal(NamedTuple):
    """Value that a law refuses: the scene's key, the value (SI) that it must be above, its unit, and why."""

    key: str
    bound: float
    unit: str
    why: str

    @property
    def wanted(self) -> str:
        """The least value with its unit."""
        return f"{self.bound:.6g} {self.unit}".rstrip()


def least_mode_2_energy(parameters, joint, compression, intact=1.0):
    """The least energy (N/m) of a law at a compression (Pa) and a share left (numbers or arrays), or None for any."""
    override = beside(type(parameters), "least_mode_2_energy")
    return None if override is None else override(parameters, joint, compression, intact)


def given_mode_2_energy(parameters, compression):
    """The energy (N/m) that a law has at a compression (Pa, number or array)."""
    return parameters.G_II + (parameters.G_II_slope or 0.0) * compression


def lost_in_shear(joint, compression):
    """Peak less residual shear strength (Pa) at a compression (Pa, number or array)."""
    loss = joint.tan_friction - joint.tan_residual_friction
    return joint.cohesion - joint.residual_cohesion + compression * loss


def refuse_in_shear(parameters, joint, compressions):
    """The refusal where the energy is too small at one of the compressions, or None."""
    maximum = None
    for compression in compressions:
        bound = least_mode_2_energy(parameters, joint, compression)
        if bound and given_mode_2_energy(parameters, compression) <= bound:
            required = bound - (parameters.G_II_slope or 0.0) * compression, compression
            maximum = required if maximum is None else max(maximum, required)
    if maximum is None:
        return None
    why = beside(type(parameters), "WHY_IN_SHEAR")
    return Refusal("fracture_energy_mode_2", maximum[0], "N/m", f"{why}, at a compression of {maximum[1]:g} Pa")
