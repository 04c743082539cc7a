"""Rules for what tests seldom give: direct tension from bending, fracture energies, residual friction, crushing.

Lourenco names them for masonry of clay where nothing was measured: in Angelillo, Lourenco, Milani, Masonry behaviour
and modelling (CISM 551, Springer 2014), and from tests of van der Pluijm (1992, 1993). Each has its range.
"""

from typing import NamedTuple

MPA = 1e6
RECOMMENDED = "recommended where not measured, Angelillo, Lourenco, Milani (2014)"
TESTED_TENSION = (0.3e6, 0.9e6)
"""Pa: bond strengths of the joints from which the energy of mode I is."""
LEAST_MODE_2 = 10.0
"""N/m: the least energy of mode II among those tests."""


class PublishedRule(NamedTuple):
    """A value and its range in SI, and where it is from."""

    value: float
    low: float
    high: float
    source: str


def direct_tension(flexural: float) -> PublishedRule:
    """Tensile strength across a joint from its flexural one, Pa.

    An elastic joint that is brittle has a ratio of 1, one that yields all over its depth a ratio of 3.
    """
    source = "direct tension = flexural strength / 1.5 (tests of van der Pluijm)"
    return PublishedRule(flexural / 1.5, flexural / 2.5, flexural, source)


def mode_1_energy(tensile_strength: float) -> PublishedRule:
    """Of opening, N/m. The ductility of the tests' weakest joint bounds the range of still weaker ones."""
    low = max(5.0 * min(tensile_strength / TESTED_TENSION[0], 1.0), 0.5)
    return PublishedRule(12.0, low, 20.0, f"0.012 N/mm, {RECOMMENDED}; tests of van der Pluijm have 0.005 to 0.02 N/mm")


def mode_2_energy(cohesion: float) -> PublishedRule:
    """Of sliding without compression, N/m."""
    value = max(0.1e-3 * cohesion, LEAST_MODE_2)
    least = ", at least 10 N/m" if value == LEAST_MODE_2 else ""
    source = f"0.1 mm x cohesion{least}, {RECOMMENDED}; tests of van der Pluijm have 0.01 to 0.25 N/mm"
    return PublishedRule(value, min(LEAST_MODE_2, 0.5 * value), 4.0 * value, source)


def mode_2_slope() -> PublishedRule:
    """More of it for each Pa of compression, m."""
    source = "none measured; Table 1 of Pulatsu et al. (2020) has 130 N/m/MPa for a couplet"
    return PublishedRule(0.0, 0.0, 130e-6, source)


def tension_from_cohesion(cohesion: float) -> PublishedRule:
    """Tensile strength across a joint whose cohesion alone is known, Pa."""
    source = "none measured: cohesion / 1.5, the ratio of Tables 3 to 5 of Pulatsu et al. (2020)"
    return PublishedRule(cohesion / 1.5, 0.3 * cohesion, cohesion, source)


def residual_friction(tan_friction: float) -> PublishedRule:
    """Tangent of a joint that has slid."""
    value = min(0.75, tan_friction)
    cut = "" if value == 0.75 else "; not above the intact one, which it is here"
    source = f"tan 0.75, {RECOMMENDED}{cut}"
    return PublishedRule(value, 0.8 * value, min(tan_friction, 0.9 if value == 0.75 else tan_friction), source)


def crushing_energy(strength: float) -> PublishedRule:
    """N/m of masonry of a compressive strength (Pa): that of CEB-FIP Model Code 90 for concrete."""
    f = strength / MPA
    per_mm = 1.6 * f if f < 12.0 else 0.33 * f if f > 80.0 else 15.0 + 0.43 * f - 0.0036 * f**2
    formula = "1.6 mm x f" if f < 12.0 else "0.33 mm x f" if f > 80.0 else "15 + 0.43 f - 0.0036 f^2 N/mm"
    source = f"{formula}, {RECOMMENDED}, after Model Code 90 of concrete; Lourenco (1996) has 5 N/mm for 10.5 MPa"
    return PublishedRule(1e3 * per_mm, 300.0 * per_mm, 1e3 * per_mm, source)


def closing_at_peak(height: float, strength: float, modulus: float) -> PublishedRule | None:
    """Plastic closing (m) of a joint whose course (m, Pa) shortens by 0.2 % at its peak (Pa); None where it cannot."""
    value, low, high = (height * (strain - strength / modulus) for strain in (2e-3, 1.5e-3, 4e-3))
    if value <= 0.0:
        return None
    source = "0.2 % of the course less its elastic share; 0.2 % is about that of concrete at its peak (Model Code 90)"
    return PublishedRule(value, max(low, 0.25 * value), high, source)
