"""The criteria there are: every Criterion of the files in `masonry/judgement/doubts/`, found without a list."""

import importlib
import pkgutil
from functools import cache
from types import ModuleType

from masonry.judgement import doubts
from masonry.judgement.doubt import Criterion


def modules_of(package: ModuleType) -> list[ModuleType]:
    """The files of a folder and of those within it, by name."""
    entries = pkgutil.walk_packages(package.__path__, f"{package.__name__}.")
    return [importlib.import_module(name) for name in sorted(entry.name for entry in entries if not entry.ispkg)]


@cache
def criteria() -> tuple[Criterion, ...]:
    """All of them, in the order of folders and files. Raises ValueError where two share a name."""
    every = [value for module in modules_of(doubts) for value in vars(module).values() if isinstance(value, Criterion)]
    by_name = {criterion.name: criterion for criterion in every}
    if any(criterion is not by_name[criterion.name] for criterion in every):
        raise ValueError(f"two criteria share a name of {sorted(by_name)}")
    return tuple(by_name.values())
