"""Where what is compiled for laws of other packages is kept: in a folder named after the sources of these laws.

The types that a function is compiled for say which law is in it. So an edited law is never served stale, an unedited
one is found by the next process, and what is compiled for our laws alone stays where it was: it is found as well after
the other package has gone.
"""

import hashlib
import os
import shutil
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

from numba.core.types.containers import BaseTuple

from geometry.jit_cache import CheckedCache
from masonry.jit.sources import is_ours, package_hash

KEPT = 12
"""Folders of laws of other packages that are kept, the latest."""
OTHERS = "laws-of-others"


def outside_classes(kinds: Iterable[Any]) -> Iterator[type]:
    """Every NamedTuple in some types that another package defines."""
    for kind in kinds:
        if isinstance(kind, BaseTuple):
            named = getattr(kind, "instance_class", None)
            if named is not None and not is_ours(named.__module__):
                yield named
            yield from outside_classes(kind.types)


@cache
def hash_of_laws(classes: frozenset[type]) -> str:
    """Hash (hex) of the sources of some laws of other packages; "" where there are none."""
    found = sorted(f"{c.__module__}.{c.__qualname__} {package_hash(c)}" for c in classes)
    return hashlib.sha256("\n".join(found).encode()).hexdigest()[:16] if found else ""


class LawCache(CheckedCache):
    """The cache of a function, which puts what holds laws of other packages into a folder of their own."""

    def __init__(self, function: Any) -> None:
        super().__init__(function)
        self._ours = self._cache_file

    def _load_overload(self, sig: Any, target_context: Any) -> Any:
        self._turn_to(sig)
        return super()._load_overload(sig, target_context)

    def _save_overload(self, sig: Any, data: Any) -> None:
        self._turn_to(sig)
        super()._save_overload(sig, data)

    def _turn_to(self, sig: Any) -> None:
        """Read and write where the laws in a signature have their place."""
        laws = hash_of_laws(frozenset(outside_classes(getattr(sig, "args", sig))))
        self._cache_file = self.files(_folder(self._cache_path, laws)) if laws else self._ours


@cache
def _folder(root: str, laws: str) -> str:
    """The folder of some laws; the oldest ones make room for it."""
    folder = Path(root) / OTHERS / laws
    folder.mkdir(parents=True, exist_ok=True)
    os.utime(folder)
    for stale in sorted(folder.parent.iterdir(), key=lambda path: path.stat().st_mtime)[:-KEPT]:
        shutil.rmtree(stale, ignore_errors=True)
    return str(folder)
