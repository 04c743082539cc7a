"""A specimen as one line of text, which a scene can hold: its native file, packed by zlib, in base64."""

import base64
import binascii
import zlib
from pathlib import Path
from tempfile import TemporaryDirectory

from geometry.blocks import GeometryError, Specimen, TetMesh
from geometry.files.blocks_h5 import load_blocks, save_blocks

LARGEST = 1 << 29
"""Bytes of the file that a text stands for."""
NAME = "scene.blocks.h5"


def text_of_blocks(specimen: Specimen, mesh: TetMesh | None = None) -> str:
    """The text of a specimen, and of the tets inside it; the same blocks give the same text."""
    with TemporaryDirectory(prefix="masonry-") as folder:
        path = Path(folder) / NAME
        save_blocks(path, specimen, mesh)
        return base64.b64encode(zlib.compress(path.read_bytes(), 9)).decode("ascii")


def blocks_of_text(text: str) -> tuple[Specimen, TetMesh | None]:
    """Blocks given to text_of_blocks, bit for bit. Everything is checked; GeometryError for any other text."""
    try:
        unpacking = zlib.decompressobj()
        content = unpacking.decompress(base64.b64decode(text, validate=True), LARGEST)
    except (binascii.Error, ValueError, zlib.error) as error:
        raise GeometryError(f"no text of blocks, or a damaged one ({error})") from None
    if not unpacking.eof:
        raise GeometryError(f"no text of blocks: it ends too early, or stands for more than {LARGEST} bytes")
    with TemporaryDirectory(prefix="masonry-") as folder:
        path = Path(folder) / NAME
        path.write_bytes(content)
        try:
            return load_blocks(path)
        except GeometryError as error:
            raise GeometryError(str(error).replace(f"'{path}'", "the blocks")) from None
