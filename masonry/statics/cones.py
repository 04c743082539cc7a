"""The largest load factor with true friction cones, by a second-order cone programme (Clarabel)."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy import sparse

from masonry.statics.crushing import crushing_cones
from masonry.statics.equilibrium import Equilibrium
from masonry.statics.interior_point import ConeSolver, Programme, Tell, clarabel_package, true_gap
from masonry.statics.problem import RigidContacts

SOLVED = ("Solved", "AlmostSolved")
SLOW = ("InsufficientProgress", "NumericalError", "MaxIterations", "CallbackTerminated")
GOOD_ENOUGH = 1e-6
"""Gap and residuals with which the end of a row of steps that came to a halt still counts."""
SMOOTH = 0.01
"""Tangent of friction below which a cone alone does not keep a normal force from pulling, with the tolerance it has."""
INFEASIBLE = ("PrimalInfeasible", "AlmostPrimalInfeasible")
UNBOUNDED = ("DualInfeasible", "AlmostDualInfeasible")


class NearForces(NamedTuple):
    """Forces that the forces asked for should be near to: half of weight (x - before)^2 is taken off push times factor.

    before, weight  (U,) unknowns without units, the factor last     push  of the factor, 0 or 1
    """

    before: np.ndarray
    weight: np.ndarray
    push: float


def solve_cones(
    forces: Equilibrium, contacts: RigidContacts, between: tuple[float, float], near: NearForces | None = None,
    tell: Tell | None = None, solver: ConeSolver | None = None,
) -> tuple[str, np.ndarray, np.ndarray, float]:  # fmt: skip
    """As solve_linear, but with cones; the status may be "no end" as well. solver: that of a problem before, which
    serves again where only the strength of contacts differs.

    Raises SceneError where Clarabel is not installed.
    """
    clarabel = clarabel_package()
    scale = 1.0 + len(forces.dead) / 6.0
    forces = _of_the_whole(forces, scale)
    groups, k = forces.tangent.shape[:2]
    count, equations = contacts.count, len(forces.dead)
    unknowns = count + groups * k + 1
    parts = [sparse.hstack([forces.normal, forces.shear, sparse.csr_array(forces.live[:, None])], format="csc")]
    sides = [-forces.dead]
    kinds = [clarabel.ZeroConeT(equations)]
    bounds, limit = _bounds(forces, contacts, between, unknowns)
    if len(limit):
        parts.append(bounds)
        sides.append(limit)
        kinds.append(clarabel.NonnegativeConeT(len(limit)))
    cone, offset, number = _cones(forces, contacts, unknowns)
    parts.append(cone)
    sides.append(offset)
    kinds += [clarabel.SecondOrderConeT(k + 1)] * number
    if contacts.crush is not None:
        for rows, side, kind in crushing_cones(contacts.crush, forces.force, unknowns):
            parts.append(rows)
            sides.append(side)
            kinds += kind
    cost = np.zeros(unknowns)
    cost[-1] = -1.0
    square = sparse.csc_matrix((unknowns, unknowns))
    if near is not None:
        size = np.append(np.full(unknowns - 1, scale), 1.0)
        square = sparse.csc_matrix(sparse.diags(near.weight * size**2))
        cost = near.push * cost - near.weight * size * near.before
    matrix = sparse.csc_matrix(sparse.vstack(parts, format="csc"))
    programme = Programme(square, cost, matrix, np.concatenate(sides), kinds)
    solution = (solver or ConeSolver()).solved(programme, tell)
    status = str(solution.status)
    gap = abs(solution.obj_val - solution.obj_val_dual) / max(1.0, abs(solution.obj_val))
    if status in SOLVED or (status in SLOW and max(gap, solution.r_prim, solution.r_dual) < GOOD_ENOUGH):
        unknown = np.array(solution.x)
        unknown[:-1] *= scale
        return "solved", unknown, np.array(solution.z[:equations]) / scale, true_gap(programme, solution)
    if status in INFEASIBLE or status in UNBOUNDED:
        word = "infeasible" if status in INFEASIBLE else "unbounded"
        return word, np.zeros(unknowns), np.zeros(equations), 0.0
    return "no end", np.zeros(unknowns), np.zeros(equations), 0.0


def _of_the_whole(forces: Equilibrium, scale: float) -> Equilibrium:
    """The same with forces over about that of all blocks: what is left of the dual's equations then counts little."""
    return replace(
        forces, dead=forces.dead / scale, live=forces.live / scale, force=forces.force * scale
    )  # fmt: skip


def _bounds(
    forces: Equilibrium, contacts: RigidContacts, between: tuple[float, float], unknowns: int
) -> tuple[sparse.csc_array, np.ndarray]:
    """Rows and sides of: normal forces above -tension where the cone does not say so, the bounds of the factor, and
    normal forces of bars below what they bear."""
    friction = contacts.cone_friction
    apex = np.where(friction > 0, contacts.cohesion, np.inf) / np.maximum(friction, 1e-300)
    alone = forces.tangent.shape[1] == 2
    bounded = ~contacts.solid & np.isfinite(contacts.tension)
    which = np.flatnonzero(bounded & ((apex > contacts.tension) | (friction < SMOOTH) | (not alone)))
    minimum, maximum = between
    ends = [(sign, bound) for sign, bound in ((-1.0, -minimum), (1.0, maximum)) if np.isfinite(bound)]
    limited = np.zeros(0, dtype=np.int64) if contacts.limit is None else np.flatnonzero(np.isfinite(contacts.limit))
    column = np.concatenate([which, np.full(len(ends), unknowns - 1), limited])
    sign = np.concatenate([np.full(len(which), -1.0), [end[0] for end in ends], np.ones(len(limited))])
    side = np.concatenate([contacts.tension[which] / forces.force[which], [end[1] for end in ends]])
    if contacts.limit is not None:
        side = np.concatenate([side, contacts.limit[limited] / forces.force[limited]])
    return sparse.csc_array((sign, (np.arange(len(column)), column)), shape=(len(column), unknowns)), side


def _cones(forces: Equilibrium, contacts: RigidContacts, unknowns: int) -> tuple[sparse.csc_array, np.ndarray, int]:
    """Rows, sides and number of: (friction N + cohesion, shear) in a second-order cone, for each group."""
    groups, k = forces.tangent.shape[:2]
    count = contacts.count
    hard = np.ones(groups, dtype=bool)
    hard[forces.group[contacts.solid]] = False
    place = np.cumsum(hard) - 1
    mine = np.flatnonzero(hard[forces.group])
    chosen = np.flatnonzero(hard)
    head = (k + 1) * place[forces.group[mine]]
    tail = ((k + 1) * place[chosen][:, None] + 1 + np.arange(k)).ravel()
    shear = (count + k * chosen[:, None] + np.arange(k)).ravel()
    value = np.concatenate([-contacts.cone_friction[mine], np.full(len(tail), -1.0)])
    row, column = np.concatenate([head, tail]), np.concatenate([mine, shear])
    number = len(chosen)
    offset = np.zeros((k + 1) * number)
    offset[:: k + 1] = np.bincount(forces.group, contacts.cohesion / forces.force, groups)[chosen]
    return sparse.csc_array((value, (row, column)), shape=((k + 1) * number, unknowns)), offset, number
