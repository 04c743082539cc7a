"""How far the bodies of a model have moved from where they were made, and since a rest: in m, and as dofs."""

from functools import cache

import numpy as np

from masonry.configuration.parts.parts import parts_of
from masonry.model.model import Model

Arrays = dict[str, np.ndarray]


def places(model: Model, size: float) -> list[np.ndarray]:
    """(rows, n) m, how far blocks, or the nodes of tets, are from where they were made; turns and strains of blocks
    times a size (m)."""
    return [moved * lengths(moved.shape[1], size) for moved in dofs(model).values()]


@cache
def lengths(dofs: int, size: float) -> np.ndarray:
    """(dofs,) by what dofs are multiplied to be m."""
    return np.where(np.arange(dofs) < 3, 1.0, size)


def reach(moved: np.ndarray) -> float:
    """m, the most that anything has moved."""
    return float(np.sqrt((moved * moved).sum(axis=1).max(initial=0.0)))


def dofs(model: Model) -> Arrays:
    """By kind of motion, the dofs of the bodies (rows, n): m, and turns or strains."""
    return {part.name: part.displacements for part in parts_of(model)}


def moved_since(model: Model, copies: Arrays) -> Arrays:
    """How dofs have changed since copies of the model were made (configuration/model_state.py)."""
    before = copied_dofs(model, copies)
    return {kind: now - before[kind] for kind, now in dofs(model).items()}


def blocks_reach(model: Model, moved: list[np.ndarray]) -> np.ndarray:
    """(B, 2) m, how far each block has moved, and how much it turned and strained; moved: as of `places`. Of tets it is
    the node that moved most."""
    reached = np.zeros((model.blocks.count, 2))
    for part, path in zip(parts_of(model), moved, strict=True):
        far = np.column_stack([np.linalg.norm(path[:, :3], axis=1), np.linalg.norm(path[:, 3:], axis=1)])
        reached[part.blocks] = part.largest(far)
    return reached


def relative_travel(model: Model, moved: list[np.ndarray]) -> np.ndarray:
    """(B,) how far each block has moved, over the one that moved most; zeros where none did. moved: as of `places`."""
    reached = np.zeros(model.blocks.count)
    for part, path in zip(parts_of(model), moved, strict=True):
        reached[part.blocks] = part.largest(np.linalg.norm(path, axis=1))
    return reached / max(float(reached.max(initial=0.0)), 1e-300)


def copied_dofs(model: Model, copies: Arrays) -> Arrays:
    """The dofs in such copies."""
    return {part.name: part.saved_displacements(copies) for part in parts_of(model)}
