"""All maps: every module of this folder that has `grids`."""

import importlib
import pkgutil

from verification import stability
from verification.stability.cells import Grid
from verification.stability.running import run

__all__ = ["cells", "run"]


def cells(full: bool) -> list[Grid]:
    """The maps; quick ones (full=False) have a few cells of each axis."""
    names = sorted(entry.name for entry in pkgutil.iter_modules(stability.__path__) if entry.name != "suite")
    modules = [importlib.import_module(f"{stability.__name__}.{name}") for name in names]
    return [grid for module in modules if hasattr(module, "grids") for grid in module.grids(full)]
