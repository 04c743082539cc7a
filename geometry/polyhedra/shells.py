"""Triangles round a solid: turned so that all look outwards, and tested to be closed."""

import numpy as np

from geometry.blocks import GeometryError

Edge = tuple[int, int]


def outward(points: np.ndarray, triangles: np.ndarray, solid: str) -> np.ndarray:
    """The triangles (T, 3) into points (P, 3) of a closed solid, counter-clockwise seen from outside it.

    A solid may have cavities: the shell with the largest volume is the outer one. Raises GeometryError, which calls it
    by the name solid, if an edge has a free side or if the triangles cannot be turned to agree.
    """
    sharing: dict[Edge, list[int]] = {}
    for t, (a, b, c) in enumerate(triangles.tolist()):
        for i, j in ((a, b), (b, c), (c, a)):
            sharing.setdefault((min(i, j), max(i, j)), []).append(t)
    if any(len(owners) % 2 for owners in sharing.values()):
        raise GeometryError(f"{solid} is not closed: an edge of it belongs to one face only; mend it where it was made")
    shell = np.full(len(triangles), -1)
    result = triangles.copy()
    for seed in range(len(triangles)):
        if shell[seed] < 0:
            _turn_alike(result, shell, seed, sharing)
    _require_balance(result, solid)
    return _outer_shell_first(points, result, shell)


def _turn_alike(triangles: np.ndarray, shell: np.ndarray, seed: int, sharing: dict[Edge, list[int]]) -> None:
    """All triangles that hang together with the seed over edges of two, turned as it is; they get its shell number."""
    shell[seed] = seed
    waiting = [seed]
    while waiting:
        t = waiting.pop()
        a, b, c = triangles[t].tolist()
        for i, j in ((a, b), (b, c), (c, a)):
            owners = sharing[min(i, j), max(i, j)]
            other = owners[0] + owners[1] - t
            if len(owners) == 2 and shell[other] < 0:
                p, q, r = triangles[other].tolist()
                if (i, j) in ((p, q), (q, r), (r, p)):
                    triangles[other] = (p, r, q)
                shell[other] = seed
                waiting.append(other)


def _require_balance(triangles: np.ndarray, solid: str) -> None:
    """Every edge is gone along as often one way as the other."""
    start, end = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    edge = np.stack([np.minimum(start, end), np.maximum(start, end)], axis=1)
    _, of_edge = np.unique(edge, axis=0, return_inverse=True)
    if np.any(np.bincount(of_edge.ravel(), weights=np.where(start < end, 1.0, -1.0))):
        raise GeometryError(f"{solid} encloses no volume: its faces cannot be turned to agree")


def _outer_shell_first(points: np.ndarray, triangles: np.ndarray, shell: np.ndarray) -> np.ndarray:
    arm = points[triangles] - points[triangles[0, 0]]
    volume = np.bincount(shell, weights=np.einsum("ti,ti->t", arm[:, 0], np.cross(arm[:, 1], arm[:, 2])) / 6)
    outer = int(np.argmax(np.abs(volume)))
    sense = np.where(np.arange(len(volume)) == outer, 1.0, -1.0)
    turned = (volume * sense)[shell] < 0
    return np.where(turned[:, None], triangles[:, ::-1], triangles)
