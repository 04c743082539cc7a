"""Properties of a group of contacts, as laws are built from them."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any


@dataclass(frozen=True)
class ContactProperties:
    """SI values under the scene's names; None where the scene gives none.

    of_law  parameters that a law of another package adds, by its keys
    """

    law: str
    normal_stiffness: float
    shear_stiffness: float
    tensile_strength: float | None = None
    cohesion: float | None = None
    tan_friction: float | None = None
    residual_cohesion: float | None = None
    tan_residual_friction: float | None = None
    fracture_energy_mode_1: float | None = None
    fracture_energy_mode_2: float | None = None
    fracture_energy_mode_2_slope: float | None = None
    exponent_tension: float | None = None
    exponent_shear: float | None = None
    dilation_angle: float | None = None
    dilation_cutoff: float | None = None
    unloading: str = "secant"
    softening_variable: str = "displacement"
    coupling: str = "combined"
    crushing: str | None = None
    compressive_strength: float | None = None
    fracture_energy_compression: float | None = None
    closing_at_peak: float | None = None
    cap_shear_factor: float | None = None
    normal_dashpot: float | None = None
    restitution: float | None = None
    of_law: Mapping[str, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, values: Mapping[str, Any]) -> "ContactProperties":
        """Properties from values by name; names of no field are those of parameters of a law."""
        names = {entry.name for entry in fields(cls)}
        of_law = {key: value for key, value in values.items() if key not in names}
        return cls(**{key: value for key, value in values.items() if key in names}, of_law=of_law)

    def value(self, key: str) -> Any:
        """The value under a scene's name; None where there is none."""
        return self.of_law[key] if key in self.of_law else getattr(self, key, None)
