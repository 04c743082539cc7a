"""Records of a laboratory test in summary.json: a measured curve beside the computed one, results by a standard."""

from dataclasses import dataclass

from masonry.runtime.record import Record, one_of


@dataclass(frozen=True, eq=False)
class CurveReadings(Record):
    """Of a curve: its extremes, the secant stiffness at 0.7 of the highest force, and the energy under it."""

    peak_n: float | None = None
    at_peak_m: float | None = None
    lowest_n: float | None = None
    at_lowest_m: float | None = None
    stiffness_n_per_m: float | None = None
    energy_j: float | None = None


@dataclass(frozen=True, eq=False)
class MeasuredBeside(Record):
    """A measured curve beside the computed one: by what shares of the measured numbers the computed ones are above."""

    measured: CurveReadings | None = one_of(CurveReadings)
    computed: CurveReadings | None = one_of(CurveReadings)
    in_cycles: bool = False
    compared_to_m: float | None = None
    peak_difference: float | None = None
    lowest_difference: float | None = None
    stiffness_difference: float | None = None
    energy_difference: float | None = None
    farthest_apart: float | None = None


@dataclass(frozen=True, eq=False)
class StandardResults(Record):
    """Results of a test by a standard: its strength, and the secant modulus at a third of the largest force."""

    test: str = ""
    area_m2: float | None = None
    strength_pa: float | None = None
    modulus_pa: float | None = None
    strain_at_third: float | None = None
