"""How far the bodies of a model have moved from where they were made, and since a rest: in m, and as dofs."""

import numpy as np

from masonry.configuration import energy
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
    return {kind: model.u[: len(body.v)] if kind == "tets" else body.q for kind, body in energy.present(model)}


def moved_since(model: Model, kept: Arrays) -> Arrays:
    """How dofs have changed since a state that was kept."""
    before = kept_dofs(model, kept)
    return {kind: now - before[kind] for kind, now in dofs(model).items()}


def blocks_reach(model: Model, moved: list[np.ndarray]) -> np.ndarray:
    """(B, 2) m, how far each block has moved, and how much it turned and strained; moved: as of `places`. Of tets it is
    the node that moved most."""
    layout, found = model.layout, np.zeros((model.blocks.count, 2))
    for (kind, _), part in zip(energy.present(model), moved, strict=True):
        far = np.column_stack([np.linalg.norm(part[:, :3], axis=1), np.linalg.norm(part[:, 3:], axis=1)])
        if kind == "tets":
            assert layout.mesh is not None
            far = np.maximum.reduceat(far, layout.mesh.node_start[layout.members[kind]])
        found[layout.members[kind]] = far
    return found


def relative_travel(model: Model, moved: list[np.ndarray]) -> np.ndarray:
    """(B,) how far each block has moved, over the one that moved most; zeros where none did. moved: as of `places`."""
    layout, found = model.layout, np.zeros(model.blocks.count)
    for (kind, _), part in zip(energy.present(model), moved, strict=True):
        far = np.linalg.norm(part, axis=1)
        if kind == "tets":
            assert layout.mesh is not None
            far = np.maximum.reduceat(far, layout.mesh.node_start[layout.members[kind]])
        found[layout.members[kind]] = far
    return found / max(float(found.max(initial=0.0)), 1e-300)


def kept_dofs(model: Model, kept: Arrays) -> Arrays:
    """The same of a state that was kept (configuration/model_state.py)."""
    return {kind: kept["u" if kind == "tets" else f"{kind}.q"][: len(now)] for kind, now in dofs(model).items()}
