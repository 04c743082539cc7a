"""The largest load factor by linear programming (HiGHS): plane problems, and friction cones made of planes.

Livesley, R. K.: Limit analysis of structures formed from rigid blocks. Int. J. Numer. Methods Eng. 12 (1978).
"""

from typing import Any

import numpy as np
from scipy import sparse
from scipy.optimize import linprog

from masonry.runtime.interrupts import interruptible_wait
from masonry.statics.equilibrium import Equilibrium
from masonry.statics.interior_point import SMALL, Tell
from masonry.statics.problem import RigidContacts

EXACT = {"primal_feasibility_tolerance": 1e-9, "dual_feasibility_tolerance": 1e-9}
MUCH = 300
"""Shear forces beyond which the interior point method is taken."""
STATUS = {0: "solved", 2: "infeasible", 3: "unbounded"}


def solve_linear(
    forces: Equilibrium, contacts: RigidContacts, sides: int, between: tuple[float, float], tell: Tell | None = None
) -> tuple[str, np.ndarray, np.ndarray, float]:
    """Status, unknowns (normal forces, shear forces, factor), velocities (R,) and gap; all without units.

    sides  of the pyramid in each friction cone; 2 in a plane     between  bounds of the factor
    """
    groups, k = forces.tangent.shape[:2]
    count = contacts.count
    matrix = sparse.hstack([forces.normal, forces.shear, sparse.csr_array(forces.live[:, None])], format="csr")
    upper, bound = pyramids(forces, contacts, sides)
    low = np.full(count + groups * k + 1, -np.inf)
    high = np.full(len(low), np.inf)
    low[:count] = np.where(contacts.solid, -np.inf, -contacts.tension / forces.force)
    if contacts.limit is not None:
        high[:count] = contacts.limit / forces.force
    low[-1], high[-1] = between
    cost = np.zeros(len(low))
    cost[-1] = -1.0
    bounds = np.column_stack([low, high])

    def optimise() -> Any:
        return linprog(cost, upper, bound, matrix, -forces.dead, bounds, method=_method(forces), options=EXACT)

    def every(seconds: float) -> None:
        if tell is not None:
            tell(0, f"linear programme (HiGHS), which does not say how far it is: {seconds:.0f} s")

    optimum = optimise() if _is_little(forces) else interruptible_wait(optimise, every)
    status = _status(optimum, cost, upper, bound, matrix, -forces.dead, bounds)
    if status != "solved":
        return status, np.zeros(len(low)), np.zeros(len(forces.dead)), 0.0
    dual = bound @ optimum.ineqlin.marginals - forces.dead @ optimum.eqlin.marginals
    for side, values in ((optimum.lower, low), (optimum.upper, high)):
        finite = np.isfinite(values)
        dual += values[finite] @ side.marginals[finite]
    residual = matrix @ optimum.x + forces.dead
    apart = abs(optimum.fun - dual) + np.abs(residual) @ np.abs(optimum.eqlin.marginals)
    return status, optimum.x, -optimum.eqlin.marginals, float(apart / max(SMALL, abs(optimum.fun)))


def _method(forces: Equilibrium) -> str:
    """The simplex method is the quickest for little, and by far the slowest for much."""
    return "highs-ds" if _is_little(forces) else "highs-ipm"


def _is_little(forces: Equilibrium) -> bool:
    return len(forces.leader) * forces.tangent.shape[1] <= MUCH


def _status(
    optimum: Any, cost: np.ndarray, upper: Any, bound: np.ndarray, matrix: Any, dead: np.ndarray, bounds: np.ndarray
) -> str:
    """The word for an ending; one that presolving could not tell (infeasible or unbounded) is told without a load."""
    if optimum.status in STATUS:
        return STATUS[optimum.status]
    still = linprog(0.0 * cost, upper, bound, matrix, dead, bounds, method="highs-ipm", options=EXACT)
    return "unbounded" if still.status == 0 else "infeasible"


def pyramids(forces: Equilibrium, contacts: RigidContacts, sides: int) -> tuple[sparse.csr_array, np.ndarray]:
    """Rows and right-hand sides of: shear along each side <= (friction N + cohesion) times how far the side is off.

    A pyramid stands within its cone, its edges on it: the factor is too small at most.
    """
    groups, k = forces.tangent.shape[:2]
    hard = np.ones(groups, dtype=bool)
    hard[forces.group[contacts.solid]] = False
    angle = 2 * np.pi * np.arange(sides) / sides
    directions = np.column_stack([np.cos(angle), np.sin(angle)])[:, :k]
    inside = np.cos(np.pi / sides) if k == 2 else 1.0
    friction = sparse.csr_array(
        (-inside * contacts.cone_friction, (forces.group, np.arange(contacts.count))), shape=(groups, contacts.count)
    )
    cohesion = inside * np.bincount(forces.group, contacts.cohesion / forces.force, groups)
    rigid = np.flatnonzero(np.repeat(hard, sides))
    shear = sparse.kron(sparse.eye_array(groups), directions, format="csr")
    normal = sparse.kron(friction, np.ones((sides, 1)), format="csr")
    rows = sparse.hstack([normal, shear, sparse.csr_array((groups * sides, 1))], format="csr")
    return rows[rigid], np.repeat(cohesion, sides)[rigid]
