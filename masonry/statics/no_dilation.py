"""Collapse without dilation: forces are followed from the dead loads until the factor of the load rises no more.

With friction that does not dilate, the limit theorems fail, and a structure has many factors at which it can begin to
fall: which one it finds depends on the normal forces that joints come to have before. So they are followed on the way
that a structure takes: from the dead loads, which come first and all at once, in joints of one stiffness per area.

Each step lets the load move on and asks for the forces, of all that are borne, whose change stores the least energy
(Haar and von Karman 1909): the greatest of  factor - pace |change of forces|^2 / 2.  Friction bounds the shear force of
a contact by a cylinder |T| <= c + mu N for the normal force N of the same step, which is found by a row of such
problems: so nothing rises that slides (Krabbenhoft, Karim, Lyamin, Sloan: Associated computational plasticity schemes
for nonassociated frictional materials. Int. J. Numer. Methods Eng. 90 (2012) 1089-1117). It ends where by the theorems,
for these cylinders, no force in the joints balances more: a mechanism that slides without rising; or beyond a peak,
where what slides loses the pressure that held it.
"""

from dataclasses import dataclass, replace
from math import inf

import numpy as np

from masonry.statics.balance import unbalanced
from masonry.statics.cones import NearForces, solve_cones
from masonry.statics.equilibrium import equilibrium
from masonry.statics.interior_point import ConeSolver
from masonry.statics.plane import flattened, plane_of
from masonry.statics.problem import RigidBodies, RigidContacts, Sizes, Solution
from masonry.statics.sizes import alike
from masonry.statics.solve import ANY, EXACTLY, STANDS, UPWARD, Method, Range, in_space, largest_factor

SOFTER = 2.5
"""Normal over shear stiffness of the joints."""
FIRST, FASTER, SLOWEST, MOST = 0.125, 0.8, 1e12, 80
"""Share of the way to the factor with dilation by which a step may raise the factor; pace of a step over that of the
step before; the greatest pace; steps at most."""
NEAREST = 1e-2
"""The least pace where all loads are there from the beginning: below, the tolerance of the solver presses joints that
nothing presses."""
CLEARLY = 1.5
"""Times that rise, the first problem of a step tells that it would be too large: the others are not solved."""
RISE, OPEN, DROP = 1e-4, 1e-3, 5e-3
"""Rise of the factor in a step, over the factor, below which its end is looked for; how far it may be from the bound of
the theorems, over the factor, at the end; and the drop after which a factor was a peak, over that with dilation."""
SAME, TRIES, TRIES_AT_REST = 5e-4, 6, 30
"""Change of normal forces, over the unit of each, at which the row of problems of a step ends; its length."""
GREAT = 10.0
"""Times all loads, the cohesion with which a joint does not slide."""
BEYOND = 5e-3
"""Shear beyond friction, over the unit of each contact, that an answer may have."""


@dataclass(frozen=True)
class Flat:
    """Outcome of the load path.

    found          forces and factor at the end of the path, or where the factor was greatest; and the mechanism
    with_dilation  the factor of friction that dilates by its friction angle, which none without exceeds; inf if any is
                   balanced
    steps          of the load
    converged      whether the factor came to rest, at the bound of the theorems for the cylinders there
    excess         largest shear force beyond friction and cohesion, over the unit of each contact: the mean load of a
                   block or, where they differ much, what the smaller block weighs or bears
    open           how far the factor is below that bound, over it
    end_factor     the factor at the end of the path, less than that found where a peak was passed
    """

    solution: Solution
    with_dilation: float
    steps: int
    converged: bool
    excess: float
    open: float
    end_factor: float


def without_dilation(
    bodies: RigidBodies,
    contacts: RigidContacts,
    method: Method = EXACTLY,
    between: Range = UPWARD,
    softer: float = SOFTER,
) -> Flat:
    """The factor at the end of the load path; no bound. softer: normal over shear stiffness of the joints."""
    bound = largest_factor(bodies, contacts, method, between)
    if bound.status == "infeasible":
        return Flat(bound, 0.0, 0, False, 0.0, 0.0, 0.0)
    path = _LoadPath(bodies, contacts, method, between, softer, bound.sizes or alike(bodies, contacts))
    best = now = path.at_rest()
    pace, steps = 1.0, 0
    with_dilation = bound.factor if bound.status == "solved" else inf
    reach = with_dilation - path.factor(now) if with_dilation < inf else 1.0 / path.unit
    while steps < MOST:
        after = path.step(now, pace, CLEARLY * FIRST * reach if reach > 0.0 and pace < SLOWEST else inf)
        rise = path.factor(after) - path.factor(now)
        if rise > FIRST * reach > 0.0 and pace < SLOWEST:
            pace *= 2.0
            continue
        now, steps, pace = after, steps + 1, pace * FASTER
        if path.factor(now) > path.factor(best) and path.excess(now) <= BEYOND:
            best = now
        if rise <= RISE * abs(path.factor(now)) and path.end(now, with_dilation, steps).converged:
            break
    last = path.end(now, with_dilation, steps)
    if path.factor(best) <= path.factor(now) + DROP * reach:
        return last
    peak = path.end(best, with_dilation, steps)
    return replace(peak, converged=last.converged, end_factor=last.end_factor) if peak.open >= -OPEN else last


