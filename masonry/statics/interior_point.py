"""Clarabel, the interior point method for cones: settings by size, a solve that ends on Ctrl-C, and its true gap."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from scipy import sparse

from masonry.errors import SceneError
from masonry.runtime.interrupts import interrupt_afterwards

ACCURACY = 1e-10
NEAR_ENOUGH, PROVEN = 1e-8, 1e-7
"""Residual of the forces, and gap, with which a solve ends although that residual is not down to ACCURACY yet."""
SMALL = 1e-3
"""A factor, in its unit, below which a gap is over this."""
MUCH = 40_000
"""Cones from which the factorisation by dense blocks (faer) is quicker than that entry by entry (qdldl)."""

Tell = Callable[[int, str], None]
"""Is told the iterations that are done, and how far they came, in words."""


class Programme(NamedTuple):
    """The least of x square x / 2 + cost x where sides - matrix x lies in the cones."""

    square: sparse.csc_matrix
    cost: np.ndarray
    matrix: sparse.csc_matrix
    sides: np.ndarray
    kinds: list[Any]


class ConeSolver:
    """Clarabel for one programme after another. Where only the sides differ from those of the programme before, its
    ordering and its scaling serve again: the numbers are the same."""

    def __init__(self) -> None:
        self._programme: Programme | None = None
        self._clarabel: Any = None

    def solved(self, programme: Programme, tell: Tell | None) -> Any:
        """Solution by Clarabel. Raises KeyboardInterrupt within an iteration of Ctrl-C, SceneError without Clarabel.

        On one thread: more of them take longer as soon as anything else works on the machine.
        """
        with interrupt_afterwards() as pressed:
            if self._programme is not None and _differ_by_sides(self._programme, programme):
                self._clarabel.update(b=programme.sides)
            else:
                self._clarabel = _new_solver(programme)
            self._programme = programme if self._clarabel.is_data_update_allowed() else None

            def look(now: Any) -> bool:
                if tell is not None and now.iterations:
                    tell(
                        now.iterations,
                        f"gap {now.gap_rel:.0e}, forces off by {now.res_primal:.0e}",
                    )
                return bool(pressed) or _proven(now, len(programme.kinds))

            self._clarabel.set_termination_callback(look)
            return self._clarabel.solve()


def _new_solver(programme: Programme) -> Any:
    clarabel = clarabel_package()
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_threads = 1
    settings.direct_solve_method = "qdldl" if len(programme.kinds) < MUCH else "faer"
    settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = ACCURACY
    return clarabel.DefaultSolver(*programme, settings)


def _differ_by_sides(first: Programme, second: Programme) -> bool:
    """Whether two programmes differ in their sides alone, if at all."""
    if not np.array_equal(first.cost, second.cost) or [str(kind) for kind in first.kinds] != [
        str(k) for k in second.kinds
    ]:
        return False
    pairs = ((first.square, second.square), (first.matrix, second.matrix))
    return all(
        a.shape == b.shape
        and np.array_equal(a.indptr, b.indptr)
        and np.array_equal(a.indices, b.indices)
        and np.array_equal(a.data, b.data)
        for a, b in pairs
    )


def _proven(now: Any, cones: int) -> bool:
    """Whether an iterate of many cones is as good as the answer: their last digits of forces cost many iterations."""
    complementary = now.mu * (cones + 1) / max(SMALL, abs(now.cost_primal))
    done = max(now.gap_rel, now.res_dual) < ACCURACY and now.res_primal < NEAR_ENOUGH and complementary < PROVEN
    return bool(now.iterations > 0 and done)


def true_gap(programme: Programme, solution: Any) -> float:
    """Between the two objectives, over the objective, with what the residuals of both may have added to them."""
    x, z = np.array(solution.x), np.array(solution.z)
    forces = programme.matrix @ x + np.array(solution.s) - programme.sides
    velocities = programme.square @ x + programme.matrix.T @ z + programme.cost
    apart = abs(solution.obj_val - solution.obj_val_dual) + abs(z @ forces) + abs(x @ velocities)
    return float(apart / max(SMALL, abs(solution.obj_val)))


def clarabel_package() -> Any:
    """The package. Raises SceneError where it is not installed."""
    try:
        import clarabel
    except ModuleNotFoundError:
        raise SceneError(
            "friction cones need the package clarabel: pip install clarabel; or take pyramids: --linear 16"
        ) from None
    return clarabel
