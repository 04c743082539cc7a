"""The experiments there are: every module of `verification.paper.experiments` that holds an EXPERIMENT."""

import importlib
import pkgutil
from collections.abc import Iterable

from verification.catalogue import named
from verification.paper import experiments
from verification.paper.experiment import Experiment


def catalogue() -> dict[str, Experiment]:
    """Name -> experiment, in the order of the paper."""
    modules = (
        importlib.import_module(entry.name)
        for entry in pkgutil.walk_packages(experiments.__path__, f"{experiments.__name__}.")
    )
    found = [e for module in modules if isinstance(e := getattr(module, "EXPERIMENT", None), Experiment)]
    return {e.name: e for e in sorted(found, key=lambda e: e.order)}


def chosen(names: Iterable[str]) -> list[Experiment]:
    """The experiments of these names, or all. Raises SceneError with the nearest name where one is unknown."""
    known = catalogue()
    return named(names, known, "experiment", "`masonry paper --list`") or list(known.values())
