"""The tables of the stability study: which knobs go to which limit, on which scene."""

from dataclasses import dataclass
from typing import Any

FRACTIONS = (0.3, 0.6, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4, 1.6, 2.0)
REAL = {"solver.masses": "real", "drive.steps": 20000}
PULL = {"drive.displacement": "0.1 mm", "drive.rate": "1 mm/s", "solver.rows": 200}
EVEN = {"drive.displacement": "0.1 mm", "drive.steps": 12000, "solver.rows": 200}


@dataclass
class Grid:
    """One coloured table: rows and columns of knobs, all on one scene."""

    title: str
    case: str
    base: dict[str, Any]
    columns: dict[str, dict[str, Any]]
    rows: dict[str, dict[str, Any]]
    closed: bool = False


def stiffnesses(key: str, base: float, ratios: tuple[float, ...]) -> dict[str, dict[str, Any]]:
    """Knobs that set a stiffness to multiples of a base (Pa/m)."""
    return {f"{ratio:g}": {key: f"{ratio * base:g} Pa/m"} for ratio in ratios}


def grids() -> list[Grid]:
    """The tables of the chapter."""
    fractions = {f"{f:g}": {"solver.step_fraction": f} for f in FRACTIONS}
    damping = {"damping 0.8": {}, "damping 0": {"solver.damping": 0}}
    paper = {"solver.masses": "real"}
    rates = {f"x{f:g}": f for f in (1, 10, 100, 1000)}
    within = {
        f"contact.within_units.{key}": value
        for key, value in (("normal_stiffness", 167e9), ("shear_stiffness", 69.6e9))
    }
    ratios = (0.1, 1.0, 10.0, 100.0)
    units = {f"{r:g}": {key: f"{r * value:g} Pa/m" for key, value in within.items()} for r in ratios}
    return [
        Grid("Couplet, real masses: time step over the proven bound", "couplet", REAL, fractions, damping, True),
        Grid("Wallette, scaled masses: time step over the proven bound", "wallette-mode-1", PULL, fractions, damping),
        Grid(
            "Couplet, real masses: normal over shear stiffness of the joint",
            "couplet",
            REAL,
            stiffnesses("contact.unit_unit.normal_stiffness", 70e9, (0.01, 1.0, 100.0, 1e4, 1e6)),
            {"damping 0.8": {}},
            True,
        ),
        Grid(
            "Wallette, scaled masses: stiffness within the units over that of the joints",
            "wallette-mode-1",
            EVEN,
            units,
            {"damping 0.8": {}},
        ),
        Grid(
            "Couplet, real masses: rate over the paper's 0.1 mm/s",
            "couplet",
            paper,
            {label: {"drive.rate": f"{0.1 * f:g} mm/s"} for label, f in rates.items()},
            damping,
            True,
        ),
        Grid(
            "Wallette, scaled masses, whole test: rate over the paper's 1 mm/s",
            "wallette-mode-1",
            {},
            {label: {"drive.rate": f"{f:g} mm/s"} for label, f in rates.items()},
            {"damping 0.8": {}},
        ),
        Grid(
            "Impossible requests, which must be refused with a reason",
            "couplet",
            {},
            {"": {}},
            {
                "mode II energy that snaps back": {
                    "law": "linear",
                    "contact.unit_unit.fracture_energy_mode_2": "1 N/m",
                    "contact.unit_unit.fracture_energy_mode_2_slope": "0 N/m/MPa",
                },
                "stiffness not a number": {"contact.unit_unit.normal_stiffness": "nan Pa/m"},
                "negative cohesion": {"contact.unit_unit.cohesion": "-1 MPa"},
                "damping 1": {"solver.damping": 1.0},
                "step fraction 0": {"solver.step_fraction": 0},
                "a support on nothing": {"support.0.on": "nowhere"},
            },
        ),
    ]
