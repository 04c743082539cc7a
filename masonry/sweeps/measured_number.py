"""The numbers that summary.json may have, by name: whether a sweep can have such a column, before anything runs."""

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from types import NoneType, UnionType
from typing import Any, get_args, get_origin, get_type_hints

from masonry.errors import SceneError, did_you_mean
from masonry.results.summary import Summary
from masonry.rows.columns import CRUSHING, ELEMENT_UNITS, INPUT_ENERGY, LARGE_UNITS, UNITS
from masonry.sweeps.planned_runs import Planned

GAUGES, ENERGIES = "gauges", "energy_j"
"""Keys whose tables have an entry for each gauge of the scene, and for each kind of energy."""
Entries = Mapping[str, Sequence[str]]
"""Names that may be in the tables of a key."""


def require_measure(measure: str, planned: Sequence[Planned]) -> None:
    """Raise SceneError where no summary has a number by this dotted name, such as `shaking.gauges.top.peak_drift`, or
    no run has such a gauge."""
    scenes = (tomllib.loads(toml) for toml in dict.fromkeys(run.job.resolved for run in planned))
    gauges = list(dict.fromkeys(str(gauge["name"]) for scene in scenes for gauge in scene.get("gauge", ())))
    require_number(measure, gauges, "fragility: measure: ", "a measure")


def require_number(name: str, gauges: Sequence[str], where: str, what: str) -> None:
    """Raise SceneError where no summary of a scene with these gauges has a number by this dotted name.

    where  it was given        what  it is there
    """
    entries = _entries(gauges)
    if not _is_number(Summary, name, entries):
        meant = f"shaking.gauges.{name}.peak" if name in gauges else name
        hint = did_you_mean(meant, sorted(_numbers(Summary, "", entries)))
        of = f", of the gauges {', '.join(gauges)}" if gauges else ""
        columns = f"{what} is a number of summary.json by its dotted name (docs/results.md){of}"
        raise SceneError(f"{where}no run has '{name}'; {columns}{hint}")


def is_measured(name: str, gauges: Sequence[str]) -> bool:
    """Whether a number of a summary is measured, and neither a count nor a yes or no."""
    return _is_number(Summary, name, _entries(gauges), plain=(float,))


def _entries(gauges: Sequence[str]) -> Entries:
    return {GAUGES: gauges, ENERGIES: (*UNITS, *LARGE_UNITS, CRUSHING, INPUT_ENERGY, *ELEMENT_UNITS)}


def _kinds(kind: Any) -> tuple[Any, ...]:
    """The types of a value that is there."""
    every = get_args(kind) if isinstance(kind, UnionType) else (kind,)
    return tuple(one for one in every if one is not NoneType)


def _inner(kind: Any) -> Any:
    """The type of what a table by name holds; None of what is none."""
    origin = get_origin(kind)
    return get_args(kind)[1] if isinstance(origin, type) and issubclass(origin, Mapping) else None


def _has_fields(kind: Any) -> bool:
    return get_origin(kind) is None and isinstance(kind, type) and issubclass(kind, Mapping)


def _is_number(
    kind: Any,
    name: str,
    entries: Entries,
    within: Sequence[str] | None = None,
    plain: Sequence[type] = (int, float, bool),
) -> bool:
    """Whether a value of this type has a number of a plain type by a dotted name, itself by none; `within`, the names
    that are in a table, None where they are not known before a run. Names may have dots of their own."""
    for one in _kinds(kind):
        if one is Any or (not name and one in plain):
            return True
        if not name:
            continue
        if _has_fields(one):
            head, _, rest = name.partition(".")
            hints = get_type_hints(one)
            if head in hints and _is_number(hints[head], rest, entries, entries.get(head), plain):
                return True
        elif (inner := _inner(one)) is not None:
            parts = name.split(".")
            ends = ((".".join(parts[:k]), ".".join(parts[k:])) for k in range(1, len(parts) + 1))
            if any(
                (within is None or entry in within) and _is_number(inner, rest, entries, None, plain)
                for entry, rest in ends
            ):
                return True
    return False


def _numbers(kind: Any, name: str, entries: Entries) -> Iterator[str]:
    """The names of all numbers but those of tables whose entries are not known before a run."""
    for one in _kinds(kind):
        if one in (int, float, bool):
            yield name
        elif _has_fields(one):
            for head, inner in get_type_hints(one).items():
                if head in getattr(one, "__dataclass_fields__", ()):
                    yield from _numbers(inner, f"{name}.{head}".lstrip("."), entries)
        else:
            for entry in entries.get(name.rpartition(".")[2], ()):
                yield from _numbers(_inner(one), f"{name}.{entry}", entries)
