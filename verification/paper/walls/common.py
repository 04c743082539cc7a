"""Common parts of the experiments on wallettes: how their plates are held, a table of run results, their pictures."""

import math
from collections.abc import Iterable
from typing import Any

from masonry.judgement.doubts.motion.not_quasi_static import KINETIC
from masonry.laboratory.result import Result
from masonry.pictures.style import MEGA, MILLI
from verification.html import page
from verification.html.page import percent
from verification.paper.experiment import PERCENT, Claim, Done, Run, claim
from verification.paper.soundness import MISMATCH
from verification.paper.walls.crack_path import crack_path
from verification.paper.walls.curve_shape import apart, energy_per_section, left_after, peak_place

MODE_1, MODE_2 = "wallette-mode-1", "wallette-mode-2"
CLAMPED: dict[str, Any] = {"support.1.fix": ["y", "rotation"]}
HINGED: dict[str, Any] = {"support.1.fix": ["y"]}
"""The right plate moves along x: it does not turn, as mode 1 is shipped, or is on a hinge, as mode 2 is shipped."""
AFFINE: dict[str, Any] = {"kinematics": {"units": "affine"}}
PAPERS_RATE: dict[str, Any] = {"drive.rate": "1 mm/s"}
SHIPPED, HELD, HINGE, RATE = "as shipped", "plates do not turn", "right plate on a hinge", "1 mm/s"
"""Labels of runs."""
HEADER = (
    *("run", "peak [MPa]", "at [mm]", "left at twice that", "at the end [MPa]"),
    *("mode I [N/m]", "mode II [N/m]", "friction [N/m]", "broken: head joints", "units", "bed joints", "where [mm]"),
)
NOTE = (
    "Energies are for each square metre of the wall's section. Broken areas are over the section too, head joints and "
    "units as seen along the wall, bed joints as seen from below. Where: middle and spread along the wall of what "
    "is broken and open; 250 mm is its mid-length."
)


def quick_enough(runs: dict[str, Run], quick: bool) -> dict[str, Run]:
    """The runs; of a quick look those of mode 1 as shipped: at 2 % there are up to 3 % between the two ends."""
    first = [label for label, run in runs.items() if quick and run.scene.startswith(MODE_1) and not run.paced]
    return runs | {label: runs[label].at(PERCENT) for label in first}


def table_of_runs(done: Done, labels: Iterable[str]) -> list[str]:
    """Peak, energies and cracks of runs, one a row, and what the columns mean."""
    rows = [row_of(label, done[label]) for label in labels if done.has(label)]
    return [page.table(HEADER, rows), page.paragraph(NOTE, "note")]


def row_of(label: str, result: Result) -> list[str]:
    """The numbers of a run."""
    energy, crack = energy_per_section(result), crack_path(result)
    fractions = crack.fractions()
    return [
        label,
        f"{mpa(result):.4f}",
        f"{peak_place(result) * MILLI:.4f}",
        percent(left_after(result, 2.0)),
        f"{result.summary['final_stress_pa'] * MEGA:.4f}",
        *(f"{energy[name]:.1f}" for name in ("mode I", "mode II", "friction")),
        *(f"{fractions[name]:.2f}" for name in ("head joints", "units", "bed joints")),
        where(result),
    ]


def mpa(result: Result) -> float:
    """Peak in MPa."""
    return float(result.summary["peak_stress_pa"]) * MEGA


def where(result: Result) -> str:
    """Middle and spread of the crack in words, in mm."""
    try:
        middle, spread = crack_path(result).place()
    except ValueError:
        return "no open crack"
    return f"{middle * MILLI:.0f} ± {spread * MILLI:.0f}"


def crack_spread(result: Result) -> float:
    """Spread (m) along the wall of the crack; nan where nothing is open."""
    try:
        return crack_path(result).place()[1]
    except ValueError:
        return math.nan


def rate_claim(shipped: Result, constant: Result, source: str) -> Claim:
    """Whether the paper's constant rate is quasi-static, and how far it is from the accuracy shipped."""
    moved, difference = mpa(constant) / mpa(shipped) - 1.0, apart(constant, shipped)
    ends, kinetic = (constant.summary[key] for key in ("reaction_mismatch_max", "kinetic_over_internal_max"))
    return claim("A rate of 1 mm/s, in quasi-static analyses", f"2.1, {source}",
                 f"by what each run here is held to: ends within {percent(MISMATCH)} of the peak, kinetic energy < "
                 f"{percent(KINETIC)} of the internal one",
                 f"ends {percent(ends)}, kinetic {percent(kinetic)}. Beside the accuracy shipped: peak "
                 f"{100 * moved:+.2g} %, curve {percent(difference)} of the peak apart on average",
                 ends < MISMATCH and kinetic < KINETIC,
                 "the plate runs ahead of cracks that open fast, and its force is too high meanwhile")  # fmt: skip


def plates_claim(hinge: Result, held: Result, why: str) -> Claim:
    """Effect of plates that turn or do not, which the paper does not give."""
    dissipated = [energy_per_section(r)["fracture"] for r in (hinge, held)]
    ends = [float(r.summary["final_stress_pa"]) * MEGA for r in (hinge, held)]
    return claim("A displacement rate is set on one side of the wallette", "5",
                 "peak, end and energy with a right plate that is on a hinge, and with one that does not turn",
                 f"peak {mpa(hinge):.4f} and {mpa(held):.4f} MPa, at the end {ends[0]:.4f} and {ends[1]:.4f} MPa, "
                 f"curves {percent(apart(held, hinge))} of the peak apart on average; energy {dissipated[0]:.1f} and "
                 f"{dissipated[1]:.1f} N/m",
                 None, why)  # fmt: skip
