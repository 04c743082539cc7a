"""A plane wave meets a joint of stiffness k between two half spaces of impedance Z = rho c.

      vI ->          ||
    =================||================      dvT/dt = (2k/Z)(vI - vT)      vR = vI - vT
      <- vR          ||          vT ->       |T| = 1/sqrt(1 + (wZ/2k)^2)   R^2 + T^2 = 1

Pyrak-Nolte, Myer & Cook (1990), J. Geophys. Res. 95(B6), 8617-8638: displacement discontinuity, stress continuous.
One end of a bar of tets (nu = 0, sideways held) moves as a smooth pulse of one period and then stands still. The whole
displacement of the bar is compared with the exact one while the waves are under way. Tets with lumped masses, vertex
contacts and leapfrog are all of second order, so the error falls as h^2.
"""

from functools import partial

import numpy as np
from numpy.polynomial import Polynomial
from scipy.integrate import solve_ivp

from verification.case import Case, Check, Findings, Line, Plot
from verification.waves import WAVELENGTH, Bar, Floats, Wave

PULSE = 1e-6
SHAPE = (Polynomial([0.0, 4.0, -4.0]) ** 4).integ()
STIFFNESSES = (0.2, 1.0, 5.0)
"""k/(w Z) at the frequency w = 2 pi c / wavelength."""
LADDER = (10, 20, 40)


def moved(period: float, time: Floats) -> Floats:
    """Displacement (m) of the end: the integral of (4 s (1 - s))^4, s = time/period in 0..1."""
    return PULSE * SHAPE(np.clip(time / period, 0.0, 1.0))


def transmitted(period: float, rate: float, times: Floats) -> Floats:
    """(n,) m: U_T of U_T' = rate (U_I - U_T), rate = 2k/Z."""
    steps = np.linspace(0.0, float(times.max()), 9)
    found = solve_ivp(
        lambda t, y: rate * (moved(period, np.array([t])) - y), (0.0, float(steps[-1])), [0.0],
        method="DOP853", rtol=1e-11, atol=1e-11 * PULSE, max_step=period / 50, dense_output=True,
    )  # fmt: skip
    return np.where(times > 0.0, found.sol(np.maximum(times, 0.0))[0], 0.0)


def exact(bar: Bar, rate: float, wave: Wave) -> Floats:
    """(n,) m: displacement of all sections at the end."""
    c, joint = bar.speed, bar.before * WAVELENGTH
    period = WAVELENGTH / c
    first = np.arange(len(wave.x)) <= np.flatnonzero(wave.x == joint)[0]
    passed = transmitted(period, rate, wave.time - wave.x / c)
    back = wave.time + (wave.x - 2 * joint) / c
    reflected = moved(period, back) - transmitted(period, rate, back)
    return np.where(first, moved(period, wave.time - wave.x / c) + reflected, passed)


def component(bar: Bar, wave: Wave, beyond: float) -> float:
    """|strain| of the sections beyond a place (m), at the wavelength."""
    which = wave.x > beyond * (1 - 1e-12)
    x, u = wave.x[which], wave.u[which]
    u, x = u[np.append(True, np.diff(x) > 0)], np.unique(x)
    middle = 0.5 * (x[1:] + x[:-1])
    return float(abs(np.sum(np.diff(u) * np.exp(2j * np.pi * middle / WAVELENGTH))))


def run() -> Findings:
    found = Findings()
    for ratio in STIFFNESSES:
        waves(found, ratio)
    return found


def waves(found: Findings, ratio: float) -> None:
    """One stiffness of the joint: errors over the ladder, their order, and |T|."""
    plain = Bar(shear=False, joint="")
    period, joint_at = WAVELENGTH / plain.speed, plain.before * WAVELENGTH
    k = ratio * 2 * np.pi / period * plain.impedance
    bar = Bar(shear=False, joint=f'normal_stiffness = "{k!r} Pa/m"\nshear_stiffness = "{k!r} Pa/m"')
    rate, errors = 2 * k / bar.impedance, []
    for n in LADDER:
        wave = bar.run(n, partial(moved, period), 8.0 * period)
        found.note(f"k/(wZ) = {ratio}, {n} cells a wavelength", wave.result)
        reference = exact(bar, rate, wave)
        errors.append(float(np.sqrt(np.mean((wave.u - reference) ** 2)) / np.abs(reference).max()))
    order = float(np.log2(errors[-2] / errors[-1]))
    without = plain.run(LADDER[-1], partial(moved, period), 8.0 * period)
    found.note(f"no joint, {LADDER[-1]} cells a wavelength", without.result)
    value = component(bar, wave, joint_at) / component(plain, without, joint_at)
    found.checks += [
        Check(f"order of the error in h, k/(wZ) = {ratio}", "1", order, 2.0, "closed form", 0.2, 0.1, "x"),
        Check(f"|T|, k/(wZ) = {ratio}", "1", value, 1 / np.sqrt(1 + 1 / (2 * ratio) ** 2), "closed form", 0.01, 0.003, "y"),
    ]
    print(errors)
    found.plots.append(
        Plot(
            f"Displacement of the bar, k/(wZ) = {ratio}", "x (m)", "u (m)",
            (Line("masonry", wave.x, wave.u), Line("closed form", wave.x, reference, "dashed")),
        )  # fmt: skip
    )


CASE = Case(
    name="wave-through-joint",
    row="A17",
    title="A plane wave passes a joint",
    area="Dynamics",
    run=run,
    quick=True,
)
