"""A file that the user names: what stands there already is replaced on request only, unless we drew it."""

import os
from pathlib import Path

from masonry.errors import SceneError, closest, nearest

MARK = "Drawn by masonry-dem"
"""What pictures and movies hold, so that one can be drawn again over the last one."""
FORMATS = ("png", "pdf", "svg")
"""Of pictures."""
ENDS = 4096
"""Bytes at the beginning and the end of a file, among which the mark is."""


def require_picture(path: Path, option: str = "") -> None:
    """Raise SceneError for the path of a picture whose suffix is none of FORMATS."""
    if path.suffix[1:] not in FORMATS:
        near = f"{path.stem or 'picture'}.{closest(path.suffix[1:], FORMATS) or FORMATS[0]}"
        raise SceneError(f"{option} '{path}': a picture is a .png, .pdf or .svg file; nearest: '{near}'".strip())


def require_format(form: str) -> None:
    """Raise SceneError for what is none of FORMATS."""
    if form not in FORMATS:
        raise SceneError(f"form = {form!r:.60}; {nearest(str(form), FORMATS)}")


def require_free(path: Path, overwrite: bool) -> None:
    """Raise SceneError where a file would be replaced that does not hold our mark, and the user did not ask for it."""
    if os.path.lexists(path) and not overwrite and not path.is_dir() and not is_marked(path):
        raise SceneError(f"'{path}' exists already; --overwrite replaces it")


def remove_pictures(folder: Path, *stems: str) -> None:
    """Remove FOLDER/STEM in all FORMATS, of what was there before: a picture of other numbers, or in another format.
    What we did not draw stays. Raises OSError."""
    for path in (folder / f"{stem}.{form}" for stem in stems for form in FORMATS):
        if is_marked(path):
            path.unlink()


def is_marked(path: Path) -> bool:
    """Whether a file is a picture or a movie that we drew."""
    if path.is_symlink() or not path.is_file():
        return False
    try:
        with path.open("rb") as file:
            first = file.read(ENDS)
            file.seek(max(path.stat().st_size - ENDS, 0))
            return MARK.encode() in first or MARK.encode() in file.read(ENDS)
    except OSError:
        return False