def standing_without_dilation(bodies: RigidBodies, contacts: RigidContacts, method: Method = EXACTLY) -> Flat:
    """As `standing`, but without dilation: all dead loads are put on joints that do not slide, which then may."""
    as_live = replace(bodies, dead=np.zeros_like(bodies.dead), live=bodies.dead)
    bound = largest_factor(as_live, contacts, method, (0.0, 1.0))
    if bound.status != "solved" or bound.factor < STANDS:
        return Flat(bound, bound.factor, 0, False, 0.0, 0.0, 0.0)
    path = _LoadPath(as_live, contacts, method, (0.0, 1.0), SOFTER, bound.sizes or alike(as_live, contacts))
    now, pace = path.without_sliding(), 1.0
    for steps in range(1, MOST):
        before, now, pace = now, path.step(now, pace), max(pace * FASTER, NEAREST)
        end = path.end(now, 1.0, steps)
        if end.converged and end.solution.factor >= STANDS:
            break
        if pace == NEAREST and path.factor(now) - path.factor(before) <= RISE:
            break
    return end


def forces_without_sliding(bodies: RigidBodies, contacts: RigidContacts, method: Method = EXACTLY) -> np.ndarray:
    """(C,) N, the normal forces under the dead loads in joints of one stiffness that do not slide."""
    as_live = replace(bodies, dead=np.zeros_like(bodies.dead), live=bodies.dead)
    path = _LoadPath(as_live, contacts, method, (0.0, 1.0), SOFTER, alike(as_live, contacts))
    forces = path.without_sliding()
    still = np.zeros(len(path.forces.dead))
    return in_space(as_live, path.forces, contacts, path.flat, path.owner, "solved", forces, still, 0.0).normal


