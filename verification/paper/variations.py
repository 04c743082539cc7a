"""How far each assumption is varied: rules by the last word of its key, so that a new scene needs no list here."""

from collections.abc import Callable, Collection, Iterator
from functools import cache
from typing import Any, NamedTuple

from pydantic import BaseModel

from masonry import scene
from masonry.laboratory import laboratory


class Variation(NamedTuple):
    """One run: entry of the tornado, label of the variation, knobs it sets, knobs its base run needs as well."""

    entry: str
    label: str
    knobs: dict[str, Any]
    base: dict[str, Any]


def _times(*factors: float, unit: str = "") -> Callable[[Any], dict[str, Any]]:
    return lambda value: {f"x{f:g}": f"{f * value!r}{unit}" if unit else f * value for f in factors}


def _to(*values: Any) -> Callable[[Any], dict[str, Any]]:
    return lambda value: {str(v): v for v in values if v != value}


def _finer_and_coarser(value: Any) -> dict[str, Any]:
    grids = ([max(1, n // 2) for n in value], [max(1, n * 3 // 2) for n in value])
    return {"x".join(map(str, g)): list(g) for g in grids if list(g) != list(value)}


RULES: dict[str, Callable[[Any], dict[str, Any]]] = {
    "normal_stiffness": _times(0.5, 2, unit=" Pa/m"),
    "shear_stiffness": _times(0.5, 2, unit=" Pa/m"),
    "tensile_strength": _times(0.5, 1.5, unit=" Pa"),
    "cohesion": _times(0.67, 1.5, unit=" Pa"),
    "residual_cohesion": lambda value: (
        {"0": "0 Pa", "50 kPa": "50 kPa"} if not value else _times(0, 10, unit=" Pa")(value)
    ),
    "friction_angle": _times(0.8, 1.2, unit=" rad"),
    "residual_friction_angle": _times(0.8, 1.2, unit=" rad"),
    "fracture_energy_mode_1": _times(0.5, 2, unit=" N/m"),
    "fracture_energy_mode_2": _times(0.5, 2, unit=" N/m"),
    "exponent_tension": _to(2.0, 4.0),
    "exponent_shear": _to(2.1, 2.9),
    "dilation_angle": _to("0 deg", "2 deg", "4 deg"),
    "dilation_cutoff": _times(0.4, 2, 4, 9.2, unit=" m"),
    "density": _times(0.5, 2, unit=" kg/m^3"),
    "young_modulus": _times(0.5, 2, unit=" Pa"),
    "poisson_ratio": _to(0.1, 0.3),
    "units_per_course": _to(3),
    "divisions": _finer_and_coarser,
    "plates": _times(0.5, 2, unit=" m"),
    "joint_thickness": _times(0.8, 1.2, unit=" m"),
    "accuracy": lambda value: {f"x{f:g}": f * value for f in (0.5, 2)},
    "steps": lambda value: {f"x{f:g}": round(f * value) for f in (0.5, 2)},
    "rate": lambda value: {f"x{f:g}": f"{1e3 * f * value:g} mm/s" for f in (0.5, 2)},
    "displacement": _times(0.8, 1.2, unit=" m"),
    "fix": lambda value: {"turning held" if "rotation" not in value else "turning free": _toggled_rotation(value)},
}

NEEDS: dict[str, dict[str, Any]] = {
    "exponent_tension": {"law": "polynomial"},
    "exponent_shear": {"law": "polynomial"},
    "young_modulus": {"kinematics": {"units": "affine"}},
    "poisson_ratio": {"kinematics": {"units": "affine"}},
}
"""What the base run must have for the entry to matter at all."""


def _toggled_rotation(value: Any) -> list[str]:
    return [v for v in value if v != "rotation"] if "rotation" in value else [*value, "rotation"]


def assumed(name: str) -> tuple[list[Variation], dict[str, str]]:
    """(the variations of a scene's [assumptions], the entries that are not varied -> why)."""
    loaded = scene.load(name)
    present = contacts(name)
    variations: list[Variation] = []
    without: dict[str, str] = {}
    for key in loaded.assumptions:
        group = key.split(".")[1] if key.startswith("contact.") else ""
        if group and group not in present:
            without[key] = f"this scene has no contacts {group}, so no effect"
            continue
        for entry, value in _leaves(key, _look_up(loaded, key.split("."))):
            last = entry.split(".")[-1]
            if entry.startswith("material.plates") and last != "density":
                without[entry] = "the plates are rigid, so no effect"
            elif last not in RULES:
                without[entry] = "not a number"
            else:
                base = NEEDS.get(last, {})
                variations += [Variation(entry, label, {entry: v}, base) for label, v in RULES[last](value).items()]
    return list({(v.entry, v.label): v for v in variations}.values()), without


@cache
def contacts(name: str) -> frozenset[str]:
    """The contact groups that occur in a scene."""
    return frozenset(laboratory.check(scene.load(name))["contacts"])


def _look_up(table: Any, keys: list[str]) -> Any:
    """The value (SI) at a dotted key; 0 where the scene leaves it out."""
    for key in keys:
        if isinstance(table, BaseModel):
            table = getattr(table, key)
        else:
            table = table[int(key)] if isinstance(table, tuple) else table[key]
    return 0.0 if table is None else table


def _leaves(key: str, value: Any) -> Iterator[tuple[str, Any]]:
    """An assumption on a whole table is one on each of its numbers."""
    if isinstance(value, BaseModel):
        for name, below in value:
            if isinstance(below, float):
                yield f"{key}.{name}", below
    else:
        yield key, value


JOINTS = ("unit_unit", "unit_mortar", "within_mortar")
"""Contact groups that may dilate."""


def options(name: str) -> list[Variation]:
    """The program's own choices that the paper leaves open, on all contacts that can crack.

    The damping is none of them: a drive to an accuracy has its own.
    """
    loaded = scene.load(name)
    present = contacts(name)
    groups = [g for g, contact in loaded.contact.items() if g in present and contact.law != "elastic"]

    def everywhere(key: str, value: Any, among: Collection[str] = groups) -> dict[str, Any]:
        return {f"contact.{g}.{key}": value for g in groups if g in among}

    dilates = everywhere("dilation_angle", "2 deg", JOINTS)
    assumed_already = any(key.endswith(".dilation_cutoff") for key in loaded.assumptions)
    cutoffs = () if assumed_already else ("10 um", "100 um", "1 mm")
    return [
        Variation("softening_variable", "plastic", everywhere("softening_variable", "plastic"), {}),
        Variation("coupling", "independent", everywhere("coupling", "independent"), {}),
        Variation("unloading", "elastic", everywhere("unloading", "elastic"), {}),
        Variation("contact_points", "vertex", {"specimen.contact_points": "vertex"}, {}),
        Variation("points_per_edge", "4", {"specimen.points_per_edge": 4}, {}),
        *(Variation("dilation_cutoff", c, everywhere("dilation_cutoff", c, JOINTS), dilates) for c in cutoffs),
        Variation("dilation_angle (not assumed)", "2 deg", dilates, {}),
    ]
