"""A harmonic shear wave makes a joint slip: what passes, what goes back and what becomes heat.

      tau_I = t0 sin(wt) ->      |            tau = clip(tau_I, -ts, ts)
    =============================|=========
      <- tau_I - tau             |  tau ->    slip rate = 2 (tau_I - tau)/Z

Between two half spaces of impedance Z the joint's stress is that of the incident wave until it reaches the strength ts,
and stays there while the incident stress is larger. With s = ts/t0, q = asin(s), energies of a cycle over the incident:
    T^2 = (4/pi) [q/2 - sin(2q)/4 + s^2 (pi/2 - q)]
    R^2 = (4/pi) [(pi/2 - q)/2 + sin(2q)/4 - 2 s cos(q) + s^2 (pi/2 - q)]          A^2 = 1 - R^2 - T^2
Miller (1978), Bull. Seism. Soc. Am. 68(4), 987-998, has the problem, with an equivalent linear joint; it is also among
the verification problems of UDEC and FLAC3D (slip induced by a harmonic shear wave). The joint here has a stiffness of
50 w Z, so it gives way by 1 % of what the wave moves before it slips. Three cycles come, the middle one is measured.
"""

from math import asin, cos, pi, sin

import numpy as np

from verification.balance import dissipated
from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.waves import WAVELENGTH, Bar, Floats, Wave

AMPLITUDE, CYCLES, CELLS = 1e-6, 3, 80
PERIOD = WAVELENGTH / Bar(shear=True, joint="").speed
IMPEDANCE = Bar(shear=True, joint="").impedance
INCIDENT = IMPEDANCE * AMPLITUDE * pi / PERIOD
"""Pa: the wave moves its points to and fro by AMPLITUDE (m)."""
STRENGTHS = (0.2, 0.5, 0.8)
STIFFNESS = 50 * 2 * pi / PERIOD * IMPEDANCE


def joint(strength: float) -> str:
    """The joint's table: a constant shear strength (Pa), no friction, and no tension that could tear it."""
    return f"""
law = "exponential"
normal_stiffness = "{STIFFNESS!r} Pa/m"
shear_stiffness = "{STIFFNESS!r} Pa/m"
tensile_strength = "1 GPa"
cohesion = "{strength!r} Pa"
residual_cohesion = "{strength!r} Pa"
tan_friction_angle = 0
fracture_energy_mode_1 = "1e9 N/m"
fracture_energy_mode_2 = "1e9 N/m"
"""


def moved(time: Floats) -> Floats:
    """(n,) m: the end moves with velocity (pi AMPLITUDE/PERIOD) sin(wt) for three cycles."""
    return 0.5 * AMPLITUDE * (1 - np.cos(2 * pi * np.clip(time / PERIOD, 0.0, CYCLES)))


def coefficients(s: float) -> tuple[float, float, float]:
    """T, R and A of a joint that bears a share s of the incident stress."""
    q = asin(s)
    passed = 4 / pi * (q / 2 - sin(2 * q) / 4 + s**2 * (pi / 2 - q))
    back = 4 / pi * ((pi / 2 - q) / 2 + sin(2 * q) / 4 - 2 * s * cos(q) + s**2 * (pi / 2 - q))
    return passed**0.5, back**0.5, (1 - passed - back) ** 0.5


def energy(away: Floats, u: Floats) -> float:
    """Over that of the incident wave: energy of the cycle that is two to three wavelengths from the joint."""
    middle, strain = 0.5 * (away[1:] + away[:-1]), np.diff(u) / np.diff(away)
    cycle = (middle > 2 * WAVELENGTH) & (middle < 3 * WAVELENGTH)
    return float(np.mean(strain[cycle] ** 2) / (0.5 * (INCIDENT / Bar(shear=True, joint="").modulus) ** 2))


def measured(bar: Bar, wave: Wave) -> tuple[float, float, float]:
    """T, R and A."""
    at = bar.before * WAVELENGTH
    last = np.flatnonzero(wave.x == at)[0] + 1
    passed = energy(wave.x[last:] - at, wave.u[last:])
    back = energy(at - wave.x[:last][::-1], wave.u[:last][::-1])
    return passed**0.5, back**0.5, max(1 - passed - back, 0.0) ** 0.5


def run() -> Findings:
    """Three strengths of the joint."""
    findings = Findings()
    for s in STRENGTHS:
        bar = Bar(shear=True, joint=joint(s * INCIDENT))
        wave = bar.run(CELLS, moved, 8.0 * PERIOD)
        findings.note(f"ts/t0 = {s}", wave.result)
        for name, value, reference in zip("TRA", measured(bar, wave), coefficients(s), strict=True):
            tolerance = Tolerance(
                2e-3,
                5e-4,
                "the joint's stiffness takes (1/100)^2 of an elastic wave and delays the clipped one's corners; cells "
                "of 1/80 wavelength round them",
            )
            findings.check(f"{name}, ts/t0 = {s}", "1", value, reference, tolerance, scale=1.0)
        came_in = CYCLES * 0.5 * INCIDENT**2 / IMPEDANCE * PERIOD * wave.area
        heat = dissipated(wave.result.summary) / came_in
        tolerance = Tolerance(2e-3, 5e-4, "the same A^2 from the law's own account, over all three cycles")
        quantity = f"heat that the joint booked over the incident energy, ts/t0 = {s}"
        findings.check(quantity, "1", heat, coefficients(s)[2] ** 2, tolerance, scale=1.0)
        beyond = wave.x > bar.before * WAVELENGTH
        stress = np.diff(wave.u[beyond]) / np.diff(wave.x[beyond]) * bar.modulus
        place = wave.x[beyond][1:]
        exact = np.clip(
            INCIDENT * np.sin(2 * pi * (wave.time / PERIOD - place / WAVELENGTH)), -s * INCIDENT, s * INCIDENT
        )
        came = (wave.time - place / bar.speed > 0) & (wave.time - place / bar.speed < CYCLES * PERIOD)
        lines = (Line("masonry", place, -stress), Line("closed form", place, np.where(came, exact, 0.0), "dashed"))
        findings.plot(f"Stress that has passed, ts/t0 = {s}", "x (m)", "tau (Pa)", *lines)
    return findings


CASE = Case(
    name="slip-under-shear-wave",
    row="A18",
    title="A joint slips under a harmonic shear wave",
    area="Dynamics",
    run=run,
    quick=True,
    no_problems="cells a wavelength are all there is to choose: their order is in the case",
)
