"""One limit analysis of bodies and contacts: in a plane where there is one, by planes or by cones.

A solution is looked at block by block: each must be balanced to a share of its own loads. Where one is not, or where
there is no solution, all is solved again in the units of each block, with what is known by then of the forces in it.
"""

from dataclasses import dataclass, field, replace

import numpy as np

from masonry.errors import SceneError
from masonry.statics.balance import unbalanced
from masonry.statics.cones import solve_cones
from masonry.statics.equilibrium import Equilibrium, equilibrium
from masonry.statics.interior_point import Tell
from masonry.statics.linear_programming import solve_linear
from masonry.statics.plane import flattened, plane_of
from masonry.statics.problem import RigidBodies, RigidContacts, Sizes, Solution
from masonry.statics.sizes import alike, of_each

MUCH = 2000
"""Contact points beyond which plane problems are solved as cones as well."""
STANDS = 1.0 - 1e-6
"""Share of the dead loads that must be balanced for a specimen to stand."""
CLOSED, TRIES, UNLIKE = 1e-6, 4, 2.0
"""What may be left on a block over its own loads, and the gap, beyond which all is solved again; how often in all; how
many times as large the units of one block must be as those of another one for that to be of use."""


@dataclass(frozen=True)
class Method:
    """How a problem is solved.

    plane    whether a plane problem is solved in its plane
    sides    of the pyramids that stand for friction cones in space, 0 for cones
    tell     is told how far a solve is; None: nobody is
    """

    plane: bool = True
    sides: int = 0
    tell: Tell | None = field(default=None, compare=False)


Range = tuple[float, float]
UPWARD, ANY = (0.0, np.inf), (-np.inf, np.inf)
"""Ranges of a factor."""
EXACTLY = Method()
"""True cones in space, a linear programme in a plane."""


def largest_factor(
    bodies: RigidBodies, contacts: RigidContacts, method: Method = EXACTLY, between: Range = UPWARD
) -> Solution:
    """The largest factor within a range at which forces that the contacts bear balance all bodies."""
    axis = plane_of(bodies, contacts) if method.plane else None
    sides = _sides(axis, contacts, method)
    flat, owner = (contacts, np.arange(contacts.count)) if axis is None else flattened(contacts, axis)
    best, sizes = None, alike(bodies, flat)
    for tries in range(TRIES):
        forces = equilibrium(bodies, flat, sizes, axis)
        bounds = (between[0] / forces.factor, between[1] / forces.factor)
        if sides:
            answer = solve_linear(forces, flat, sides, bounds, method.tell)
        else:
            answer = solve_cones(forces, flat, bounds, tell=method.tell)
        solution = replace(in_space(bodies, forces, contacts, flat, owner, *answer), sizes=sizes)
        best = solution if best is None or _is_better(solution, best) else best
        if solution.status == "solved" and max(solution.unbalance, solution.gap) <= CLOSED:
            break
        sizes = of_each(bodies, contacts, solution.factor, solution.normal, solution.shear)
        if not _unlike(bodies, sizes) or (tries and solution.status != "solved"):
            break
    assert best is not None
    if best.status == "no end":
        raise SceneError("the cone programme came to no end; try --linear 16, which needs no cones")
    return best


def _is_better(solution: Solution, best: Solution) -> bool:
    """Any ending is better than none, an answer than a later ending without one, and the later of two that are none."""
    if "solved" not in (solution.status, best.status):
        return solution.status != "no end"
    return solution.status == "solved" and (best.status != "solved" or solution.unbalance < best.unbalance)


def _unlike(bodies: RigidBodies, sizes: Sizes) -> bool:
    """Whether blocks that move differ much in their units."""
    moves = bodies.free.any(axis=1)
    return any(float(unit[moves].max()) > UNLIKE * float(unit[moves].min()) for unit in (sizes.force, sizes.length))


def _sides(axis: int | None, contacts: RigidContacts, method: Method) -> int:
    """Of the pyramids of a linear programme, 0 for cones, which are as good in a plane, and quicker for much."""
    if contacts.crush is not None:
        return 0
    if axis is None:
        return method.sides
    return 0 if contacts.count > MUCH else 2


def standing(bodies: RigidBodies, contacts: RigidContacts, method: Method = EXACTLY) -> Solution:
    """The share of the dead loads that can be balanced, 1 at most, and the mechanism where it is less."""
    return largest_factor(
        replace(bodies, dead=np.zeros_like(bodies.dead), live=bodies.dead), contacts, method, (0.0, 1.0)
    )


def method_word(bodies: RigidBodies, contacts: RigidContacts, method: Method, cones: bool = False) -> str:
    """How a problem is solved, in words; cones: by cones in any case."""
    axis = plane_of(bodies, contacts) if method.plane else None
    sides = 0 if cones else _sides(axis, contacts, method)
    how = "linear programme (HiGHS)" if sides else "cone programme (Clarabel)"
    if axis is not None:
        return f"{how} in the plane across {'xyz'[axis]}"
    return f"{how}, friction pyramids of {sides} sides" if sides else how


def in_space(
    bodies: RigidBodies,
    forces: Equilibrium,
    contacts: RigidContacts,
    flat: RigidContacts,
    owner: np.ndarray,
    status: str,
    unknown: np.ndarray,
    velocity: np.ndarray,
    gap: float,
) -> Solution:
    """Unknowns and velocities of a problem, back in units, for all blocks and contact points."""
    groups, k = forces.tangent.shape[:2]
    pressing, sliding = unknown[: flat.count], unknown[flat.count : -1]
    fraction = forces.force[owner] * contacts.area / flat.area[owner]
    shear = np.einsum("gk,gki->gi", sliding.reshape(groups, k), forces.tangent)
    part = _part_of_group(forces, flat, pressing)
    residual = unbalanced(bodies, forces, flat, unknown) if status == "solved" else np.zeros(1)
    return Solution(
        status, float(unknown[-1] * forces.factor),
        fraction * pressing[owner],
        (fraction * part[owner])[:, None] * shear[forces.group[owner]],
        forces.factor * (forces.rows.T @ velocity).reshape(-1, 6), gap, float(residual.max()), int(np.argmax(residual)),
    )  # fmt: skip


def _part_of_group(forces: Equilibrium, flat: RigidContacts, pressing: np.ndarray) -> np.ndarray:
    """(C,) share of the shear force of its group that a point takes: by what it can bear."""
    minimum = 1e-12 * flat.area / flat.area.max(initial=1e-300)
    bears = np.maximum(flat.friction * pressing + flat.cohesion / forces.force, 0.0) + minimum
    return bears / np.bincount(forces.group, bears)[forces.group]
