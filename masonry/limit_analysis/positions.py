"""The least factor of a vehicle over its positions, and the envelope: the factor over the position.

Each position has its own programme. Its mechanism is one that may form wherever the vehicle stands, so its factor at
any other position follows from the work of the loads there, without another programme: an upper bound. Some positions
are solved, evenly over the way; then always the one where these bounds are lowest, until it is one that is solved.
Then no mechanism that is known gives less at any position. At last the position is refined between its neighbours.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize_scalar

from geometry.blocks import Joints, Specimen
from masonry.assembly.growing_loads import bed_of
from masonry.assembly.road.axle_pressure import RoadBed
from masonry.errors import SceneError
from masonry.limit_analysis.limit_loads import downward
from masonry.scene import Scene
from masonry.scene.tables.road.vehicle import Vehicle, Way
from masonry.statics.problem import RigidBodies, RigidContacts, Solution
from masonry.statics.solve import Method, largest_factor

FEWEST, MOST = 80, 160
"""Intervals into which the way is divided: twice as many as faces below it, within these."""
FINE = 8
"""Parts of an interval at which the bounds of mechanisms are looked at."""
TOLERANCE = 1e-6
"""Share of a factor by which a bound may be below it."""
ROUNDS = 12
"""Of refining a position, at most."""


@dataclass(frozen=True)
class FactorEnvelope:
    """Factors of a vehicle over its positions, in the order of direction and position.

    direction  (n,) "x" or "-x", in which it leads
    position   (n,) m, of its middle
    factor     (n,) the largest; inf where forces balance any
    bound      the least that any mechanism of these allows, at any position
    """

    direction: tuple[Way, ...]
    position: np.ndarray
    factor: np.ndarray
    bound: float

    @property
    def least(self) -> int:
        """Number of the least factor."""
        return int(np.argmin(self.factor))

    def along(self, direction: Way) -> tuple[np.ndarray, np.ndarray]:
        """Positions (m) and factors of one direction."""
        of = np.array([way == direction for way in self.direction])
        return self.position[of], self.factor[of]

    def standing(self, scene: Scene) -> Scene:
        """The scene with its vehicle at the least factor."""
        assert scene.vehicle is not None
        place = {"position": float(self.position[self.least]), "between": None}
        vehicle = scene.vehicle.model_copy(update=place | {"direction": self.direction[self.least]})
        return scene.model_copy(update={"vehicle": vehicle})


def envelope_of(
    scene: Scene, specimen: Specimen, joints: Joints, bodies: RigidBodies, contacts: RigidContacts, method: Method
) -> FactorEnvelope:
    """Of the vehicle of a scene, which travels; bodies: with dead loads alone, which they bear.

    Raises SceneError where it presses on nothing that moves, and where forces balance any factor everywhere.
    """
    vehicle = scene.vehicle
    assert vehicle is not None
    bed = bed_of(scene, specimen, joints)
    reach = bed.reach(vehicle)
    low, high = vehicle.between or reach
    if high <= reach[0] or low >= reach[1]:
        raise SceneError(
            f"vehicle.between: nothing presses on '{vehicle.on}' from {low:.6g} to {high:.6g} m; "
            f"it reaches from {reach[0]:.6g} to {reach[1]:.6g} m"
        )
    search = PositionSearch(bed, vehicle, bodies, contacts, method)
    intervals = int(np.clip(2 * len(bed.owner), FEWEST, MOST))
    for direction in vehicle.directions:
        search.add_way(direction, np.linspace(low, high, FINE * intervals + 1))
    return search.envelope()


class PositionSearch:
    """Programmes at some of many positions, and what their mechanisms bound all others by."""

    def __init__(
        self,
        bed: RoadBed,
        vehicle: Vehicle,
        bodies: RigidBodies,
        contacts: RigidContacts,
        method: Method,
    ) -> None:
        self.bed, self.vehicle = bed, vehicle
        self.bodies, self.contacts, self.method = bodies, contacts, method
        self.ways: list[tuple[Way, float]] = []
        self.loads: list[np.ndarray] = []
        self.mechanisms: list[Solution] = []
        self.factor: dict[int, float] = {}

    def load_at(self, direction: Way, position: float) -> np.ndarray:
        """(B, 6) at a factor of 1."""
        return downward(self.bed.pressure(self.vehicle, position, direction), self.bodies.centre)

    def add_way(self, direction: Way, positions: np.ndarray) -> None:
        """Positions (n,) m in rising order."""
        for position in positions.tolist():
            self.add(direction, position)

    def add(self, direction: Way, position: float) -> int:
        """One position more; its number."""
        self.ways.append((direction, position))
        self.loads.append(self.load_at(direction, position))
        return len(self.ways) - 1

    def solve(self, number: int) -> float:
        """The factor at a position by its number, whose mechanism then bounds all others."""
        if number not in self.factor:
            live = self.loads[number]
            self.factor[number] = np.inf
            if live[self.bodies.free].any():
                solution = largest_factor(replace(self.bodies, live=live), self.contacts, self.method)
                if solution.status == "solved":
                    self.factor[number] = solution.factor
                    self.mechanisms.append(solution)
        return self.factor[number]

    def bounds(self, loads: np.ndarray) -> np.ndarray:
        """(n,) the least factor that known mechanisms allow under loads (n, B, 6)."""
        bound = np.full(len(loads), np.inf)
        for mechanism in self.mechanisms:
            work = np.einsum("nbi,bi->n", loads, mechanism.velocity)
            bound = np.minimum(bound, np.divide(mechanism.factor, work, out=np.full(len(work), np.inf), where=work > 0))
        return bound

    def envelope(self) -> FactorEnvelope:
        """Solves what it takes. Raises SceneError where nothing has a limit."""
        for number in range(0, len(self.ways), FINE):
            self.solve(number)
        if not self.mechanisms:
            raise SceneError("there is no limit: forces in the joints can balance the vehicle wherever it stands")
        loads = np.array(self.loads)
        while (lowest := int(np.argmin(self.bounds(loads)))) not in self.factor:
            self.solve(lowest)
        self._refine(min(self.factor, key=lambda number: self.factor[number]))
        solved = sorted(self.factor, key=lambda number: self.ways[number])
        directions, positions = zip(*(self.ways[number] for number in solved), strict=True)
        factor = np.array([self.factor[number] for number in solved])
        bound = min(float(self.bounds(np.array(self.loads)).min()), float(factor.min()))
        return FactorEnvelope(directions, np.array(positions), factor, bound)

    def _refine(self, number: int) -> None:
        """Positions between a position and its neighbours, until the lowest bound there is a factor."""
        direction, position = self.ways[number]
        near = sorted(x for way, x in self.ways if way == direction)
        k = near.index(position)
        low, high = near[max(k - 1, 0)], near[min(k + 1, len(near) - 1)]
        for _ in range(ROUNDS):
            position, bound = _lowest(lambda x: float(self.bounds(self.load_at(direction, x)[None])[0]), low, high)
            if bound >= min(self.factor.values()) * (1.0 - TOLERANCE):
                return
            self.solve(self.add(direction, position))


def _lowest(bound: Callable[[float], float], low: float, high: float) -> tuple[float, float]:
    """Where a function is lowest between two places, and how low."""
    places = np.linspace(low, high, 2 * FINE + 1)
    k = int(np.argmin([bound(x) for x in places.tolist()]))
    around = places[max(k - 1, 0)], places[min(k + 1, len(places) - 1)]
    best = minimize_scalar(bound, bounds=around, method="bounded", options={"xatol": 1e-6 * (high - low)})
    return (float(best.x), float(best.fun)) if best.fun <= bound(places[k]) else (float(places[k]), bound(places[k]))
