"""Power diagrams of one convex domain while they are being improved: sizes held by weights, sites moved to centroids.

Everything here is in units of h, the cube root of the mean volume, about the centre of the domain.
"""

import numpy as np
from scipy.sparse import coo_array, diags_array
from scipy.sparse.linalg import cg
from scipy.spatial import cKDTree

from geometry.cells.domain import Domain
from geometry.cells.space_energy import FAR, MOST_FACES, Diagram, SpaceTargets, energy, find_horizons, measure, room

NEIGHBOURS = 48
"""Sites that are looked at first for each cell; where these may not suffice, all are."""


class SpaceDiagram:
    """A power diagram of n sites (n, 3) with weights (n,); every answer is that of the full diagram.

    volume, centroid    (n,), (n, 3) after update
    energy_of           (n,) after energy; to_site (n, 3), to_weight (n,) its gradient
    """

    def __init__(self, domain: Domain, site: np.ndarray, weight: np.ndarray | None = None) -> None:
        n = len(site)
        self.domain = domain
        self.site = np.array(site, dtype=float)
        self.weight = np.zeros(n) if weight is None else np.array(weight, dtype=float)
        self.volume, self.centroid = np.zeros(n), np.zeros((n, 3))
        self.energy_of, self.to_site, self.to_weight = np.zeros(n), np.zeros((n, 3)), np.zeros(n)
        self._faces = np.zeros(n, dtype=np.int64)
        self._beyond = np.zeros((n, MOST_FACES), dtype=np.int64)
        self._area = np.zeros((n, MOST_FACES))
        self._horizon = np.zeros(n)
        self._cut = room()
        self._walls = _walls(domain)
        self._list()

    @property
    def count(self) -> int:
        return len(self.site)

    def _list(self) -> None:
        n = self.count
        k = min(NEIGHBOURS, n - 1)
        distance, near = cKDTree(self.site).query(self.site, [*range(1, k + 2)])
        is_self = near == np.arange(n)[:, None]
        is_self[~is_self.any(axis=1), -1] = True
        self._near, self._apart = near[~is_self].reshape(n, k).astype(np.int64), distance[:, -1]
        find_horizons(self.site, self.weight, self._near, self._horizon)
        self._listed_at = self.site.copy(), self.weight.copy()

    def _now(self, cells: int) -> Diagram:
        """Arguments of the compiled functions; new lists if they did not suffice for one of 20 of the last cells."""
        if 20 * self._cut.used[2] > cells:
            self._list()
        self._cut.used[2] = 0
        site, weight = self._listed_at
        moved = np.linalg.norm(self.site - site, axis=1)
        moved += moved.max()
        apart = np.maximum(self._apart - moved, 1e-3)
        slope = 0.5 + np.ptp(weight) / (2 * apart**2)  # of a bisector's distance over that of the two sites
        horizon = self._horizon - moved * slope - np.abs(self.weight - weight).max() / apart
        return Diagram(self.site, self.weight, self._near, horizon, *self._walls)

    def update(self) -> bool:
        """Volumes, centroids and faces of all cells; whether none is empty."""
        now = self._now(self.count)
        measure(now, self._cut, self.volume, self.centroid, self._faces, self._beyond, self._area)
        return bool(np.all(self.volume > 0))

    def energy(self, wishes: SpaceTargets, cells: np.ndarray | None = None) -> float:
        """Energy of these cells (all), with its gradient in to_site and to_weight; inf where one is empty."""
        cells = np.arange(self.count) if cells is None else cells
        results = self.energy_of, self.to_site, self.to_weight
        return float(energy(cells, self._now(len(cells)), wishes, self._cut, *results))

    def contacts(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Cells i, j and area (m,) of each shared face, seen from both sides."""
        is_face = np.arange(MOST_FACES) < self._faces[:, None]
        return np.nonzero(is_face)[0], self._beyond[is_face], self._area[is_face]


def _walls(domain: Domain) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """box, box_label, normal, offset and wall of a Diagram: walls across an axis are sides of the box already."""
    box = np.stack([domain.corners.min(axis=0), domain.corners.max(axis=0)], axis=1).ravel()
    label, rest = np.full(6, FAR), np.ones(len(domain.offset), dtype=bool)
    for wall, (normal, offset) in enumerate(zip(domain.normal, domain.offset, strict=True)):
        axis = int(np.argmax(np.abs(normal)))
        side = 2 * axis + int(normal[axis] > 0)
        if abs(normal[axis]) == 1.0 and abs(box[side] - offset * normal[axis]) < 1e-9:
            box[side], label[side], rest[wall] = offset * normal[axis], -1 - wall, False
    box += np.where(label == FAR, np.tile([-1.0, 1.0], 3), 0.0)  # a side through an edge of the domain has no corners
    return box, label, domain.normal[rest], domain.offset[rest], -1 - np.flatnonzero(rest)


def relax(diagram: SpaceDiagram, times: int) -> None:
    """Lloyd's relaxation: every site moves to the centroid of its cell."""
    for _ in range(times):
        diagram.update()
        diagram.site = np.where((diagram.volume > 0)[:, None], diagram.centroid, diagram.site)


def hold_sizes(diagram: SpaceDiagram, target: np.ndarray, tolerance: float = 1e-10, iterations: int = 60) -> bool:
    """Newton's method on the weights until every volume is its target (n,); damped so that no cell dries up.

    Kitagawa, Merigot and Thibert (2019). Returns whether all volumes are within the tolerance of their targets. Where
    weights have left a cell empty they begin anew at 0, at which every site has a cell.
    """
    if not diagram.update():
        diagram.weight = np.zeros_like(diagram.weight)
        if not diagram.update():
            return False
    minimum = 0.5 * min(diagram.volume.min(), target.min())
    for _ in range(iterations):
        lack = target - diagram.volume
        if np.abs(lack / target).max() <= tolerance:
            return True
        step, before, fraction = _newton_step(diagram, lack), diagram.weight, 1.0
        while fraction > 1e-6:
            diagram.weight = before + fraction * step
            whole = diagram.update()
            progress = np.linalg.norm(target - diagram.volume) <= (1 - 0.5 * fraction) * np.linalg.norm(lack)
            if whole and diagram.volume.min() >= minimum and progress:
                break
            fraction *= 0.5
        else:
            diagram.weight = before
            diagram.update()
            return False
    return False


def _newton_step(diagram: SpaceDiagram, lack: np.ndarray) -> np.ndarray:
    """Change of the weights that makes up for the lack of volume (n,), to first order; the first weight stays."""
    n = len(lack)
    i, j, area = diagram.contacts()
    coefficient = area / (2 * np.linalg.norm(diagram.site[i] - diagram.site[j], axis=1))
    diagonal = np.bincount(i, coefficient, n)
    matrix = (diags_array(diagonal) - coo_array((coefficient, (i, j)), shape=(n, n))).tocsr()[1:, 1:]
    step = np.zeros(n)
    if n > 1:
        scaling = diags_array(1 / diagonal[1:])
        step[1:] = cg(matrix, lack[1:], rtol=1e-6, maxiter=5 * n, M=scaling)[0]
    return step
