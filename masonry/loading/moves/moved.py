"""How far the bodies of a model have moved from where they were made, and since a rest: in m, and as dofs."""

import numpy as np

from masonry.configuration.parts.parts import parts_of
from masonry.model.model import Model

Arrays = dict[str, np.ndarray]


def places(model: Model, size: float) -> list[np.ndarray]:
    """(rows, n) m, how far blocks, or the nodes of tets, are from where they were made; turns and strains of blocks
    times a size (m)."""
    return [moved * np.where(np.arange(moved.shape[1]) < 3, 1.0, size) for moved in dofs(model).values()]


def reach(moved: np.ndarray) -> float:
    """m, the most that anything has moved."""
    return float(np.linalg.norm(moved, axis=1).max(initial=0.0))


def dofs(model: Model) -> Arrays:
    """By kind of motion, the dofs of the bodies (rows, n): m, and turns or strains."""
    return {part.name: part.displacements for part in parts_of(model)}


def moved_since(model: Model, kept: Arrays) -> Arrays:
    """How dofs have changed since a state that was kept."""
    before = kept_dofs(model, kept)
    return {kind: now - before[kind] for kind, now in dofs(model).items()}


def blocks_reach(model: Model, moved: list[np.ndarray]) -> np.ndarray:
    """(B, 2) m, how far each block has moved, and how much it turned and strained; moved: as of `places`. Of tets it is
    the node that moved most."""
    reached = np.zeros((model.blocks.count, 2))
    for part, way in zip(parts_of(model), moved, strict=True):
        far = np.column_stack([np.linalg.norm(way[:, :3], axis=1), np.linalg.norm(way[:, 3:], axis=1)])
        reached[part.blocks] = part.largest(far)
    return reached


def relative_travel(model: Model, moved: list[np.ndarray]) -> np.ndarray:
    """(B,) how far each block has moved, over the one that moved most; zeros where none did. moved: as of `places`."""
    reached = np.zeros(model.blocks.count)
    for part, way in zip(parts_of(model), moved, strict=True):
        reached[part.blocks] = part.largest(np.linalg.norm(way, axis=1))
    return reached / max(float(reached.max(initial=0.0)), 1e-300)


def kept_dofs(model: Model, kept: Arrays) -> Arrays:
    """The same of a state that was kept (configuration/model_state.py)."""
    return {part.name: part.kept(kept) for part in parts_of(model)}
