"""Files of blocks that scenes name (`kind = "file"`), each read once for as long as it stays as it is."""

from functools import lru_cache
from pathlib import Path

from geometry.blocks import Specimen, TetMesh
from geometry.files.blocks_h5 import load_blocks
from masonry.errors import SceneError


def blocks_from(path: str) -> tuple[Specimen, TetMesh | None]:
    """Blocks and sets of the file, and the tets if it holds any. Raises SceneError or GeometryError."""
    try:
        state = Path(path).stat()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise SceneError(
            f"specimen.path = '{path}' cannot be read: {reason}; `masonry import` and "
            "`masonry.write_blocks` write such files"
        ) from None
    return _read(path, state.st_mtime_ns, state.st_size)


@lru_cache(maxsize=2)
def _read(path: str, changed: int, size: int) -> tuple[Specimen, TetMesh | None]:
    return load_blocks(Path(path))
