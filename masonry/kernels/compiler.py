"""How the step is compiled, and where what was compiled is kept.

Numba serves a changed law stale from its cache when only another file changed: so the cache folder is named after a
hash of every source file that can be compiled.
"""

import hashlib
import os
import shutil
from functools import cache
from pathlib import Path

import numba

KEPT = 5
"""Cache folders of older sources that are kept."""


ALL = ("geometry", "masonry")
COMPILED = ("masonry/laws", "masonry/kernels", "masonry/kinematics")


@cache
def source_hash(folders: tuple[str, ...] = ALL) -> str:
    """Hash (hex) of the sources in some folders; by default all that can change a number in a result."""
    root = Path(__file__).resolve().parents[2]
    digest = hashlib.sha256()
    for folder in folders:
        for path in sorted((root / folder).rglob("*.py")):
            digest.update(path.relative_to(root).as_posix().encode())
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def cache_root() -> Path:
    """Where compiled steps are kept: $MASONRY_CACHE, or the user's cache folder."""
    chosen = os.environ.get("MASONRY_CACHE")
    if chosen:
        return Path(chosen)
    return Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "masonry-dem"


def _use_cache_folder() -> None:
    root = cache_root()
    folder = root / source_hash(COMPILED)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        os.utime(folder)
        older = sorted((p for p in root.iterdir() if p.is_dir()), key=lambda p: p.stat().st_mtime)
        for stale in older[:-KEPT]:
            shutil.rmtree(stale, ignore_errors=True)
    except OSError:
        return  # no place to write: Numba then falls back to its own choice
    numba.config.CACHE_DIR = str(folder)


_use_cache_folder()

OPTIONS = {"cache": True, "error_model": "numpy", "fastmath": {"contract"}}
"""`contract` alone fuses multiply and add, and keeps NaN tests and the order of sums."""

jit = numba.njit(**OPTIONS)
jit_parallel = numba.njit(parallel=True, **OPTIONS)
