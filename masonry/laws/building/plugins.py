"""Laws of other packages, by entry points of the group `masonry.laws`: found by name, and looked over before use.

Such a law is a module like the files of this folder. Parameters whose keys no scene has yet stand in its `KEYS`, with
their kinds of quantity; `EXAMPLE` gives values for them.
"""

import inspect
from collections.abc import Mapping
from functools import cache
from types import ModuleType
from typing import Any, NamedTuple

from masonry.errors import SceneError
from masonry.jit.sources import package_hash
from masonry.laws import law_names
from masonry.laws.building.entry_points import Plugin, load, plugin, plugins

GROUP = "masonry.laws"
CURVES = {
    "tension_intact": ("parameters", "joint", "opening"),
    "tension_area": ("parameters", "joint", "opening", "intact"),
    "shear_intact": ("parameters", "joint", "intact", "slip", "peak", "residual", "compression"),
}
BY_TOTAL_SLIP = tuple(word for word in CURVES["shear_intact"] if word != "intact")
"""What `shear_intact` may be given as well, by a law that knows its curve alone: see `dispatch.after`."""
MECHANISM = {
    "elastic_trial": ("parameters", "joint", "history", "opening", "tau_squared"),
    "return_mapping": ("parameters", "joint", "history", "opening", "total", "tau"),
    "stored_energy": ("parameters", "joint", "history", "opening", "tau_squared"),
}
LEAST_ENERGY = ("parameters", "joint", "compression", "intact")
"""The functions of a law and of a mechanism of its own, and what they are given, in this order; names are free."""


class PluginLaw(NamedTuple):
    """A law of another package: its module, its NamedTuple, and the keys that it adds to a scene, with their kinds."""

    name: str
    origin: str
    module: ModuleType
    parameters_class: type
    parameters: Mapping[str, str]
    keys: Mapping[str, str]
    example: Mapping[str, Any]


@cache
def plugin_law(name: str) -> PluginLaw | None:
    """The law of another package, or None. Raises SceneError, naming the package, for one that does not work."""
    found = plugin(GROUP, name, "law")
    return None if found is None or name in law_names() else _looked_over(found)


def plugin_law_names() -> tuple[str, ...]:
    """The laws that other packages bring, whether they work or not; without those that take a name of ours."""
    return tuple(name for name in plugins(GROUP) if name not in law_names())


def all_law_names() -> tuple[str, ...]:
    """Every law that there is; slow, for messages and lists."""
    return (*law_names(), *plugin_law_names())


def _looked_over(found: Plugin) -> PluginLaw:
    module = load(found, "law")
    where = f"law '{found.name}' of {found.origin}"
    if not isinstance(module, ModuleType):
        raise SceneError(f"{where}: its entry point must name a module, not {found.target}")
    classes = [c for c in vars(module).values() if _is_parameters_class(c, module)]
    if len(classes) != 1:
        raise SceneError(f"{where}: {module.__name__} must define one NamedTuple of parameters, not {len(classes)}")
    for name, words in MECHANISM.items() if _has_mechanism(module) else CURVES.items():
        _require_function(where, module, name, words)
    parameters, keys, example = (_table(where, module, name) for name in ("PARAMETERS", "KEYS", "EXAMPLE"))
    _require_fields(where, classes[0], parameters)
    if hasattr(module, "least_mode_2_energy"):
        _require_function(where, module, "least_mode_2_energy", LEAST_ENERGY)
        if not {"G_II", "G_II_slope"} <= set(classes[0]._fields):
            raise SceneError(f"{where}: least_mode_2_energy goes with fields G_II and G_II_slope")
    classes[0].__name__ += f"_{package_hash(classes[0])}"  # two types of one name would be one in compiled code
    for key in keys:
        if key not in parameters.values():
            raise SceneError(f"{where}: '{key}' of KEYS is the key of no parameter in PARAMETERS")
    return PluginLaw(found.name, found.origin, module, classes[0], parameters, keys, example)


def _is_parameters_class(candidate: Any, module: ModuleType) -> bool:
    named = isinstance(candidate, type) and issubclass(candidate, tuple) and hasattr(candidate, "_fields")
    return named and candidate.__module__ == module.__name__


def _has_mechanism(module: ModuleType) -> bool:
    return any(hasattr(module, name) for name in MECHANISM)


def _require_function(where: str, module: ModuleType, name: str, words: tuple[str, ...]) -> None:
    function = getattr(module, name, None)
    function = getattr(function, "py_func", function)
    signature = f"{name}({', '.join(words)})"
    if not inspect.isfunction(function):
        raise SceneError(f"{where}: {module.__name__} has no function {signature}")
    given = tuple(inspect.signature(function).parameters)
    if name == "shear_intact" and len(given) == len(BY_TOTAL_SLIP):
        words = BY_TOTAL_SLIP
    misplaced = any(word in words and word != there for word, there in zip(given, words, strict=False))
    if len(given) != len(words) or misplaced:
        raise SceneError(
            f"{where}: {name}({', '.join(given)}) must be {signature}, in this order; other names may be chosen"
        )


def _table(where: str, module: ModuleType, name: str) -> dict[str, Any]:
    table = getattr(module, name, None if name == "PARAMETERS" else {})
    if not isinstance(table, dict) or not all(isinstance(key, str) for key in table):
        raise SceneError(f"{where}: {module.__name__} must have a table {name} = {{...}} by names")
    if name != "EXAMPLE" and not all(isinstance(value, str) for value in table.values()):
        raise SceneError(f"{where}: {name} must hold words, not {table!r:.80}")
    return dict(table)


def _require_fields(where: str, parameters_class: Any, parameters: Mapping[str, str]) -> None:
    for field in parameters:
        if field not in parameters_class._fields:
            raise SceneError(f"{where}: '{field}' of PARAMETERS is no field of {parameters_class.__name__}")
    for field in parameters_class._fields:
        if field not in parameters and field not in parameters_class._field_defaults:
            raise SceneError(
                f"{where}: field '{field}' of {parameters_class.__name__} has no key in PARAMETERS and no default"
            )
