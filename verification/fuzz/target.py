"""What the targets of a search by coverage share: bytes become a file, and only what a user may be told is raised."""

import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

from geometry.blocks import GeometryError
from masonry.errors import SceneError


@cache
def _folder() -> Path:
    return Path(tempfile.mkdtemp(prefix="masonry-fuzz-"))


def with_file(data: bytes, suffix: str, read: Callable[[Path], Any]) -> None:
    """Call `read` with a file of these bytes; anything but SceneError and GeometryError comes out."""
    path = _folder() / f"a{suffix}"
    path.write_bytes(data)
    refused(read, path)


def refused(read: Callable[[Any], Any], what: Any) -> None:
    """Call it; a refusal is as good as an answer, but must be a short message."""
    try:
        read(what)
    except (SceneError, GeometryError) as error:
        assert 0 < len(str(error)) < 100_000
