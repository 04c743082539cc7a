"""Blocks put together part by part, with the sets that they belong to."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import Blocks
from geometry.polyhedra.construct import concatenate, from_boxes


class Gathering:
    """Parts of a structure in the order in which they came; each block is a unit of its own.

    sets  name -> block numbers
    """

    def __init__(self) -> None:
        self.parts: list[Blocks] = []
        self.sets: dict[str, np.ndarray] = {}

    @property
    def count(self) -> int:
        return sum(part.count for part in self.parts)

    def add(self, blocks: Blocks, *names: str) -> np.ndarray:
        """Blocks behind all others, in the sets of these names; returns their numbers."""
        members = self.count + np.arange(blocks.count)
        self.parts.append(blocks)
        for name in names:
            self.sets[name] = np.concatenate([self.sets.get(name, members[:0]), members])
        return members

    def add_boxes(
        self, low: Sequence[Sequence[float]], high: Sequence[Sequence[float]], group: str, *names: str
    ) -> None:
        """Boxes between corners (n, 3) m, as `add`."""
        zero = np.zeros(len(low))
        self.add(from_boxes(np.array(low, dtype=float), np.array(high, dtype=float), zero, zero, (group,)), *names)

    def blocks(self) -> Blocks:
        """All of them, numbered as units."""
        blocks = concatenate(self.parts)
        blocks.unit[:] = np.arange(blocks.count)
        return blocks
