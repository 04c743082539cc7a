"""Compiled functions that are kept between runs, in files with a checksum.

Numba serves what lies in its cache as it is: a damaged file ends in a traceback, or in wrong code. Here it counts as
absent, and what cannot be kept is compiled again by the next process.
"""

import contextlib
import hashlib
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

from numba import njit
from numba.core.caching import FunctionCache, IndexDataCacheFile
from numba.core.runtime import rtsys

NOT_KEPT: list[str] = []
"""Why something that was compiled by this process could not be kept, one line each."""
NOWHERE: list[str] = []
"""Why nothing is kept at all, where that is so: there is no folder that this user, and nobody else, may write to."""
DIGEST = hashlib.sha256().digest_size


def _digest(key: Any) -> str:
    return hashlib.sha256(repr(key).encode()).hexdigest()[:16]


class CheckedFiles(IndexDataCacheFile):
    """Numba's index and data files of a function, the data with their checksum before them."""

    def _load_index(self) -> Any:
        try:
            return super()._load_index()
        except Exception:  # whatever unpickling of damaged bytes comes to
            return {}

    def save(self, key: Any, data: Any) -> None:
        """As Numba's, but what is kept is named after its key. Numba counts: two processes that keep something of one
        function at once take the same number, and one of them is served the code of the other ever after."""
        overloads = self._load_index()
        if key not in overloads:
            overloads[key] = f"{self._index_name.removesuffix('.nbi')}.{_digest(key)}.nbc"
            self._save_index(overloads)
        self._save_data(overloads[key], data)

    def _load_data(self, name: str) -> Any:
        whole = Path(self._data_path(name)).read_bytes()
        digest, content = whole[:DIGEST], whole[DIGEST:]
        if hashlib.sha256(content).digest() != digest:
            raise OSError(f"{name} is damaged")  # which `load` takes for a file that is not there
        return pickle.loads(content)  # our own file, as it was written

    def _save_data(self, name: str, data: Any) -> None:
        content = self._dump(data)
        with self._open_for_write(self._data_path(name)) as file:
            file.write(hashlib.sha256(content).digest() + content)


class CheckedCache(FunctionCache):
    """Numba's cache of a function, in checked files."""

    def __init__(self, function: Any) -> None:
        super().__init__(function)
        stamp = self._impl.locator.get_source_stamp()
        self._cache_file = CheckedFiles(self._cache_path, self._impl.filename_base, stamp)

    def _index_key(self, sig: Any, codegen: Any) -> Any:
        """Numba's, with the names of the types in place of the types: an index that names a class of another package
        is read as well where that package has gone."""
        _, *rest = super()._index_key(sig, codegen)
        return str(sig), *rest

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """As Numba's, but without the tools of compiling: half of what a short run would load, and not needed here."""
        rtsys.initialize(target_context)
        with contextlib.suppress(OSError):
            return self._load_overload(sig, target_context)

    def save_overload(self, sig: Any, data: Any) -> None:
        """As Numba's; where it cannot be written the program goes on without. The copy of the intermediate code that
        Numba makes for the file, and would keep, is left to who links it to make again."""
        try:
            super().save_overload(sig, data)
            data.library._shared_module = None
        except OSError as error:
            NOT_KEPT.append(f"{self._cache_path}: {error.strerror or error}")


def keep_code(dispatcher: Any, function: Callable[..., Any]) -> None:
    """Have what is compiled of a function kept, where there is a place for it."""
    with contextlib.suppress(RuntimeError):  # Numba's word for none
        if not NOWHERE:
            dispatcher._cache = CheckedCache(function)


def compiled(function: Callable[..., Any]) -> Any:
    """A decorator: compile by `numba.njit`, and keep what was compiled."""
    dispatcher = njit(function)
    keep_code(dispatcher, function)
    return dispatcher
