"""The slowest modes of an oscillator with the energy |B u|^2 / 2 and a mass for each dof."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse

DENSE = 240
"""Dofs up to which all modes are computed at once."""
SHIFT = 1e-11
"""Of the stiffest dof's square frequency, by which all are raised, so that what is loose can be solved for."""
LOOSE = 1e-16
"""Of the same: square frequencies below it are those of parts that nothing holds."""
BESIDE = 8
"""Vectors of a block besides those that are asked for: it converges with the ratio of what it leaves out to them."""
APPLIED = 3
"""Times that a block is solved for before its best vectors are taken anew."""
ROUNDS = 60
"""Of that, at most."""
NEAR, ROUNDED = 1e-9, 1e-15
"""Residual of a vector over its eigenvalue at which it is taken: the eigenvalue's error is its square. And what
rounding leaves of it, over the ratio of the largest eigenvalue of the matrix to this one."""
SEED = 2718

Solve = Callable[[np.ndarray], np.ndarray]


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
    """(n, count) orthonormal vectors of the `count` smallest eigenvalues, none left out."""
    size, width = matrix.shape[0], count + BESIDE
    if size <= max(DENSE, (APPLIED + 1) * width):
        return np.asarray(np.linalg.eigh(matrix.toarray())[1][:, :count])
    start = np.random.default_rng(SEED).standard_normal((size, width))
    return dominant(factorised(matrix, shift), start, float(matrix.diagonal().max()))[:, :count]


def dominant(solve: Solve, start: np.ndarray, top: float) -> np.ndarray:
    """(n, m) orthonormal eigenvectors of the largest eigenvalues of the inverse that `solve` applies, largest first.

    A block of m vectors (n, m) is replaced by the best m of the space that it, its image, the image of that, ... span
    (block Krylov method; Golub, Underwood, 1977, in Rice, Mathematical Software III, 361-377). A block meets each of up
    to m equal eigenvalues with a vector of its own, as a single vector cannot. Within BESIDE of the last they may lag.
    top  about the largest eigenvalue of the matrix: rounding leaves 1e-16 of it in each solve
    """
    block, width = np.linalg.qr(start)[0], start.shape[1]
    for _ in range(ROUNDS):
        basis, images = block, solve(block)
        for _ in range(APPLIED - 1):
            basis = np.hstack([basis, _beside(images[:, -width:], basis)])
            images = np.hstack([images, solve(basis[:, -width:])])
        product = basis.T @ images
        values, turns = np.linalg.eigh(0.5 * (product + product.T))
        turns, values = turns[:, : -width - 1 : -1], values[: -width - 1 : -1]
        block = np.linalg.qr(basis @ turns)[0]
        rest = images @ turns
        rest -= block @ (block.T @ rest)
        counted = slice(0, width - BESIDE)
        near = values * (NEAR + ROUNDED * np.abs(values) * top)
        if (np.linalg.norm(rest, axis=0) <= near)[counted].all():
            break
    return block


def _beside(vectors: np.ndarray, basis: np.ndarray) -> np.ndarray:
    """(n, m) an orthonormal basis of what vectors (n, m) have at right angles to an orthonormal basis (n, k); where
    they have less than m directions of their own, any others."""
    rest = vectors / np.maximum(np.linalg.norm(vectors, axis=0), 1e-300)
    for _ in range(2):  # twice is enough
        rest = np.linalg.qr(rest - basis @ (basis.T @ rest))[0]
    return np.asarray(rest)


def factorised(matrix: sparse.csc_array, shift: float) -> Solve:
    """A function that solves (matrix + shift) x = b for a symmetric positive definite matrix."""
    from scipy.sparse.linalg import splu

    raised = sparse.csc_matrix(matrix + shift * sparse.eye_array(matrix.shape[0]))
    factors = splu(raised, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    return lambda sides: np.asarray(factors.solve(sides))
