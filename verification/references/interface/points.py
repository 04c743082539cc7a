"""Stress of a joint at its points: secant damage in tension, Coulomb with plastic slip in shear, and its tangent.

The definition, point by point. D = dt + ds - dt ds shared by both modes (1 - D = wn ws), or each mode its own:
  tension   wn = envelope at the largest opening so far, kappa;  sigma = wn ws (fT/kappa) e for e > 0, kn e for e < 0
  shear     |tau| <= t_res + wn ws (t_max - t_res), both strengths at the sigma that acts;  unloading by ks
            ws follows the curve of that sigma, from where it has this ws, by the slip beyond the strength left before
  crushing  plastic closing by a cap or a cut-off (crushing.py): openings are those beyond it; the slip of the cap is
            none of Coulomb's, so it softens nothing
  c_res     acts between faces that touch: torn faces that stand open by e lose it in the proportion D e/kappa
sigma depends on ws and ws on sigma: both hold at once here, found by repeated substitution.
"""

from dataclasses import dataclass

import numpy as np

from verification.references.interface.crushing import cap, cut_off
from verification.references.interface.envelopes import Law, shear_left, slip_of_fraction, tension_left

Array = np.ndarray
ROUNDS = 60
SETTLED = 1e-15


@dataclass(frozen=True)
class PointHistory:
    """Of n points: largest opening (n,) m, shares left in tension and shear (n,), plastic slip (n, 3) m; of those that
    crush the plastic closing (n,) m and the hardening variable (n,) m."""

    widest: Array
    tension: Array
    shear: Array
    slip: Array
    closing: Array
    hardening: Array


def unharmed(law: Law, count: int) -> PointHistory:
    """The history of points to which nothing has happened."""
    none = np.zeros(count)
    return PointHistory(
        np.full(count, law.opening_at_peak), np.ones(count), np.ones(count), np.zeros((count, 3)), none, none
    )


def traction(law: Law, history: PointHistory, normal: Array, jump: Array) -> tuple[Array, PointHistory]:
    """Traction (..., n, 3) Pa of side b on side a at a jump u_b - u_a (..., n, 3) m, and the history after it."""
    e = np.einsum("...i,...i->...", jump, normal)
    s = jump - e[..., None] * normal
    if law.kind == "elastic":
        return law.kn * e[..., None] * normal + law.ks * s, history
    trial = law.ks * (s - history.slip)
    size = np.sqrt(np.einsum("...i,...i->...", trial, trial))
    closing, crushed_slip, hardening = crushed(law, history, e, size)
    e = e + closing
    shear_size = size - law.ks * crushed_slip
    sigma, strength, widest, wn, ws = coulomb(law, history, e, shear_size)
    bears = np.minimum(strength, shear_size)
    fraction = np.where(size > bears, bears / np.maximum(size, 1e-300), 1.0)
    tau = fraction[..., None] * trial
    slip = history.slip + (1.0 - fraction)[..., None] * trial / law.ks
    return sigma[..., None] * normal + tau, PointHistory(widest, wn, ws, slip, closing, hardening)


def crushed(law: Law, history: PointHistory, e: Array, size: Array) -> tuple[Array, Array, Array]:
    """The closing (m) so far, the slip (m) by the cap in this step, and the hardening variable (m) after it."""
    still = np.zeros_like(e)
    if law.compression is None:
        return history.closing + still, still, history.hardening + still
    pressed = -law.kn * (e + history.closing)
    if law.compression.css is None:
        closing = cut_off(law.compression, law.kn, history.hardening + still, pressed)
        return history.closing + closing, still, history.hardening + closing

    def answer(p: Array, elastic: Array) -> Array:
        return coulomb(law, history, -p / law.kn, elastic)[1]

    hardening = history.hardening + still
    closing, slip, longer = cap(law.compression, law.kn, law.ks, hardening, pressed, size, answer)
    return history.closing + closing, slip, hardening + longer


def coulomb(law: Law, history: PointHistory, e: Array, size: Array) -> tuple[Array, Array, Array, Array, Array]:
    """Normal stress and shear strength (Pa) at an opening e (m) beyond what has closed for good and an elastic shear
    stress (Pa), with the largest opening and the shares left in tension and shear."""
    widest = np.maximum(history.widest, e)
    wn = np.where(e > history.widest, np.minimum(history.tension, tension_left(law, widest)), history.tension)
    ws = np.broadcast_to(history.shear, e.shape)
    for _ in range(ROUNDS):
        before = ws
        sigma = normal_stress(law, widest, wn, ws, e)
        peak, residual = strengths(law, widest, wn, sigma, e)
        shared = wn if law.combined else 1.0
        past = (size - residual - history.shear * shared * (peak - residual)) / law.ks
        compression = np.maximum(-sigma, 0.0)
        so_far = slip_of_fraction(law, history.shear, peak, residual, compression)
        shear_intact = shear_left(law, so_far + np.maximum(past, 0.0), peak, residual, compression)
        falls = (past > 0.0) & (peak > residual)
        ws = np.where(falls, np.minimum(history.shear, shear_intact), history.shear)
        if np.max(np.abs(ws - before), initial=0.0) < SETTLED:
            break
    sigma = normal_stress(law, widest, wn, ws, e)
    peak, residual = strengths(law, widest, wn, sigma, e)
    return sigma, residual + ws * (wn if law.combined else 1.0) * (peak - residual), widest, wn, ws


def normal_stress(law: Law, widest: Array, wn: Array, ws: Array, e: Array) -> Array:
    """Normal stress (Pa): along the secant that the damage leaves, or with all of kn where the faces are pressed."""
    secant = wn * (ws if law.combined else 1.0) * law.fT / widest if law.fT > 0.0 else 0.0 * e
    return e * np.where(e > 0.0, secant, law.kn)


def strengths(law: Law, widest: Array, wn: Array, sigma: Array, e: Array) -> tuple[Array, Array]:
    """t_max and t_res (Pa) at the sigma that acts, eq. (8); not below 0, nor t_max below t_res."""
    lost = np.where(e > 0.0, (1.0 - (wn if law.combined else 1.0)) * np.minimum(e / np.maximum(widest, 1e-300), 1.0), 0)
    residual = np.maximum(law.c_res * (1.0 - lost) - sigma * law.tan_res, 0.0)
    return np.maximum(law.c0 - sigma * law.tan0, residual), residual


def tangent(law: Law, history: PointHistory, normal: Array, jump: Array) -> Array:
    """Derivative of the traction by the jump (n, 3, 3) Pa/m: exact if elastic, else by central differences."""
    if law.kind == "elastic":
        nn = normal[:, :, None] * normal[:, None, :]
        return law.kn * nn + law.ks * (np.eye(3) - nn)
    lengths = [law.opening_at_peak, law.c0 / law.ks]
    if law.compression is not None:
        lengths.append(law.compression.fm / law.kn)
    h = 1e-6 * min(length for length in lengths if length > 0.0)
    shift = h * np.concatenate([np.eye(3), -np.eye(3)])[:, None, :]
    moved = traction(law, history, normal, jump + shift)[0]
    return np.moveaxis(moved[:3] - moved[3:], 0, -1) / (2.0 * h)
