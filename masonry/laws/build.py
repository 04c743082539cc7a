"""From the numbers of a scene to a law: what is missing, what contradicts itself, what would snap back."""

import importlib
from collections.abc import Mapping, Sequence
from math import inf, tan
from typing import Any

from masonry.errors import SceneError, nearest
from masonry.laws import law_names
from masonry.laws.door import beside
from masonry.laws.interface import Interface
from masonry.laws.outside import all_law_names, outside_law
from masonry.laws.snap_back import Refusal

STRENGTHS = ("tensile_strength", "cohesion", "tan_friction")


def module_of(name: str) -> Any:
    """The module of a law: of ours by its name, else as another package brings it."""
    if name in law_names():
        return importlib.import_module(f"masonry.laws.{name}")
    if (found := outside_law(name)) is None:
        raise SceneError(f"there is no law '{name}'; {nearest(name, all_law_names())}")
    return found.module


def _shape_class(name: str) -> type:
    """The NamedTuple of a law file."""
    file = module_of(name)
    return next(
        c for c in vars(file).values() if isinstance(c, type) and issubclass(c, tuple) and c.__module__ == file.__name__
    )


def build(group: str, properties: Mapping[str, Any], compressions: Sequence[float] = (0.0,)) -> tuple[Any, Interface]:
    """(shape, interface) of a contact group; raises SceneError.

    properties    SI values under the scene's names; None or absent where not given
    compressions  Pa, the confining stresses at which snap-back in shear is looked for
    """
    shape, interface = made(group, properties)
    refused = refusal(shape, interface, compressions)
    if refused is not None:
        raise SceneError(
            f"contact.{group}.{refused.key} = {properties[refused.key]:g} (SI) does not work with law "
            f"'{properties['law']}': it must be above {refused.wanted}; {refused.why}"
        )
    return shape, interface


def refusal(shape: Any, interface: Interface, compressions: Sequence[float]) -> Refusal | None:
    """What a law refuses of its parameters at some compressions (Pa), or None."""
    refuse = beside(type(shape), "refuse")
    return None if refuse is None else refuse(shape, interface, compressions)


def properties_of(law: str) -> tuple[str, ...]:
    """The strengths and the parameters of its own that a law reads, under the scene's names."""
    return () if law == "elastic" else (*STRENGTHS, *module_of(law).PARAMETERS.values())


def made(group: str, properties: Mapping[str, Any]) -> tuple[Any, Interface]:
    """`build` without a look whether the curves would snap back."""
    name = properties["law"]
    file, where = module_of(name), f"contact.{group}"
    stiffness = {key: properties[key] for key in ("normal_stiffness", "shear_stiffness")}
    if name == "elastic":
        return _shape_class(name)(), Interface(**stiffness)
    _require(where, name, properties, STRENGTHS)
    shape_class: Any = _shape_class(name)
    optional = shape_class._field_defaults
    _require(where, name, properties, [key for field, key in file.PARAMETERS.items() if field not in optional])
    given = {field: properties.get(key) for field, key in file.PARAMETERS.items()}
    shape = shape_class(**{field: value for field, value in given.items() if value is not None})
    for field, key in file.PARAMETERS.items():
        if field not in optional and getattr(shape, field) <= 0.0:
            raise SceneError(f"{where}.{key} = {getattr(shape, field):g}: law '{name}' needs a value above 0")
    return shape, _interface(where, properties, stiffness, shape)


def _require(where: str, law: str, properties: Mapping[str, Any], keys: Sequence[str]) -> None:
    missing = [key for key in keys if properties.get(key) is None]
    if missing:
        spelled = [_SPELLING.get(key, key) for key in missing]
        raise SceneError(
            f"{where}: law '{law}' needs {', '.join(spelled)}; add it, or choose another law: "
            f"{', '.join(all_law_names())}"
        )


_SPELLING = {"tan_friction": "friction_angle (or tan_friction_angle)"}


def _interface(where: str, p: Mapping[str, Any], stiffness: dict[str, float], shape: Any) -> Interface:
    residual_cohesion = p.get("residual_cohesion") or 0.0
    tan_residual = p.get("tan_residual_friction")
    tan_residual = p["tan_friction"] if tan_residual is None else tan_residual
    if residual_cohesion > p["cohesion"]:
        raise SceneError(
            f"{where}.residual_cohesion: {residual_cohesion:g} Pa is more than cohesion {p['cohesion']:g} Pa"
        )
    if tan_residual > p["tan_friction"]:
        raise SceneError(
            f"{where}.residual_friction_angle is larger than friction_angle; strength never grows on sliding"
        )
    dilation = tan(p.get("dilation_angle") or 0.0)
    if dilation > tan_residual:
        raise SceneError(
            f"{where}.dilation_angle is larger than the residual friction angle: sliding would then produce energy"
        )
    interface = Interface(
        **stiffness,
        tensile_strength=p["tensile_strength"],
        cohesion=p["cohesion"],
        tan_friction=p["tan_friction"],
        residual_cohesion=residual_cohesion,
        tan_residual_friction=tan_residual,
        tan_dilation=dilation or None,
        elastic_unloading=1.0 if p.get("unloading") == "elastic" else None,
        plastic_softening=1.0 if p.get("softening_variable") == "plastic" else None,
        combined=None if p.get("coupling") == "independent" else 1.0,
    )
    return interface._replace(dilation_cutoff=_dilation_cutoff(p, shape, interface)) if dilation else interface


def _dilation_cutoff(p: Mapping[str, Any], shape: Any, interface: Interface) -> float:
    """Slip (m) at which dilation ends; where none is given, the slip at which the cohesion has gone.

    "Gone" is 1 % left at zero normal stress: exponential ln(100) G_II/c0; linear and polynomial likewise from eqs
    (13) and (15). A brittle contact loses it at once, so it does not dilate unless a cut-off is given. The curve of a
    law of another package is asked.
    """
    if p.get("dilation_cutoff") is not None:
        return p["dilation_cutoff"]
    if p["cohesion"] == 0.0:
        return inf
    if p["law"] not in law_names():
        return _slip_without_cohesion(shape, interface)
    G_II = p.get("fracture_energy_mode_2") or 0.0
    if p["law"] == "linear":
        return 2.0 * G_II / p["cohesion"]
    if p["law"] == "polynomial":
        return 2.0 * G_II / p["cohesion"] * (100.0 ** (1.0 / p["exponent_shear"]) - 1.0)
    return 4.605170185988092 * G_II / p["cohesion"]


def _slip_without_cohesion(shape: Any, interface: Interface) -> float:
    """Slip (m) at which a curve has 1 % left at zero normal stress, to a millionth; endless where it never has."""

    def gone(slip: float) -> bool:
        left = beside(type(shape), "shear_intact")(
            shape, interface, slip, interface.cohesion, interface.residual_cohesion, 0.0
        )
        return bool(left <= 0.01)

    low, high = 0.0, 1e-9
    while not gone(high):
        low, high = high, 2.0 * high
        if high > 1e3:
            return inf
    while high - low > 1e-6 * high:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if gone(middle) else (middle, high)
    return high
