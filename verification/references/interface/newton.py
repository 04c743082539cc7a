"""Equilibrium step by step: Newton's method under control of displacement, or of any measure that only grows."""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import lu_factor, lu_solve
from scipy.sparse import csr_matrix
from threadpoolctl import ThreadpoolController

from verification.references.interface.condensed import condense
from verification.references.interface.model import InterfaceModel
from verification.references.interface.points import PointHistory, tangent, traction, unharmed

Array = np.ndarray
ROUNDS, HALVINGS = 40, 9
NEARLY_GONE = 0.02
"""Share of the tensile strength below which a point no longer counts as softening."""
TOLERANCE, ENOUGH = 1e-12, 1e-9
"""Of the largest force so far: residual that is aimed at, and that is taken where rounding lets it fall no further."""


class NotConverged(Exception):
    """No equilibrium was found, however small the step."""


@dataclass(frozen=True)
class State:
    """An equilibrium: boundary dofs q, lambda, share of the dead load, and the history of each joint."""

    q: Array
    factor: float
    dead: float
    histories: tuple[PointHistory, ...]


class EquilibriumPath:
    """Follows the equilibria of a model from rest; all that a step needs is condensed once.

    control  weights (N,) of the dofs whose sum is prescribed instead of lambda, or None: lambda itself
    """

    def __init__(self, model: InterfaceModel, control: Array | None = None) -> None:
        self.model, self.system = model, condense(model)
        n = len(self.system.boundary)
        self.state = State(np.zeros(n), 0.0, 0.0, tuple(unharmed(j.law, len(j.weight)) for j in model.joints))
        self.earlier: tuple[float, State] | None = None
        self.reached = 0.0
        self.row = None if control is None else self.system.row(control)
        self.blas = ThreadpoolController()
        self.largest = 0.0
        self.rounds = 0
        counts = np.cumsum([0, *(3 * len(j.weight) for j in model.joints)])
        self.parts = [slice(a, b) for a, b in zip(counts[:-1], counts[1:], strict=True)]

    def go(self, target: float, dead: float | None = None) -> State:
        """The equilibrium where the control (lambda, or the sum) is `target`; in halves where one step is too long."""
        dead = self.state.dead if dead is None else dead
        with self.blas.limit(limits=1, user_api="blas"):  # small systems: threads would only wait for each other
            self._go(target, dead, HALVINGS)
        return self.state

    def open_by(self, amount: float) -> State:
        """The equilibrium where the points that soften now have opened by `amount` (m) more in the mean.

        Where none softens yet, those nearest to it count. This passes snap-backs that go with single elements; a load
        or displacement other than zero must be there already. What is controlled here stays the control of `go`.
        """
        weights, area = np.zeros(len(self.model.held)), 0.0
        u = self.system.model.driven * self.state.factor
        u[self.system.boundary] = self.state.q
        openings = [np.einsum("ni,ni->n", (j.jump @ u).reshape(-1, 3), j.normal) for j in self.model.joints]
        used = [e / j.law.opening_at_peak for e, j in zip(openings, self.model.joints, strict=True)]
        maximum = min(1.0, max(float(e.max(initial=0.0)) for e in used))
        for joint, e, history in zip(self.model.joints, used, self.state.histories, strict=True):
            softening_area = joint.weight * ((e >= 0.9 * maximum) & (history.tension > NEARLY_GONE))
            weights += joint.jump.T @ (softening_area[:, None] * joint.normal).ravel()
            area += softening_area.sum()
        self.row = self.system.row(weights / max(area, 1e-300))
        self.reached = float(
            self.row[0] @ self.state.q + self.row[1] * self.state.factor + self.row[2] * self.state.dead
        )
        if self.earlier is not None:
            self.earlier = self.reached - amount, self.earlier[1]
        return self.go(self.reached + amount)

    def _go(self, target: float, dead: float, halvings: int) -> None:
        start, begun, load_factor = self.state, self.reached, self.state.dead
        try:
            solution = self._solve(target, dead)
        except NotConverged:
            if halvings == 0:
                raise
            middle = 0.5 * (begun + target), 0.5 * (load_factor + dead)
            self._go(*middle, halvings - 1)
            self._go(target, dead, halvings - 1)
            return
        self.earlier, self.state, self.reached = (begun, start), solution, target

    def _guess(self, target: float) -> tuple[Array, float]:
        """Straight on from the last two equilibria."""
        now = self.state
        if self.earlier is None or self.reached == self.earlier[0]:
            return now.q.copy(), target if self.row is None else now.factor
        ahead = (target - self.reached) / (self.reached - self.earlier[0])
        ahead = min(ahead, 2.0) if ahead > 0.0 else 0.0
        before = self.earlier[1]
        return now.q + ahead * (now.q - before.q), now.factor + ahead * (now.factor - before.factor)

    def _solve(self, target: float, dead: float) -> State:
        for q, factor in (self._guess(target), (self.state.q.copy(), self.state.factor)):
            solution = self._iterate(q, target if self.row is None else factor, target, dead)
            if solution is not None:
                return solution
        raise NotConverged(f"no equilibrium at {target:g}")

    def _iterate(self, q: Array, factor: float, target: float, dead: float) -> State | None:
        s, best, last = self.system, np.inf, None
        n = len(q)
        for _ in range(ROUNDS):
            self.rounds += 1
            force, by_jump, histories = self._joints(q, factor)
            residual = s.stiffness @ q + s.jump.T @ force - dead * s.dead - factor * s.push
            gap = 0.0
            if self.row is not None:
                gap = self.row[0] @ q + self.row[1] * factor + self.row[2] * dead - target
            scale = max(self.largest, np.abs(force).max(initial=0.0), 1e-300)
            error = max(np.abs(residual).max(initial=0.0) / scale, abs(gap) / max(abs(target), 1e-300))
            if not np.isfinite(error):
                return None
            if error < TOLERANCE or (best < ENOUGH and error > 0.3 * best):
                if error > best and last is not None:
                    q, factor, histories = last
                self.largest = scale
                return State(q, factor, dead, histories)
            if error < best:
                best, last = error, (q, factor, histories)
            inside = s.jump.T @ by_jump
            matrix = np.zeros((n + 1, n + 1))
            matrix[:n, :n] = s.stiffness + (inside @ s.jump).toarray()
            matrix[:n, n] = inside @ s.jump_driven - s.push
            matrix[n, n] = 1.0
            if self.row is not None:
                matrix[n, :n], matrix[n, n] = self.row[0], self.row[1]
            change = self._scaled_solve(matrix, np.append(residual, gap))
            q, factor = q - change[:n], factor - change[n]
        return None

    @staticmethod
    def _scaled_solve(matrix: Array, right: Array) -> Array:
        """Rows and columns in their own units: forces and displacements, the last row and column those of control."""
        n = len(right) - 1
        row, column = np.ones(n + 1), np.ones(n + 1)
        row[n] = np.abs(matrix[:n, :n]).max(initial=1.0) / max(np.abs(matrix[n]).max(), 1e-300)
        column[n] = np.abs(matrix[:n, :n]).max(initial=1.0) / max(np.abs(matrix[:n, n]).max(initial=0.0), 1e-300)
        factors = lu_factor(row[:, None] * matrix * column, overwrite_a=True, check_finite=False)
        return column * lu_solve(factors, row * right, check_finite=False)

    def _joints(self, q: Array, factor: float) -> tuple[Array, csr_matrix, tuple[PointHistory, ...]]:
        """Force (3 m,) N at the points, its derivative by the jumps (block diagonal), and the histories after it."""
        jump = self.system.jump @ q + factor * self.system.jump_driven
        force, blocks, histories = np.zeros_like(jump), [], []
        for joint, part, history in zip(self.model.joints, self.parts, self.state.histories, strict=True):
            d = jump[part].reshape(-1, 3)
            t, after = traction(joint.law, history, joint.normal, d)
            force[part] = (joint.weight[:, None] * t).ravel()
            blocks.append(joint.weight[:, None, None] * tangent(joint.law, history, joint.normal, d))
            histories.append(after)
        return force, _block_diagonal(np.concatenate(blocks)), tuple(histories)

    def displacements(self) -> Array:
        """(N,) m, of all dofs now."""
        return self.system.all_dofs(self.state.q, self.state.factor, self.state.dead)

    def reactions(self) -> Array:
        """(N,) N: what holds the prescribed dofs; zero, up to the residual, where they are free."""
        m, state = self.model, self.state
        force = self._joints(state.q, state.factor)[0]
        jumps = m.stiffness @ self.displacements() - state.dead * m.dead - state.factor * m.load
        for joint, part in zip(m.joints, self.parts, strict=True):
            jumps += joint.jump.T @ force[part]
        return jumps

    def drive_force(self) -> float:
        """N, of the driven dofs: work-conjugate to lambda where nothing else is loaded by it."""
        return float(self.reactions() @ self.model.driven)


def _block_diagonal(blocks: Array) -> csr_matrix:
    """(3 m, 3 m) of blocks (m, 3, 3)."""
    m = len(blocks)
    columns = np.broadcast_to(3 * np.arange(m)[:, None, None] + np.arange(3), (m, 3, 3))
    return csr_matrix((blocks.ravel(), columns.ravel(), np.arange(0, 9 * m + 1, 3)), shape=(3 * m, 3 * m))
