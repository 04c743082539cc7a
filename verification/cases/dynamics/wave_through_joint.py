"""A plane wave meets a joint of stiffness k between two half spaces of impedance Z = rho c.

      vI ->          ||
    =================||================      dvT/dt = (2k/Z)(vI - vT)      vR = vI - vT
      <- vR          ||          vT ->       |T| = 1/sqrt(1 + (wZ/2k)^2)   R^2 + T^2 = 1

Pyrak-Nolte, Myer & Cook (1990), J. Geophys. Res. 95(B6), 8617-8638: displacement discontinuity, stress continuous.
One end of a bar of tets (nu = 0, sideways held) moves as a smooth pulse of one period and then stands still. The whole
displacement of the bar is compared with the exact one while the waves are under way. Tets with lumped masses, vertex
contacts and leapfrog are all of second order, so the error falls as h^2.
"""

import numpy as np
from numpy.polynomial import Polynomial

from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.waves import WAVELENGTH, Bar, Floats, Wave

PULSE = 1e-6
SHAPE = (Polynomial([0.0, 4.0, -4.0]) ** 4).integ()
STIFFNESSES = {0.2: 4e-3, 1.0: 8e-4, 5.0: 6e-5}
"""k/(w Z) at the frequency w = 2 pi c / wavelength, and the error of |T| to expect."""
PERIOD = WAVELENGTH / Bar(shear=False, joint="").speed
IMPEDANCE = Bar(shear=False, joint="").impedance
COUNTS = (10, 20, 40)


def moved(time: Floats) -> Floats:
    """Displacement (m) of the end: the integral of (4 s (1 - s))^4, s = time/PERIOD in 0..1."""
    return PULSE * SHAPE(np.clip(time / PERIOD, 0.0, 1.0))


def transmitted(rate: float, time: Floats) -> Floats:
    """(n,) m: U_T of U_T' = rate (U_I - U_T), rate = 2k/Z. While the pulse comes, a polynomial and an exponential."""
    s, a = np.clip(time / PERIOD, 0.0, 1.0), rate * PERIOD
    driven = sum((SHAPE.deriv(m) * (-1 / a) ** m for m in range(1, SHAPE.degree() + 1)), SHAPE)
    risen = driven(s) - driven(0.0) * np.exp(-a * s)
    gone = np.exp(-a * np.maximum(time / PERIOD - 1.0, 0.0))
    return PULSE * (SHAPE(s) + (risen - SHAPE(s)) * gone)


def exact(bar: Bar, rate: float, wave: Wave) -> Floats:
    """(n,) m: displacement of all sections at the end."""
    c, joint = bar.speed, bar.before * WAVELENGTH
    first = np.arange(len(wave.x)) <= np.flatnonzero(wave.x == joint)[0]
    passed = transmitted(rate, wave.time - wave.x / c)
    back = wave.time + (wave.x - 2 * joint) / c
    reflected = moved(back) - transmitted(rate, back)
    return np.where(first, moved(wave.time - wave.x / c) + reflected, passed)


def component(away: Floats, u: Floats) -> complex:
    """Strain that travels away from the joint, at the wavelength: away (n,) m rises, u (n,) m."""
    middle = 0.5 * (away[1:] + away[:-1])
    return complex(np.sum(np.diff(u) * np.exp(2j * np.pi * middle / WAVELENGTH)))


def transmitted_fraction(bar: Bar, wave: Wave) -> float:
    """|T|: what has passed over what came, which is what has passed and what went back (stresses are the same)."""
    joint = bar.before * WAVELENGTH
    last = np.flatnonzero(wave.x == joint)[0] + 1
    passed = component(wave.x[last:] - joint, wave.u[last:])
    back = component(joint - wave.x[:last][::-1], wave.u[:last][::-1])
    return float(abs(passed / (passed + back)))


def run() -> Findings:
    """All stiffnesses of the joint."""
    findings = Findings()
    for ratio, expected in STIFFNESSES.items():
        waves(findings, ratio, expected)
    return findings


def waves(findings: Findings, ratio: float, expected: float) -> None:
    """One stiffness of the joint: errors over the ladder, their order, and |T|."""
    k = ratio * 2 * np.pi * IMPEDANCE / PERIOD
    bar = Bar(shear=False, joint=f'normal_stiffness = "{k!r} Pa/m"\nshear_stiffness = "{k!r} Pa/m"')
    rate = 2 * k / IMPEDANCE
    errors: list[float] = []
    passed: list[float] = []
    for n in COUNTS:
        wave = bar.run(n, moved, 8.0 * PERIOD)
        findings.note(f"k/(wZ) = {ratio}, {n} cells a wavelength", wave.result)
        reference = exact(bar, rate, wave)
        passed.append(transmitted_fraction(bar, wave))
        errors.append(float(np.sqrt(np.mean((wave.u - reference) ** 2)) / np.abs(reference).max()))
    theory = float(1 / np.sqrt(1 + 1 / (2 * ratio) ** 2))
    limit = (4 * passed[-1] - passed[-2]) / 3
    order = float(np.log2(errors[-2] / errors[-1]))
    reason = (
        f"space and time are of second order; the errors are {errors[0]:.1e}, {errors[1]:.1e}, {errors[2]:.1e} of the "
        "largest displacement, and the next order is still felt a little"
    )
    tolerance = Tolerance(0.05, 0.01, reason)
    findings.check(f"order of the error in h, k/(wZ) = {ratio}", "1", order, 2.0, tolerance)
    tolerance = Tolerance(3 * expected, expected, "a quarter of what a chain of masses has with half as many cells")
    findings.check(f"|T|, k/(wZ) = {ratio}, {COUNTS[-1]} cells a wavelength", "1", passed[-1], theory, tolerance)
    tolerance = Tolerance(5e-4, 1e-4, "what is left is of the order h^4, some hundredths of the errors above")
    findings.check(f"|T| extrapolated by h^2, k/(wZ) = {ratio}", "1", limit, theory, tolerance)
    findings.plot(
        f"Displacement of the bar, k/(wZ) = {ratio}",
        "x (m)",
        "u (m)",
        Line("masonry", wave.x, wave.u),
        Line("closed form", wave.x, reference, "dashed"),
    )


CASE = Case(
    name="wave-through-joint",
    row="A17",
    title="A plane wave passes a joint",
    area="Dynamics",
    run=run,
    quick=True,
    no_problems="cells a wavelength are all there is to choose: their order is in the case",
)
