"""What a file of solids or of a mesh gives: blocks with the names and colours of the file, and its tets."""

from dataclasses import dataclass

import numpy as np

from geometry.blocks import Blocks, TetMesh


@dataclass(frozen=True)
class Imported:
    """Solids read from a file, in metres.

    blocks   one a solid; groups are those of the file, or "units" where it has none
    names    one a block, "" where the file has none
    colours  (B, 3) red, green, blue in 0..1, NaN rows where the file has none; None if it has none at all
    mesh     tets, if the file holds any
    notes    sentences for the user: what was cut up, left out or changed
    """

    blocks: Blocks
    names: tuple[str, ...]
    colours: np.ndarray | None
    mesh: TetMesh | None = None
    notes: tuple[str, ...] = ()