class _LoadPath:
    """The forces of one problem, as vectors of normal forces, shear forces and the factor, without units.

    unloaded: those before anything loads the joints, which bars have by their pretension. The change from there to the
    dead loads is shared out by stiffness, so that a bar loses what its ends give way.
    """

    def __init__(
        self, bodies: RigidBodies, contacts: RigidContacts, method: Method, between: Range, softer: float, sizes: Sizes
    ) -> None:
        self.bodies, self.contacts, self.method, self.between = bodies, contacts, method, between
        axis = plane_of(bodies, contacts) if method.plane else None
        self.flat, self.owner = contacts, np.arange(contacts.count)
        if axis is not None:
            self.flat, self.owner = flattened(contacts, axis)
        self.forces = forces = equilibrium(bodies, self.flat, sizes, axis)
        self.unit = 1.0 / forces.factor
        groups, k = forces.tangent.shape[:2]
        area = self.flat.area
        mean = area[~self.flat.is_link].mean() if not self.flat.is_link.all() else area.mean()
        along = softer * mean / np.bincount(forces.group, area, groups)
        weight = np.concatenate([mean / area, np.repeat(along, k)]) / (len(area) + groups * k)
        unit = np.concatenate([forces.force, np.repeat(forces.force[forces.leader], k)])
        self.solver = ConeSolver()
        self.weight = np.append(weight * (unit / alike(bodies, contacts).force[0]) ** 2, 0.0)
        self.unloaded = np.zeros(len(self.weight))
        if self.flat.pretension is not None:
            self.unloaded[: len(area)] = self.flat.pretension / forces.force

    def factor(self, forces: np.ndarray) -> float:
        return float(forces[-1] / self.unit)

    def at_rest(self) -> np.ndarray:
        """The forces under the dead loads alone; a drive holds still."""
        between = ANY if self.bodies.together is not None else (max(self.between[0], 0.0),) * 2
        return self.settled(self.unloaded, 1.0, 0.0, between, TRIES_AT_REST)

    def without_sliding(self) -> np.ndarray:
        """The forces at a factor of 1 where no joint slides, whatever presses it: nothing presses what is jammed."""
        loads = np.abs(self.bodies.dead[:, :3]).sum() + np.abs(self.bodies.live[:, :3]).sum()
        great = np.full(self.flat.count, GREAT * loads)
        stuck = replace(self.flat, friction=np.zeros_like(great), cohesion=np.where(self.flat.is_link, 0.0, great))
        near = NearForces(self.unloaded, self.weight, 0.0)
        return self.solve(stuck, (self.unit, self.unit), near)[1]

    def step(self, before: np.ndarray, pace: float, rise: float = inf) -> np.ndarray:
        """The forces when the load has moved on; pace: the less, the further. Where the factor would clearly rise by
        more than `rise`, what the first problem has."""
        return self.settled(before, pace, 1.0, self.between, TRIES, rise)

    def settled(
        self, before: np.ndarray, pace: float, push: float, between: Range, tries: int, rise: float = inf
    ) -> np.ndarray:
        """Forces whose friction goes with their own normal forces; those of the first problem where the factor rises
        by more than `rise` there."""
        near = NearForces(before, pace * self.weight, push)
        bounds = (between[0] * self.unit, between[1] * self.unit)
        begins = np.array_equal(before, self.unloaded)
        guess = self.solve(self.flat, bounds, near)[1] if begins else before
        last: tuple[np.ndarray, np.ndarray] | None = None
        for _ in range(tries):
            status, after = self.solve(self.cylinders(guess), bounds, near)
            if status != "solved":  # these cylinders are too narrow; the cones are not
                status, after = self.solve(self.flat, bounds, near)
            if status != "solved":
                return guess
            difference = (after - guess)[: self.flat.count]
            if np.abs(difference).max() <= SAME or (last is None and self.factor(after) - self.factor(before) > rise):
                break
            guess, last = _secant(after, difference, last), (after, difference)
        return after

    def solve(self, contacts: RigidContacts, bounds: Range, near: NearForces) -> tuple[str, np.ndarray]:
        """Status and forces of one problem."""
        return solve_cones(self.forces, contacts, bounds, near, self.method.tell, self.solver)[:2]

    def cylinders(self, forces: np.ndarray) -> RigidContacts:
        """Contacts whose shear strength is what friction makes of these normal forces, and stays so."""
        through = self.flat.cone_friction * forces[: self.flat.count] * self.forces.force
        strength = np.maximum(self.flat.cohesion + through, 0.0)
        return replace(self.flat, friction=np.zeros_like(strength), cohesion=strength)

    def end(self, forces: np.ndarray, with_dilation: float, steps: int) -> Flat:
        """Result of the load path, with the mechanism of the cylinders and the bound that it proves."""
        still = np.zeros(len(self.forces.dead))
        solution = in_space(
            self.bodies, self.forces, self.contacts, self.flat, self.owner, "solved", forces, still, 0.0
        )
        any_force = replace(self.flat, solid=np.ones_like(self.flat.solid))
        residual = unbalanced(self.bodies, self.forces, any_force, forces)
        strength = np.maximum(self.contacts.cohesion + self.contacts.cone_friction * solution.normal, 0.0)
        cylinders = replace(self.contacts, friction=np.zeros_like(strength), cohesion=strength)
        bound = largest_factor(self.bodies, cylinders, self.method, self.between)
        open_by = (bound.factor - solution.factor) / max(abs(bound.factor), 1e-9)
        excess = self.excess(forces)
        converged = bound.status == "solved" and abs(open_by) <= OPEN and excess <= BEYOND
        status = "solved" if converged or with_dilation < inf else "unbounded"
        solution = replace(
            solution,
            status=status,
            velocity=bound.velocity,
            gap=bound.gap,
            unbalance=float(residual.max()),
            worst=int(np.argmax(residual)),
        )
        return Flat(solution, with_dilation, steps, converged, excess, open_by, solution.factor)

    def excess(self, forces: np.ndarray) -> float:
        """Shear beyond what friction and cohesion allow."""
        count, (groups, k) = self.flat.count, self.forces.tangent.shape[:2]
        bears = self.flat.friction * forces[:count] + self.flat.cohesion / self.forces.force
        shear = np.linalg.norm(forces[count:-1].reshape(groups, k), axis=1)
        soft = np.bincount(self.forces.group, self.flat.solid, groups) == 0
        excess = (shear - np.bincount(self.forces.group, bears, groups))[soft]
        return float(max(excess.max(initial=0.0), 0.0))


def _secant(after: np.ndarray, difference: np.ndarray, last: tuple[np.ndarray, np.ndarray] | None) -> np.ndarray:
    """Where the next of a row of forces is tried: at the zero of what two of them were off by (Anderson 1965)."""
    if last is None:
        return after
    change = difference - last[1]
    fraction = float(difference @ change) / max(float(change @ change), 1e-300)
    return np.asarray(after - min(max(fraction, -1.0), 0.7) * (after - last[0]))
