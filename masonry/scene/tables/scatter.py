"""Tables of a scene for properties that differ from joint to joint, or from unit to unit."""

from typing import Any, ClassVar

from pydantic import ConfigDict, Field, model_validator

from masonry.errors import nearest
from masonry.scene.tables.types import KeyedError, Number, Table, UnitInterval, Variation


class Scattered(Table):
    """Coefficients of variation of a group of contacts, and the correlation of the logarithms of any two of them."""

    tensile_strength: Variation | None = None
    cohesion: Variation | None = None
    fracture_energy_mode_1: Variation | None = None
    fracture_energy_mode_2: Variation | None = None
    compressive_strength: Variation | None = None
    fracture_energy_compression: Variation | None = None
    correlation: UnitInterval = 1.0

    @property
    def variations(self) -> dict[str, float]:
        """Coefficients of variation by property, of those that are named."""
        return {key: value for key, value in self if key != "correlation" and value is not None}

    @model_validator(mode="after")
    def _names_a_property(self) -> "Scattered":
        if not self.variations:
            allowed = ", ".join(key for key in Scattered.model_fields if key != "correlation")
            raise ValueError(f"names no property; give a coefficient of variation to one or more of {allowed}")
        return self


class Scatter(Table):
    """A seed, and a table `Scattered` under the name of each group of contacts that scatters."""

    ANY: ClassVar[type] = Scattered
    """What a key of any other name holds."""
    model_config = ConfigDict(frozen=True, extra="allow")
    __pydantic_extra__: dict[str, Scattered] = Field(init=False)

    seed: Number = 0

    @property
    def groups(self) -> dict[str, Scattered]:
        """The tables by group."""
        return dict(self.__pydantic_extra__)

    @model_validator(mode="after")
    def _names_a_group(self) -> "Scatter":
        if not self.groups:
            raise KeyedError("seed", "a seed alone scatters nothing; name a group: [scatter.unit_unit]")
        return self


def require_contacts(scatter: Scatter, contact: dict[str, Any]) -> None:
    """Every group that scatters is a group of contacts, which has the properties that scatter."""
    for group, scattered in scatter.groups.items():
        if group not in contact:
            raise KeyedError(f"scatter.{group}", f"there is no [contact.{group}]; {nearest(group, contact)}")
        for key in scattered.variations:
            if not getattr(contact[group], key):
                raise KeyedError(f"scatter.{group}.{key}", f"contact.{group}.{key} is not given or 0: nothing scatters")
