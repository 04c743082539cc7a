"""The cases there are: every CASE, or CASES, of the modules of `verification.cases`, found without a list."""

import importlib
import pkgutil
import re
from collections.abc import Iterable
from functools import cache, partial
from types import ModuleType
from typing import TypeVar

from masonry.errors import SceneError, closest
from verification import cases
from verification.case import Case

T = TypeVar("T")


def modules_of(package: ModuleType) -> list[ModuleType]:
    """The modules of a folder, by name: what they hold is found without a list."""
    names = sorted(entry.name for entry in pkgutil.iter_modules(package.__path__))
    return [importlib.import_module(f"{package.__name__}.{name}") for name in names]


@cache
def catalogue() -> dict[str, Case]:
    """Name -> case, in the order of the catalogue's rows.

    Raises ValueError where two share a name, and for a module without a case, which would be missing and nobody knew.
    """
    by_name: dict[str, Case] = {}
    for entry in pkgutil.walk_packages(cases.__path__, f"{cases.__name__}."):
        if entry.ispkg:
            continue
        module = importlib.import_module(entry.name)
        own_cases: list[Case] = [*getattr(module, "CASES", ()), *([module.CASE] if hasattr(module, "CASE") else [])]
        if not own_cases:
            raise ValueError(f"{entry.name} holds no case: it must end with CASE = Case(...) or with CASES")
        for case in own_cases:
            if case.name in by_name:
                raise ValueError(f"two cases are called '{case.name}', one of {entry.name}")
            by_name[case.name] = case
    return dict(sorted(by_name.items(), key=lambda item: (*_row(item[1].row), item[0])))


def formula(case: Case) -> str:
    """The formula, sketch and source of a case: what the docstring of its module says below the first line."""
    run = case.run.func if isinstance(case.run, partial) else case.run
    text = importlib.import_module(run.__module__).__doc__ or ""
    return text.partition("\n")[2].strip("\n")


def chosen(names: Iterable[str], known: dict[str, Case]) -> list[Case]:
    """The cases of these names, each once. Raises SceneError with the nearest name where one is unknown."""
    return named(names, known, "case", "`masonry verify --list`")


def named(names: Iterable[str], known: dict[str, T], kind: str, listing: str) -> list[T]:
    """Entries of these names, each once; `kind` and the command of the `listing` are for the message."""
    by_name = {}
    for name in names:
        word = name.lower().replace("_", "-")
        if word not in known:
            close = closest(word, known)
            hint = f"did you mean '{close}'?" if close else f"{listing} names them all"
            raise SceneError(f"no {kind} '{name[:80]}': {hint}")
        by_name[word] = known[word]
    return list(by_name.values())


def _row(row: str) -> tuple[str, float, str]:
    """ "2.1" before "2.2", "A9" before "A10"."""
    parts = re.match(r"([A-Za-z]*)\s*([\d.]*)", row)
    letters, number = parts.groups() if parts else ("", "")
    try:
        return letters, float(number or 0.0), row
    except ValueError:
        return letters, 0.0, row
