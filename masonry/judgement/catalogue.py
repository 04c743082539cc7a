"""The criteria there are: every Criterion of the files in `masonry/judgement/doubts/`, found without a list."""

import importlib
import pkgutil
from functools import cache

from masonry.judgement import doubts
from masonry.judgement.doubt import Criterion


@cache
def criteria() -> tuple[Criterion, ...]:
    """All of them, in the order of folders and files. Raises ValueError where two share a name."""
    entries = [entry.name for entry in pkgutil.walk_packages(doubts.__path__, f"{doubts.__name__}.") if not entry.ispkg]
    modules = [importlib.import_module(name) for name in sorted(entries)]
    every = [value for module in modules for value in vars(module).values() if isinstance(value, Criterion)]
    by_name = {criterion.name: criterion for criterion in every}
    if any(criterion is not by_name[criterion.name] for criterion in every):
        raise ValueError(f"two criteria share a name of {sorted(by_name)}")
    return tuple(by_name.values())
