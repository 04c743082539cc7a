"""Closed forms of one contact in tension or in shear, and of the couplet: what the program must reproduce.

Written from the equations, apart from `masonry.laws`: eqs (12) to (17) of the paper as mended in the errata (lambda of
eq. (15) is 1 at the peak; c of the exponent of eq. (17) is c0), eqs (7) and (8) for the brittle contact. SI throughout.
Tension is positive as a stress; `compression` is the confining stress, positive. Functions take numbers or arrays.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

LAWS = ("brittle", "linear", "polynomial", "exponential")
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Joint:
    """Properties of a contact in the paper's letters: Pa/m, Pa, N/m, 1; defaults are Table 1 and the scene `couplet`.

    G_II_slope (m) times the compression is added to G_II. alpha and beta serve the polynomial law alone.
    """

    kn: float = 150e9
    ks: float = 70e9
    fT: float = 0.58e6  # noqa: N815
    c0: float = 0.87e6
    tan0: float = 1.01
    c_res: float = 0.0
    tan_res: float = 0.73
    G_I: float = 5.8
    G_II: float = 58.0
    G_II_slope: float = 130e-6
    alpha: float = 3.0
    beta: float = 2.5

    @property
    def opening_at_peak(self) -> float:
        """un0 = fT/kn (m)."""
        return self.fT / self.kn

    def peak(self, compression: ArrayLike = 0.0) -> Floats:
        """t_max = c0 + sigma tan(phi0), eq. (8) (Pa)."""
        return self.c0 + np.asarray(compression, dtype=float) * self.tan0

    def residual(self, compression: ArrayLike = 0.0) -> Floats:
        """t_res = c_res + sigma tan(phi_res) (Pa)."""
        return self.c_res + np.asarray(compression, dtype=float) * self.tan_res

    def mode_2_energy(self, compression: ArrayLike = 0.0) -> Floats:
        """G_II at a compression (N/m), Table 1."""
        return self.G_II + self.G_II_slope * np.asarray(compression, dtype=float)


def tension(law: str, joint: Joint, opening: ArrayLike) -> Floats:
    """Stress (Pa) at an opening (m) that only grows: kn un, then eqs (7), (12), (14), (16). Compression: kn un."""
    un = np.asarray(opening, dtype=float)
    ft, un0 = joint.fT, joint.opening_at_peak
    if law == "elastic":
        return joint.kn * un
    past = np.maximum(un - un0, 0.0)
    if law == "brittle":
        softened = np.zeros_like(un)
    elif law == "linear":
        softened = np.maximum(ft - ft * past / (2.0 * joint.G_I / ft - un0), 0.0)
    elif law == "polynomial":
        softened = ft * (1.0 + past * ft / (2.0 * joint.G_I)) ** -joint.alpha
    elif law == "exponential":
        softened = ft * np.exp(-past * ft / joint.G_I)
    else:
        raise ValueError(f"no closed form for law '{law}'")
    return np.where(un <= un0, joint.kn * un, softened)


def tension_work(law: str, joint: Joint, opening: ArrayLike) -> Floats:
    """Work (J/m2) up to an opening (m) that only grows: the integral of `tension`, term by term."""
    un = np.asarray(opening, dtype=float)
    ft, g1, un0 = joint.fT, joint.G_I, joint.opening_at_peak
    elastic = 0.5 * joint.kn * np.minimum(un, un0) ** 2
    past = np.maximum(un - un0, 0.0)
    if law == "elastic":
        return 0.5 * joint.kn * un**2
    if law == "brittle":
        return elastic
    if law == "linear":
        width = 2.0 * g1 / ft - un0
        x = np.minimum(past, width)
        return elastic + ft * x * (1.0 - 0.5 * x / width)
    if law == "polynomial":
        x = 1.0 + past * ft / (2.0 * g1)
        return elastic + 2.0 * g1 / (joint.alpha - 1.0) * (1.0 - x ** (1.0 - joint.alpha))
    if law == "exponential":
        return elastic + g1 * (1.0 - np.exp(-past * ft / g1))
    raise ValueError(f"no closed form for law '{law}'")


def unloaded(law: str, joint: Joint, opening: ArrayLike, widest: float, unloading: str = "secant") -> Floats:
    """Stress (Pa) at an opening (m) once the contact has been opened to `widest` (m), beyond it the envelope.

    secant: to the origin, then full kn.  elastic: slope kn from the envelope, on into compression without a kink.
    """
    un = np.asarray(opening, dtype=float)
    reached = max(widest, joint.opening_at_peak)
    top = float(tension(law, joint, reached))
    line = (
        joint.kn * (un - reached) + top
        if unloading == "elastic"
        else np.where(un > 0, top * un / reached, joint.kn * un)
    )
    return np.where(un > reached, tension(law, joint, un), line)


def dissipated_in_tension(law: str, joint: Joint, widest: float, unloading: str = "secant") -> float:
    """Energy (J/m2) that is gone once the contact has been opened to `widest` (m): work less what unloading returns."""
    top = float(tension(law, joint, widest))
    returned = 0.5 * top**2 / joint.kn if unloading == "elastic" else 0.5 * top * widest
    return float(tension_work(law, joint, widest)) - returned


def shear(law: str, joint: Joint, slip: ArrayLike, compression: ArrayLike) -> Floats:
    """Shear stress (Pa) at a total slip (m) in one direction under a constant compression: ks us, then eqs (8), (13),
    (15), (17) with lambda = 1 at us0 = t_max/ks."""
    us = np.asarray(slip, dtype=float)
    peak, residual, g2 = joint.peak(compression), joint.residual(compression), joint.mode_2_energy(compression)
    if law == "elastic":
        return joint.ks * us
    past = np.maximum(us - peak / joint.ks, 0.0)
    if law == "brittle":
        fraction = np.zeros_like(us)
    elif law == "linear":
        last = 2.0 * g2 / (peak - residual) + residual / joint.ks
        fraction = np.maximum(1.0 - past / (last - peak / joint.ks), 0.0)
    elif law == "polynomial":
        fraction = (1.0 + past * peak / (2.0 * g2)) ** -joint.beta
    elif law == "exponential":
        fraction = np.exp(-past * joint.c0 / g2)
    else:
        raise ValueError(f"no closed form for law '{law}'")
    return np.where(us <= peak / joint.ks, joint.ks * us, residual + fraction * (peak - residual))


def shear_work(law: str, joint: Joint, slip: ArrayLike, compression: ArrayLike) -> Floats:
    """Work (J/m2) of the shear stress up to a total slip (m): the integral of `shear`, term by term."""
    us = np.asarray(slip, dtype=float)
    peak, residual, g2 = joint.peak(compression), joint.residual(compression), joint.mode_2_energy(compression)
    us0, drop = peak / joint.ks, peak - residual
    elastic = 0.5 * joint.ks * np.minimum(us, us0) ** 2
    past = np.maximum(us - us0, 0.0)
    if law == "elastic":
        return 0.5 * joint.ks * us**2
    if law == "brittle":
        above = np.zeros_like(us)
    elif law == "linear":
        width = 2.0 * g2 / drop - drop / joint.ks
        x = np.minimum(past, width)
        above = drop * x * (1.0 - 0.5 * x / width)
    elif law == "polynomial":
        w = 2.0 * g2 / peak
        above = drop * w / (joint.beta - 1.0) * (1.0 - (1.0 + past / w) ** (1.0 - joint.beta))
    elif law == "exponential":
        above = drop * past if joint.c0 == 0.0 else -drop * g2 / joint.c0 * np.expm1(-past * joint.c0 / g2)
    else:
        raise ValueError(f"no closed form for law '{law}'")
    return elastic + above + residual * past


def dissipated_in_shear(law: str, joint: Joint, slip: ArrayLike, compression: ArrayLike) -> Floats:
    """Energy (J/m2) that is gone at a total slip (m): work less tau^2/(2 ks)."""
    return shear_work(law, joint, slip, compression) - 0.5 * shear(law, joint, slip, compression) ** 2 / joint.ks


def shear_area(law: str, joint: Joint, compression: float) -> float:
    """Area (J/m2) between the whole shear curve and t_res, the elastic part above t_res included; verification 2.2."""
    peak, residual, g2 = (float(f(compression)) for f in (joint.peak, joint.residual, joint.mode_2_energy))
    drop = peak - residual
    triangle = 0.5 * drop**2 / joint.ks
    post_peak = {
        "brittle": 0.0,
        "linear": g2 - triangle,
        "polynomial": 2.0 * g2 * drop / (peak * (joint.beta - 1.0)),
        "exponential": g2 * drop / joint.c0 if joint.c0 > 0.0 else np.inf,
    }
    return triangle + post_peak[law]


def affine_couplet_compliance(
    height: float, length: float, shear_modulus: float, glue_kn: float, glue_ks: float
) -> float:
    """Compliance (m/Pa) of two affine units, each glued to a rigid plate that cannot turn, in series with their joint.

    Each unit (height h, length L, m) is in uniform strain with sigma_xz = tau. Per unit, between plate and joint:
    tau/ks of slip in the glue, and h du_x/dz. Moment equilibrium: sum(f_z x) over its faces = V sigma_zx = tau A h.
    The specimen is its own image when turned by 180 degrees about the axis y through the joint, which makes the joint's
    normal stress even in x: only the glue carries the moment, by kn A (L^2/12) du_z/dx in size (a rule of two Gauss
    points or more along L has the exact second moment), so du_z/dx = -12 tau h/(kn L^2), and
    du_x/dz = tau/G - du_z/dx.
    """
    rotation = 12.0 * height / (glue_kn * length**2)
    return 2.0 * (1.0 / glue_ks + height / shear_modulus + height * rotation)
