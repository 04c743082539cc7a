"""Strength of a joint and how it is lost, written from the equations (12) to (17) as mended in the errata.

Tension is positive. Quantities of many points at once: arrays of any shape. SI: Pa, Pa/m, N/m, m.
"""

from dataclasses import dataclass

import numpy as np

from verification.references.interface.crushing import Compression

Array = np.ndarray


@dataclass(frozen=True)
class Law:
    """A joint: elastic (eqs 5, 6), or softening as `kind` says: "elastic", "linear", "polynomial", "exponential".

    kn, ks            Pa/m                       fT, c0, c_res  Pa      tan0, tan_res  1
    G_I, G_II         N/m; G_II + G_II_slope times the compression      alpha, beta  exponents of eqs (14), (15)
    combined          one damage D = dt + ds - dt ds lowers tension and cohesion together, else each its own
    compression       what it bears in compression, without end where None
    """

    kind: str
    kn: float
    ks: float
    fT: float = np.inf  # noqa: N815
    c0: float = 0.0
    tan0: float = 0.0
    c_res: float = 0.0
    tan_res: float = 0.0
    G_I: float = 0.0
    G_II: float = 0.0
    G_II_slope: float = 0.0
    alpha: float = 3.0
    beta: float = 3.0
    combined: bool = True
    compression: Compression | None = None

    @property
    def opening_at_peak(self) -> float:
        """un0 = fT/kn (m); without end for an elastic joint."""
        return self.fT / self.kn


def tension_left(law: Law, opening: Array) -> Array:
    """Share of fT that the envelope of eqs (12), (14), (16) bears at an opening beyond the peak; 1 before it."""
    past = np.maximum(opening - law.opening_at_peak, 0.0)
    if law.kind == "linear":
        return np.maximum(1.0 - past / (2.0 * law.G_I / law.fT - law.opening_at_peak), 0.0)
    if law.kind == "polynomial":
        return (1.0 + 0.5 * past * law.fT / law.G_I) ** -law.alpha
    if law.kind == "exponential":
        return np.exp(-past * law.fT / law.G_I)
    raise ValueError(f"no envelope of a {law.kind} joint in tension")


def shear_left(law: Law, past: Array, peak: Array, residual: Array, compression: Array) -> Array:
    """Share of t_max - t_res left at a slip `past` (m) beyond t_max/ks, eqs (13), (15), (17).

    A normal stress that acts at the time sets peak and residual; friction falls in step with the cohesion.
    """
    energy = law.G_II + law.G_II_slope * compression
    drop = np.maximum(peak - residual, 1e-300)
    if law.kind == "linear":
        return np.clip(1.0 - past / (2.0 * energy / drop - drop / law.ks), 0.0, 1.0)
    if law.kind == "polynomial":
        return (1.0 + 0.5 * past * peak / energy) ** -law.beta
    if law.kind == "exponential":
        return np.exp(-past * law.c0 / energy)
    raise ValueError(f"no envelope of a {law.kind} joint in shear")


def slip_of_fraction(law: Law, fraction: Array, peak: Array, residual: Array, compression: Array) -> Array:
    """The slip (m) beyond t_max/ks at which `shear_left` is so much: its inverse."""
    energy = law.G_II + law.G_II_slope * compression
    drop, fraction = np.maximum(peak - residual, 1e-300), np.maximum(fraction, 1e-300)
    if law.kind == "linear":
        return (1.0 - fraction) * (2.0 * energy / drop - drop / law.ks)
    if law.kind == "polynomial":
        return (fraction ** (-1.0 / law.beta) - 1.0) * 2.0 * energy / np.maximum(peak, 1e-300)
    if law.kind == "exponential":
        return -np.log(fraction) * energy / law.c0
    raise ValueError(f"no envelope of a {law.kind} joint in shear")
