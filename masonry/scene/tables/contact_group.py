"""Tables of a scene for a group of contacts, and for the material of a group of blocks."""

import math
from dataclasses import fields
from itertools import pairwise
from typing import Annotated, Any, Literal

from pydantic import (
    SerializationInfo,
    SerializerFunctionWrapHandler,
    ValidationInfo,
    model_serializer,
    model_validator,
)

from masonry.laws.building.contact_properties import ContactProperties
from masonry.laws.restitution import share_of_critical
from masonry.quantity import convert
from masonry.scene.tables.types import (
    SOFTEST,
    Angle,
    CrushingStrength,
    Dashpot,
    Density,
    Energy,
    EnergySlope,
    Exponent,
    Given,
    KeyedError,
    Law,
    Length,
    Modulus,
    Poisson,
    ShearStiffness,
    Stiffness,
    Strength,
    Table,
    Tangent,
    confinement_of,
    refuse_both,
)


class MaterialTable(Table):
    """A group of blocks: kg/m3, Pa, 1. The elastic constants are needed for affine and tets only."""

    density: Density
    young_modulus: Modulus | None = None
    poisson_ratio: Poisson | None = None


class Contact(Table):
    """A group of contacts, in SI. `law` is its own or the scene's; None stands for what the scene leaves out.

    exponent_shear_table  ((confinement in Pa, exponent), ...) where the file gives exponent_shear by confinement
    """

    law: Law
    normal_stiffness: Stiffness
    shear_stiffness: ShearStiffness
    tensile_strength: Strength | None = None
    cohesion: Strength | None = None
    friction_angle: Angle | None = None
    tan_friction_angle: Tangent | None = None
    residual_cohesion: Strength | None = None
    residual_friction_angle: Angle | None = None
    tan_residual_friction_angle: Tangent | None = None
    fracture_energy_mode_1: Energy | None = None
    fracture_energy_mode_2: Energy | None = None
    fracture_energy_mode_2_slope: EnergySlope | None = None
    exponent_tension: Exponent | None = None
    exponent_shear: Exponent | None = None
    exponent_shear_table: tuple[tuple[float, float], ...] | None = None
    dilation_angle: Angle | None = None
    dilation_cutoff: Length | None = None
    unloading: Literal["secant", "elastic"] = "secant"
    softening_variable: Literal["displacement", "plastic"] | None = None
    coupling: Literal["combined", "independent"] = "combined"
    crushing: Literal["cap", "cut-off"] | None = None
    compressive_strength: CrushingStrength | None = None
    fracture_energy_compression: Energy | None = None
    closing_at_peak: Length | None = None
    cap_shear_factor: Annotated[float | None, Given("number", "[0, 1e6]")] = None
    normal_dashpot: Dashpot | None = None
    restitution: Annotated[float | None, Given("number", "[0.1, 1)")] = None

    @property
    def law_keys(self) -> tuple[str, ...]:
        """Keys that a law of another package adds (see law_keys.py)."""
        return tuple(key for key in type(self).model_fields if key not in Contact.model_fields)

    def properties(self, turns_back: bool = False) -> ContactProperties:
        """SI values, as `factory.build` takes them; turns_back: whether loading does, where it matters."""
        values = {
            entry.name: getattr(self, entry.name) for entry in fields(ContactProperties) if entry.name != "of_law"
        }
        values["of_law"] = {key: getattr(self, key) for key in self.law_keys}
        if self.restitution is not None:
            values["normal_dashpot"] = share_of_critical(self.restitution)
        default = "plastic" if turns_back else "displacement"
        return ContactProperties(**values | {"softening_variable": self.softening_variable or default})

    @property
    def tan_friction(self) -> float | None:
        return _tangent(self.tan_friction_angle, self.friction_angle)

    @property
    def tan_residual_friction(self) -> float | None:
        return _tangent(self.tan_residual_friction_angle, self.residual_friction_angle)

    @model_validator(mode="before")
    @classmethod
    def _take_from_scene(cls, data: Any, info: ValidationInfo) -> Any:
        """The scene's law where the group names none, and the shear exponent at the scene's confinement."""
        if not isinstance(data, dict):
            return data
        if "exponent_shear_table" in data:
            raise KeyedError("exponent_shear_table", "write the table as exponent_shear = {'0.1 MPa' = 2.1, ...}")
        law = (info.context or {}).get("law")
        data = data if "law" in data or law is None else {"law": law, **data}
        if isinstance(exponents := data.get("exponent_shear"), dict):
            try:
                table = _read_table(exponents)
                value = interpolate(table, confinement_of(info, "exponent_shear by confinement"))
            except ValueError as error:
                raise KeyedError("exponent_shear", str(error)) from None
            data = {**data, "exponent_shear": value, "exponent_shear_table": table}
        return data

    @model_validator(mode="after")
    def _is_complete(self) -> "Contact":
        for plain, tangent in (
            ("friction_angle", "tan_friction_angle"),
            ("residual_friction_angle", "tan_residual_friction_angle"),
        ):
            if getattr(self, plain) is not None and getattr(self, tangent) is not None:
                raise KeyedError(tangent, f"{plain} and {tangent} are two spellings of one property; keep one of them")
        refuse_both(self, "normal_dashpot", "restitution")
        self._require_of_crushing()
        if 0.0 < self.shear_stiffness < SOFTEST:
            raise KeyedError("shear_stiffness", f"must be 0, or in [{SOFTEST:g}, 1e22]")
        if self.law == "elastic":
            return self
        if self.tan_friction is None:
            raise KeyedError("friction_angle", f"missing for law {self.law}; give friction_angle or tan_friction_angle")
        if self.shear_stiffness == 0.0:
            raise KeyedError("shear_stiffness", f"must be more than 0 for law {self.law}; 0 is for law elastic only")
        return self

    def _require_of_crushing(self) -> None:
        """The keys of crushing go together."""
        cap = ("closing_at_peak", "cap_shear_factor")
        for key in ("fracture_energy_compression", *cap):
            if getattr(self, key) is not None and self.crushing is None:
                words = 'crushing = "cap"' if key in cap else 'crushing = "cap" or "cut-off"; name one of them'
                raise KeyedError(key, f"goes with {words}")
        for key in cap:
            if getattr(self, key) is not None and self.crushing == "cut-off":
                raise KeyedError(key, 'belongs to crushing = "cap"; a cut-off has none: leave it out')
        if self.crushing is None:
            return
        if self.law == "elastic":
            raise KeyedError("crushing", "law elastic has no strength; choose another law: friction, linear, ...")
        required: tuple[str, ...] = ("compressive_strength", "fracture_energy_compression", cap[0])
        required = required if self.crushing == "cap" else required[:1]
        for key in required:
            if getattr(self, key) is None:
                others = f", which needs {' and '.join(required)}" if len(required) > 1 else ""
                raise KeyedError(key, f'missing for crushing = "{self.crushing}"{others}')

    @model_serializer(mode="wrap")
    def _write(self, handler: SerializerFunctionWrapHandler, info: SerializationInfo[Any]) -> dict[str, Any]:
        """The law is left to the scene where it is the same, and the table by confinement is written as given."""
        data: dict[str, Any] = handler(self)
        if self.law == (info.context or {}).get("law"):
            del data["law"]
        data.pop("exponent_shear_table", None)
        if self.exponent_shear_table is not None:
            data["exponent_shear"] = {f"{stress!r} Pa": exponent for stress, exponent in self.exponent_shear_table}
        return data


def _tangent(tangent: float | None, angle: float | None) -> float | None:
    return math.tan(angle) if tangent is None and angle is not None else tangent


def _read_table(exponents: dict[Any, Any]) -> tuple[tuple[float, float], ...]:
    """{"0.1 MPa" = 2.1, ...} -> ((Pa, exponent), ...), ascending."""
    rows = sorted(
        (convert(stress, "stress", "the confinement", "[0, inf)"), convert(value, "number", "the exponent", "(1, inf)"))
        for stress, value in exponents.items()
    )
    if not rows or any(low == high for (low, _), (high, _) in pairwise(rows)):
        raise ValueError("a table by confinement needs one or more rows, each at its own confinement")
    return tuple(rows)


def interpolate(table: tuple[tuple[float, float], ...], at: float) -> float:
    """Linear between the rows (abscissa, value) of an ascending table, constant beyond its ends."""
    for (x0, y0), (x1, y1) in pairwise(table):
        if at < x1:
            return y0 + (y1 - y0) * max(at - x0, 0.0) / (x1 - x0)
    return table[-1][1]
