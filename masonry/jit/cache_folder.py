"""The folder in which compiled code is kept between runs: where it is, who may write to it, what of it is old.

What lies there is run, and its index is a pickle: so nothing is read from a folder that another user may have written
to, and what we make there is for its user alone.
"""

import contextlib
import os
import re
import shutil
import tempfile
from pathlib import Path

from geometry.operating_system import FOR_ONE, SYSTEM
from masonry.jit.sources import COMPILED, source_hash

KEPT = 5
"""Cache folders of older sources that are kept."""
OTHERS = "cells"
"""The cache folder of what does not depend on laws, kernels and kinematics."""
MARKER = "CACHEDIR.TAG"
"""The file that marks a folder as a cache (bford.info/cachedir): programs that make backups leave it out."""
OURS = (
    b"Signature: 8a477f597d28d172789f06886806bc55\n# Made by masonry-dem, which deletes this folder with all in it.\n"
)
"""What the marker says of a folder that was made here. Nothing is deleted that does not carry it."""


def cache_root() -> Path:
    """Where compiled steps are kept: `masonry-dem` in $MASONRY_CACHE, or in the user's cache folder. Raises OSError
    where the user has no home."""
    chosen = os.environ.get("MASONRY_CACHE") or os.environ.get("XDG_CACHE_HOME")
    try:
        return Path(chosen or Path.home() / ".cache").absolute() / "masonry-dem"
    except RuntimeError as error:
        raise OSError(f"{error}") from None


def made_root() -> Path:
    """The folder of `cache_root`, which is there now. Raises OSError where it is not the user's own, or cannot be."""
    root = cache_root()
    root.mkdir(mode=FOR_ONE, parents=True, exist_ok=True)
    require_own(root)
    return root


def cache_folders() -> tuple[Path, Path]:
    """Where the step of these sources is kept, and where the rest is, made and freed of what is old. Raises OSError
    where nothing can be kept."""
    mode = "-plain" if os.environ.get("MASONRY_LANES") == "0" else ""
    root = made_root()
    folder, rest = root / f"{source_hash(COMPILED)}{mode}", root / OTHERS
    for path in (folder, rest):
        _make(path)
    os.utime(folder)
    older = sorted(filter(_is_ours, root.iterdir()), key=lambda path: path.stat().st_mtime)
    for stale in older[:-KEPT]:
        shutil.rmtree(stale, ignore_errors=True)
    return folder, rest


def words_of(error: OSError) -> str:
    """Why a folder is no place to keep code in."""
    if error.filename is None:
        return str(error)
    return f"'{Path(error.filename).parent}' cannot be written to ({error.strerror})"


def require_own(folder: Path) -> None:
    """Raise OSError where a folder belongs to another user, or others may write to it; Windows is not asked."""
    if words := SYSTEM.strangers(folder):
        raise OSError(words)


def _make(folder: Path) -> None:
    """Make a folder of the cache and mark it; one that is there already stays as it is, marked or not, but others see
    no more of what is in it. Raises OSError where it is not the user's own, or cannot be written to."""
    if not folder.is_dir():
        folder.mkdir(mode=FOR_ONE, exist_ok=True)
        (folder / MARKER).write_bytes(OURS)
    require_own(folder)
    SYSTEM.close_to_others(folder)
    with tempfile.TemporaryFile(dir=folder):  # whether it can be written to
        pass


def _is_ours(path: Path) -> bool:
    """Whether this is a folder of compiled steps that was made here: by its name, and by the marker in it."""
    named = re.fullmatch(r"[0-9a-f]{16}(-plain)?", path.name) is not None
    with contextlib.suppress(OSError):
        return named and not path.is_symlink() and (path / MARKER).read_bytes() == OURS
    return False
