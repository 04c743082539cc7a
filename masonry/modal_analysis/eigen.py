"""The slowest modes of an oscillator with the energy |B u|^2 / 2 and a mass for each dof."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.sparse as sparse

DENSE = 240
"""Dofs up to which all modes are computed at once."""
SHIFT = 1e-11
"""Of the stiffest dof's square frequency, by which all are raised, so that what is loose can be solved for."""
LOOSE = 1e-16
"""Of the same: square frequencies below it are those of parts that nothing holds."""
BESIDE = 3
"""Modes that are looked for besides, each time: they show one that is missed among equal frequencies."""
SEED = 2718


@dataclass(frozen=True)
class Modes:
    """The slowest first: square frequencies (m,) (rad/s)2, shapes (m, n) with a modal mass of 1; and those (l, n) that
    nothing resists, `all_loose` False where there are more of them than were asked for."""

    square: np.ndarray
    shape: np.ndarray
    loose: np.ndarray
    all_loose: bool = True


def slowest(
    strain_matrix: sparse.csr_array, mass: np.ndarray, free: np.ndarray, count: int, most_loose: int = 60
) -> Modes:
    """The `count` slowest modes that something resists, and up to `most_loose` that nothing does.

    strain_matrix  (R, n) the matrix B, root of N/m     mass, free  (n,) kg, kg m2; dofs that may move
    """
    dofs = np.flatnonzero(free)
    root = np.sqrt(mass[dofs])
    scaled = sparse.csc_array(strain_matrix[:, dofs] @ sparse.diags_array(1.0 / root))
    matrix = sparse.csc_array(scaled.T @ scaled)
    top = float(matrix.diagonal().max(initial=0.0))
    wanted = count
    while True:
        vectors = _vectors(matrix, min(wanted, len(dofs)), SHIFT * top if top > 0.0 else 1.0)
        square = (np.asarray(scaled @ vectors) ** 2).sum(axis=0)
        order = np.argsort(square, kind="stable")
        square, vectors = square[order], vectors[:, order]
        loose = int((square <= LOOSE * top).sum())
        enough = len(square) >= len(dofs) or len(square) - loose >= count
        if enough or loose > most_loose:
            break
        wanted = loose + count if loose < len(square) else 2 * wanted + 6
    shape = np.zeros((len(square), len(mass)))
    shape[:, dofs] = (vectors / root[:, None]).T
    held = slice(loose, loose + count)
    return Modes(square[held], shape[held], shape[:loose], enough)


def _vectors(matrix: sparse.csc_array, count: int, shift: float) -> np.ndarray:
    """(n, m) orthonormal vectors of the `count` smallest eigenvalues, none left out."""
    size = matrix.shape[0]
    if size <= max(DENSE, 2 * (count + BESIDE)):
        return np.asarray(np.linalg.eigh(matrix.toarray())[1][:, :count])
    solve = factorised(matrix, shift)
    start, none = np.random.default_rng(SEED).standard_normal(size), np.zeros((size, 0))
    vectors = _largest(solve, none, count, start)
    while True:  # eigenvalues that are equal, or nearly, may be missed as long as one is left
        more = _largest(solve, vectors, BESIDE, start[::-1].copy())
        least = min(_inverse(solve, vector) for vector in vectors.T)
        missed = [vector for vector in more.T if _inverse(solve, vector) > (1.0 + 1e-9) * least]
        if not missed:
            return vectors
        both = np.linalg.qr(np.column_stack([vectors, *missed]))[0]
        values, turns = np.linalg.eigh(both.T @ np.column_stack([solve(vector) for vector in both.T]))
        vectors = both @ turns[:, np.argsort(-values)[:count]]


def _largest(solve: Any, known: np.ndarray, count: int, start: np.ndarray) -> np.ndarray:
    """(n, count) eigenvectors of the inverse of largest eigenvalues, at right angles to what is known (n, m)."""
    from scipy.sparse.linalg import LinearOperator, eigsh

    def beside(vector: np.ndarray) -> np.ndarray:
        return vector - known @ (known.T @ vector)

    size = len(start)
    operator = LinearOperator((size, size), matvec=lambda x: beside(solve(beside(x.ravel()))), dtype=float)
    return np.asarray(eigsh(operator, k=count, which="LA", v0=beside(start))[1])


def _inverse(solve: Any, vector: np.ndarray) -> float:
    return float(vector @ solve(vector))


def factorised(matrix: sparse.csc_array, shift: float) -> Any:
    """A function that solves (matrix + shift) x = b for a symmetric positive definite matrix."""
    from scipy.sparse.linalg import splu

    raised = sparse.csc_matrix(matrix + shift * sparse.eye_array(matrix.shape[0]))
    factors = splu(raised, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    return factors.solve
