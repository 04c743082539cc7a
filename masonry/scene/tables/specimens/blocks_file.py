"""Table of a scene for blocks from a file, and the files themselves: each is read once for all that asks for it."""

from functools import lru_cache
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import AfterValidator, Field, model_validator

from geometry.blocks import Blocks, GeometryError, Specimen, TetMesh
from geometry.files.blocks_h5 import load_blocks
from geometry.files.blocks_text import blocks_of_text
from geometry.polyhedra.measures import volumes
from masonry.errors import SceneError
from masonry.scene.tables.specimens.common import Divided, SpecimenTable, count_of_parts, divided_as_asked
from masonry.scene.tables.types import KeyedError, refuse_both


def _absolute(path: str) -> str:
    """Where a path leads from here, so that a scene which is written elsewhere still finds its blocks."""
    return str(Path(path).absolute())


class FileSpec(SpecimenTable, Divided):
    """Blocks from a file that `masonry import` or `masonry.write_blocks` wrote, or such a file within the scene, as
    text; the units among them may be divided."""

    placed_by_hand = True
    made_elsewhere = True

    kind: Literal["file"]
    path: Annotated[str, Field(min_length=1), AfterValidator(_absolute)] | None = None
    content: Annotated[str, Field(min_length=1)] | None = None

    def read(self) -> tuple[Specimen, TetMesh | None]:
        """Blocks and sets of the file, and the tets if there are any. Raises SceneError or GeometryError."""
        if self.content is not None:
            return _unpacked(self.content)
        assert self.path is not None
        try:
            state = Path(self.path).stat()
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or error
            raise SceneError(
                f"specimen.path = '{self.path}' cannot be read: {reason}; `masonry import` and "
                "`masonry.write_blocks` write such files"
            ) from None
        return _read(self.path, state.st_mtime_ns, state.st_size)

    def build(self) -> Specimen:
        """The blocks with named sets, the units divided; raises SceneError or GeometryError."""
        return divided_as_asked(self.read()[0], self)

    @property
    def blocks_and_volume(self) -> tuple[float, float]:
        """About how many blocks, and the volume (m3) of all of them."""
        blocks = self.read()[0].blocks
        volume = float(volumes(blocks).sum())
        if not self.is_divided:
            return blocks.count, volume
        depth = float(np.ptp(blocks.points[:, 1])) if blocks.count else 0.0
        return blocks.count + count_of_parts(self, blocks.count, volume, depth), volume

    @property
    def bridges_gaps(self) -> bool:
        """Whether its joints are stated, between blocks that only nearly meet."""
        return self.read()[0].joints is not None

    @property
    def own_mesh(self) -> tuple[TetMesh, Blocks] | None:
        """The tets that its blocks brought with them, and these blocks; None without, or where units are divided."""
        specimen, mesh = self.read()
        return None if mesh is None or self.is_divided else (mesh, specimen.blocks)

    @model_validator(mode="after")
    def _names_its_blocks_once(self) -> "FileSpec":
        if self.path is None and self.content is None:
            raise KeyedError(
                "path", "missing; the file of blocks, which `masonry import` or masonry.write_blocks wrote"
            )
        refuse_both(self, "path", "content")
        return self


@lru_cache(maxsize=2)
def _unpacked(content: str) -> tuple[Specimen, TetMesh | None]:
    try:
        return blocks_of_text(content)
    except GeometryError as error:
        raise SceneError(f"specimen.content: {error}") from None


@lru_cache(maxsize=2)
def _read(path: str, changed: int, size: int) -> tuple[Specimen, TetMesh | None]:
    return load_blocks(Path(path))
