"""Table 1 and eqs (15) and (17) as the paper prints them, and what they come to. SI; compression positive."""

import numpy as np
from numpy.typing import ArrayLike

from verification.paper.experiment import Misprint
from verification.references.closed_forms import Floats, Joint

SIGMA, ANOTHER = 0.1e6, 1.0e6
"""Compressions (Pa) at which the equations are looked at."""
FAR = 0.3e-3
"""A slip (m) well into softening."""


def mode_2_energy(compression: ArrayLike) -> Floats:
    """Table 1 with its minus: 0.058 - 0.13 sigma, N/m of Pa."""
    return 58.0 - 130e-6 * np.asarray(compression, dtype=float)


def intact_fraction(joint: Joint, slip: ArrayLike, compression: float) -> Floats:
    """Lambda of eq. (15) as printed: (us/(w - us0 + us))^beta, w = 2 G_II/tau_max."""
    us, peak = np.asarray(slip, dtype=float), float(joint.peak(compression))
    return (us / (2.0 * float(joint.mode_2_energy(compression)) / peak - peak / joint.ks + us)) ** joint.beta


def mended_fraction(joint: Joint, slip: ArrayLike, compression: float) -> Floats:
    """Lambda of eq. (15) as mended, 1 up to the peak: (w/(w + us - us0))^beta."""
    peak = float(joint.peak(compression))
    w = 2.0 * float(joint.mode_2_energy(compression)) / peak
    return (w / (w + np.maximum(np.asarray(slip, dtype=float) - peak / joint.ks, 0.0))) ** joint.beta


def friction(joint: Joint, intact_fraction: ArrayLike) -> Floats:
    """tan(phi) of eq. (15) as printed: tan0 + lambda (tan0 - tan_res)."""
    return joint.tan0 + np.asarray(intact_fraction, dtype=float) * (joint.tan0 - joint.tan_res)


def fading_cohesion(joint: Joint, slip: float, compression: float) -> float:
    """Cohesion (Pa) by eq. (17) as printed, its c read as the present cohesion: c = c0 exp(-(c/G_II)(us - us0)).

    With y = c x/G_II this is y exp(y) = c0 x/G_II, y Lambert's W. Without residual cohesion.
    """
    from scipy.special import lambertw

    past = slip - float(joint.peak(compression)) / joint.ks
    g2 = float(joint.mode_2_energy(compression))
    return float(g2 / past * lambertw(joint.c0 * past / g2).real)


def misprints() -> list[Misprint]:
    """Values of the printed lines, and the formulas built in their place."""
    low, high = Joint(beta=2.1), Joint(beta=2.9)
    pairs = ((low, SIGMA), (high, ANOTHER))
    energies = [float(mode_2_energy(s)) for s in (SIGMA, 0.5e6, ANOTHER)]
    peaks = [float(intact_fraction(joint, joint.peak(s) / joint.ks, s)) for joint, s in pairs]
    late = [float(intact_fraction(joint, FAR, s)) for joint, s in pairs]
    mended = [float(mended_fraction(joint, FAR, s)) for joint, s in pairs]
    tangents = [float(friction(joint, value)) for (joint, _), value in zip(pairs, late, strict=True)]
    fading = [fading_cohesion(low, FAR, SIGMA) / 1e6, low.c0 * mended_exponential(low, FAR, SIGMA) / 1e6]
    return [
        Misprint(
            "2.1, eq. (3)",
            "sgn(0) = 1",
            "a body at rest answers a force F with 0.2 F, and -F with 1.8 F",
            "sgn(0) = 0",
        ),
        Misprint(
            "3, eq. (15)",
            "lambda = (us/(2 G_II/tau_max - tau_max/ks + us))^beta",
            f"cohesion is gone at the peak and comes back: lambda is {peaks[0]:.2g} and {peaks[1]:.2g} there under 0.1 "
            f"and 1.0 MPa, {late[0]:.2f} and {late[1]:.2f} at 0.3 mm",
            f"2 G_II/tau_max on top, as in eq. (14): 1 at the peak, {mended[0]:.3f} and {mended[1]:.3f} at 0.3 mm",
        ),
        Misprint(
            "3, eq. (15)",
            "tan(phi) = tan(phi0) + lambda (tan(phi0) - tan(phi_res))",
            f"friction grows: from 1.01 to {tangents[0]:.2f} and {tangents[1]:.2f} at 0.3 mm under 0.1 and 1.0 MPa",
            "tan(phi_res) + lambda (tan(phi0) - tan(phi_res))",
        ),
        Misprint(
            "3, eq. (17)",
            "exp(-c (us - us0)/G_II)",
            "read as the present cohesion, c slows its own fading, and the area under the curve has no end: "
            f"{fading[0]:.3f} MPa are left at 0.3 mm under 0.1 MPa instead of {fading[1]:.3f}",
            "c0 in place of c, as in the source of the law",
        ),
        Misprint(
            "4, Table 1",
            "G_II = 0.058 - 0.13 sigma (N/mm, MPa)",
            ", ".join(f"{e:.3g}" for e in energies) + " N/m under 0.1, 0.5 and 1.0 MPa: negative from 0.446 MPa on",
            "a plus: 71, 123 and 188 N/m",
        ),
        Misprint(
            "6, Fig. 19",
            "G_I of the units is 20 N/m, twice that of the interface",
            "the interface has 8 N/m, so that twice is 16",
            "both: 16 and 20 N/m",
        ),
    ]


def mended_exponential(joint: Joint, slip: float, compression: float) -> float:
    """Share of the cohesion left at a slip (m) beyond the peak by eq. (17) with c0 in the exponent."""
    past = slip - float(joint.peak(compression)) / joint.ks
    return float(np.exp(-joint.c0 * past / float(joint.mode_2_energy(compression))))
