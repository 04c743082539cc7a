"""From the numbers of a scene to a law: what is missing, what contradicts itself, what would snap back."""

import importlib
from collections.abc import Sequence
from dataclasses import replace
from math import inf, tan
from typing import Any

from masonry.errors import SceneError, nearest
from masonry.laws import law_names
from masonry.laws.building.contact_properties import ContactProperties
from masonry.laws.building.plugins import all_law_names, plugin_law
from masonry.laws.compression_cap import refuse_crushing
from masonry.laws.law_dispatch import beside, shear_intact
from masonry.laws.snap_back import Refusal, lost_in_shear
from masonry.laws.state import JointProperties

NEAREST, FARTHEST = 1e-18, 1e3
"""m: slips between which a curve is asked where the cohesion has gone."""
NOTHING = 1e-5
"""Share of the cohesion below which a tensile strength counts as none."""
STRENGTHS = ("tensile_strength", "cohesion", "tan_friction")
CRUSHING = ("crushing", "compressive_strength", "fracture_energy_compression", "closing_at_peak", "cap_shear_factor")
CAP, CUT_OFF = "cap", "cut-off"
SHEAR_FACTOR = 9.0
"""Css of the cap where a scene gives none: the usual one of Lourenco and Rots (1997)."""


def module_of(name: str) -> Any:
    """The module of a law: of ours by its name, else as another package brings it."""
    if name in law_names():
        return importlib.import_module(f"masonry.laws.{name}")
    if (found := plugin_law(name)) is None:
        raise SceneError(f"there is no law '{name}'; {nearest(name, all_law_names())}")
    return found.module


def _parameters_class(name: str) -> type:
    """The NamedTuple of a law file."""
    file = module_of(name)
    return next(
        c for c in vars(file).values() if isinstance(c, type) and issubclass(c, tuple) and c.__module__ == file.__name__
    )


def build(
    group: str, properties: ContactProperties, compressions: Sequence[float] = (0.0,)
) -> tuple[Any, JointProperties]:
    """(parameters, joint) of a contact group; raises SceneError.

    compressions  Pa, the confining stresses at which snap-back in shear is looked for
    """
    parameters, joint = made(group, properties, compressions)
    refused = refusal(parameters, joint, compressions)
    if refused is not None:
        raise SceneError(
            f"contact.{group}.{refused.key} = {properties.value(refused.key):g} (SI) does not work with law "
            f"'{properties.law}': it must be above {refused.wanted}; {refused.why}"
        )
    return parameters, joint


def refusal(parameters: Any, joint: JointProperties, compressions: Sequence[float]) -> Refusal | None:
    """Refusal by a law of its parameters at some compressions (Pa), or None."""
    refuse = beside(type(parameters), "refuse")
    refused: Refusal | None = None if refuse is None else refuse(parameters, joint, compressions)
    return refused or refuse_crushing(joint)


def properties_of(law: str) -> tuple[str, ...]:
    """The strengths and the parameters of its own that a law reads, under the scene's names."""
    return () if law == "elastic" else (*strengths_of(module_of(law)), *module_of(law).PARAMETERS.values())


def strengths_of(file: Any) -> tuple[str, ...]:
    """The strengths that the law of a file reads: all of them, unless it names its own."""
    found: tuple[str, ...] = getattr(file, "STRENGTHS", STRENGTHS)
    return found


def made(
    group: str, properties: ContactProperties, compressions: Sequence[float] = (0.0,)
) -> tuple[Any, JointProperties]:
    """`build` without a look whether the curves would snap back."""
    name = properties.law
    file, where = module_of(name), f"contact.{group}"
    stiffness = {"normal_stiffness": properties.normal_stiffness, "shear_stiffness": properties.shear_stiffness}
    if name == "elastic":
        return _parameters_class(name)(), JointProperties(**stiffness)
    strengths = strengths_of(file)
    _require(where, properties, strengths)
    if strengths != STRENGTHS:
        properties = _without_the_rest(properties, strengths)
    parameters_class: Any = _parameters_class(name)
    optional = parameters_class._field_defaults
    _require(where, properties, [key for field, key in file.PARAMETERS.items() if field not in optional])
    given = {field: properties.value(key) for field, key in file.PARAMETERS.items()}
    parameters = parameters_class(**{field: value for field, value in given.items() if value is not None})
    for field, key in file.PARAMETERS.items():
        if field not in optional and getattr(parameters, field) <= 0.0:
            raise SceneError(f"{where}.{key} = {getattr(parameters, field):g}: law '{name}' needs a value above 0")
    joint = _joint_properties(where, properties, stiffness)
    if joint.tan_dilation is not None:
        joint = joint._replace(dilation_cutoff=_dilation_cutoff(properties, parameters, joint, max(compressions)))
    return parameters, joint


