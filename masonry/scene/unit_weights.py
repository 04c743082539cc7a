"""A unit weight in place of a density (18 kN/m^3) is divided by the standard gravity, and the scene says so."""

from typing import Any

from masonry.quantity import GRAVITY, is_unit_weight

DIVIDED = f"is a unit weight: divided by the standard gravity, {float(GRAVITY)} m/s^2"
"""What [assumptions] of a scene says of a density that was given as one."""


def note_unit_weights(raw: dict[str, Any]) -> None:
    """Say in the raw assumptions of a scene which densities are unit weights."""
    material, fill = raw.get("material"), raw.get("fill")
    tables = {f"material.{name}": table for name, table in material.items()} if isinstance(material, dict) else {}
    tables |= {f"fill.{number}": table for number, table in enumerate(fill)} if isinstance(fill, list) else {}
    for key, table in tables.items():
        value = table.get("density") if isinstance(table, dict) else None
        assumptions = raw.setdefault("assumptions", {}) if is_unit_weight(value) else None
        if isinstance(assumptions, dict):
            before = assumptions.get(f"{key}.density")
            assumptions[f"{key}.density"] = f"{f'{before}; ' if before else ''}{value} {DIVIDED}"
