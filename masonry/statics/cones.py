"""The largest load factor with true friction cones, by a second-order cone programme (Clarabel)."""

import numpy as np
from scipy import sparse

from masonry.errors import SceneError
from masonry.statics.equilibrium import Equilibrium
from masonry.statics.problem import Contacts

ACCURACY = 1e-9
SOLVED, ALMOST = ("Solved",), ("AlmostSolved",)
INFEASIBLE = ("PrimalInfeasible", "AlmostPrimalInfeasible")
UNBOUNDED = ("DualInfeasible", "AlmostDualInfeasible")


def solve_cones(forces: Equilibrium, contacts: Contacts, most: float) -> tuple[str, np.ndarray, np.ndarray, float]:
    """As solve_linear, but with cones; Raises SceneError where Clarabel is not installed or comes to no end."""
    clarabel = _clarabel()
    groups, k = forces.tangent.shape[:2]
    count, equations = contacts.count, len(forces.dead)
    unknowns = count + groups * k + 1
    parts = [sparse.hstack([forces.normal, forces.shear, sparse.csr_array(forces.live[:, None])], format="csc")]
    sides = [-forces.dead]
    kinds = [clarabel.ZeroConeT(equations)]
    bounds, limit = _bounds(forces, contacts, most, unknowns)
    if len(limit):
        parts.append(bounds)
        sides.append(limit)
        kinds.append(clarabel.NonnegativeConeT(len(limit)))
    cone, offset, number = _cones(forces, contacts, unknowns)
    parts.append(cone)
    sides.append(offset)
    kinds += [clarabel.SecondOrderConeT(k + 1)] * number
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = ACCURACY
    cost = np.zeros(unknowns)
    cost[-1] = -1.0
    matrix = sparse.csc_matrix(sparse.vstack(parts, format="csc"))
    nothing = sparse.csc_matrix((unknowns, unknowns))
    found = clarabel.DefaultSolver(nothing, cost, matrix, np.concatenate(sides), kinds, settings).solve()
    status = str(found.status)
    if status in (*SOLVED, *ALMOST):
        gap = abs(found.obj_val - found.obj_val_dual) / max(1.0, abs(found.obj_val))
        return "solved", np.array(found.x), np.array(found.z[:equations]), float(gap)
    if status in INFEASIBLE or status in UNBOUNDED:
        word = "infeasible" if status in INFEASIBLE else "unbounded"
        return word, np.zeros(unknowns), np.zeros(equations), 0.0
    raise SceneError(f"the cone programme came to no end ({status}); try --linear 16, which needs no cones")


def _bounds(forces: Equilibrium, contacts: Contacts, most: float, unknowns: int) -> tuple[sparse.csc_array, np.ndarray]:
    """Rows and sides of: normal forces above -tension where the cone does not say so, and 0 <= factor <= most."""
    apex = np.where(contacts.friction > 0, contacts.cohesion, np.inf) / np.maximum(contacts.friction, 1e-300)
    alone = forces.tangent.shape[1] == 2
    needed = ~contacts.solid & ((apex > contacts.tension) | (not alone))
    which = np.flatnonzero(needed)
    column = np.concatenate([which, [unknowns - 1]])
    side = np.concatenate([contacts.tension[which] / forces.force, [0.0]])
    sign = np.full(len(column), -1.0)
    if np.isfinite(most):
        column, sign = np.append(column, unknowns - 1), np.append(sign, 1.0)
        side = np.append(side, most)
    return sparse.csc_array((sign, (np.arange(len(column)), column)), shape=(len(column), unknowns)), side


def _cones(forces: Equilibrium, contacts: Contacts, unknowns: int) -> tuple[sparse.csc_array, np.ndarray, int]:
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
    value = np.concatenate([-contacts.friction[mine], np.full(len(tail), -1.0)])
    row, column = np.concatenate([head, tail]), np.concatenate([mine, shear])
    number = len(chosen)
    offset = np.zeros((k + 1) * number)
    offset[:: k + 1] = np.bincount(forces.group, contacts.cohesion, groups)[chosen] / forces.force
    return sparse.csc_array((value, (row, column)), shape=((k + 1) * number, unknowns)), offset, number


def _clarabel():
    try:
        import clarabel
    except ModuleNotFoundError:
        raise SceneError(
            "friction cones need the package clarabel: pip install clarabel; or take pyramids: --linear 16"
        ) from None
    return clarabel