def _without_the_rest(properties: ContactProperties, strengths: Sequence[str]) -> ContactProperties:
    """The properties of a law that reads some strengths only: the others are 0, and nothing is left to an option."""
    bare = ContactProperties(properties.law, properties.normal_stiffness, properties.shear_stiffness)
    values: dict[str, Any] = {key: getattr(properties, key) if key in strengths else 0.0 for key in STRENGTHS}
    values |= {key: getattr(properties, key) for key in CRUSHING}
    return replace(bare, coupling="independent", **values)


def _require(where: str, properties: ContactProperties, keys: Sequence[str]) -> None:
    missing = [key for key in keys if properties.value(key) is None]
    if missing:
        spelled = [_SPELLING.get(key, key) for key in missing]
        raise SceneError(
            f"{where}: law '{properties.law}' needs {', '.join(spelled)}; add it, or choose another law: "
            f"{', '.join(all_law_names())}"
        )


_SPELLING = {"tan_friction": "friction_angle (or tan_friction_angle)"}


def _joint_properties(where: str, p: ContactProperties, stiffness: dict[str, float]) -> JointProperties:
    assert p.cohesion is not None and p.tan_friction is not None
    residual_cohesion = p.residual_cohesion or 0.0
    tan_residual = p.tan_residual_friction
    tan_residual = p.tan_friction if tan_residual is None else tan_residual
    if residual_cohesion > p.cohesion:
        raise SceneError(f"{where}.residual_cohesion: {residual_cohesion:g} Pa is more than cohesion {p.cohesion:g} Pa")
    if tan_residual > p.tan_friction:
        raise SceneError(
            f"{where}.residual_friction_angle is larger than friction_angle; strength never grows on sliding"
        )
    dilation = tan(p.dilation_angle or 0.0)
    if dilation > tan_residual:
        raise SceneError(
            f"{where}.dilation_angle is larger than the residual friction angle: sliding would then produce energy"
        )
    return JointProperties(
        **stiffness,
        tensile_strength=tensile_strength(p),
        cohesion=p.cohesion,
        tan_friction=p.tan_friction,
        residual_cohesion=residual_cohesion,
        tan_residual_friction=tan_residual,
        tan_dilation=dilation or None,
        elastic_unloading=1.0 if p.unloading == "elastic" else None,
        plastic_softening=1.0 if p.softening_variable == "plastic" else None,
        combined=None if p.coupling == "independent" else 1.0,
        **_crushing_of(where, p),  # type: ignore[arg-type]
    )


def _crushing_of(where: str, p: ContactProperties) -> dict[str, float | None]:
    """Crushing parameters of JointProperties; none where crushing is not modelled."""
    if p.crushing is None:
        return {}
    _require(where, p, ["compressive_strength"])
    strength, energy = p.compressive_strength, p.fracture_energy_compression
    if p.crushing == CUT_OFF:
        return {"compressive_strength": strength, "crushing_energy": energy}
    _require(where, p, ["fracture_energy_compression", "closing_at_peak"])
    factor = p.cap_shear_factor
    return {
        "compressive_strength": strength,
        "crushing_energy": energy,
        "closing_at_peak": p.closing_at_peak,
        "cap_shear_factor": SHEAR_FACTOR if factor is None else factor,
    }


def tensile_strength(p: ContactProperties) -> float:
    """Tensile strength (Pa) as the laws take it: not beyond the apex of the Coulomb line, c/tan(phi), and none where it
    is next to nothing beside the cohesion.

    Beyond the apex nothing holds a slip, though nothing is torn: shear strength would come back on the way home. And
    cohesion goes with the opening over G_I/fT, which grows beyond all bounds as fT goes to nothing.
    """
    strength = p.tensile_strength
    assert strength is not None and p.cohesion is not None and p.tan_friction is not None
    if strength < NOTHING * p.cohesion:
        return 0.0
    return min(strength, p.cohesion / p.tan_friction) if p.tan_friction > 0.0 else strength


def _dilation_cutoff(p: ContactProperties, parameters: Any, joint: JointProperties, compression: float) -> float:
    """Slip (m) at which dilation ends; where none is given, the slip at which the cohesion has gone.

    "Gone" is 1 % left of the curve at a compression (Pa). A brittle contact loses it at once, so it does not dilate
    unless a cut-off is given.
    """
    if p.dilation_cutoff is not None:
        return p.dilation_cutoff
    assert p.cohesion is not None and p.tan_friction is not None
    peak = p.cohesion + compression * p.tan_friction
    residual = peak - float(lost_in_shear(joint, compression))

    def gone(slip: float) -> bool:
        return bool(shear_intact(parameters, joint, 1.0, slip, peak, residual, compression) <= 0.01)

    if peak <= residual or not gone(FARTHEST):
        return inf
    low, high = 0.0, FARTHEST
    while high - low > 1e-14 * high and high > NEAREST:
        middle = (low * high) ** 0.5 if low > NEAREST else 0.5 * (low + high)
        low, high = (low, middle) if gone(middle) else (middle, high)
    return high if low > 0.0 else 0.0
