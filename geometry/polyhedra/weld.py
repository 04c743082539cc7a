"""Points that lie closer together than a width are one."""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree


def weld(points: np.ndarray, width: float, rank: np.ndarray | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Which of the points (n, d) are kept (k,), and the number (n,) in 0..k-1 of each point among them.

    rank  (n,) of points that are one the first of the highest rank is kept; without ranks the first of all
    """
    single, same = _without_repeats(points)
    near = cKDTree(points[single]).query_pairs(width, output_type="ndarray")
    graph = coo_array((np.ones(len(near)), (near[:, 0], near[:, 1])), shape=(len(single),) * 2)
    number = connected_components(graph, directed=False)[1].astype(np.int64)[same]
    order = np.arange(len(points)) if rank is None else np.argsort(-rank, kind="stable")
    return order[np.unique(number[order], return_index=True)[1]], number


def _without_repeats(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Which of the points (n, d) are the first at their very place (k,), and the number (n,) of each among these: the
    pairs among n equal points are n^2 / 2, so that these are not looked for."""
    order = np.lexsort(points.T)
    new = np.append(True, (points[order[1:]] != points[order[:-1]]).any(axis=1))[: len(points)]
    first = order[new]  # lexsort is stable
    place = np.empty(len(points), dtype=np.int64)
    place[order] = np.cumsum(new) - 1
    rank = np.argsort(first)
    return first[rank], np.argsort(rank)[place]
