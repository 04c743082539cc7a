"""Input that nobody can mean: refused, with the key; and numbers that are merely absurd: refused or right."""

from verification.stability.cells import Grid, MapCell
from verification.stability.references import sheared
from verification.stability.scenes import COUPLET, JOINT, Knobs

FAST: Knobs = {"drive.steps": 2000, "settle.steps": 1000, "solver.rows": 100}
NUMBERS = {"zero": "0", "negative": "-1", "NaN": "nan", "infinite": "inf", "1e300": "1e300", "1e-300": "1e-300"}
KEYS = {
    "normal_stiffness": "Pa/m",
    "shear_stiffness": "Pa/m",
    "tensile_strength": "Pa",
    "cohesion": "Pa",
    "tan_friction_angle": "",
    "residual_cohesion": "Pa",
    "fracture_energy_mode_1": "N/m",
    "fracture_energy_mode_2": "N/m",
    "fracture_energy_mode_2_slope": "m",
    "dilation_angle": "deg",
}
OTHERS = {
    "confinement": "Pa",
    "material.units.density": "kg/m^3",
    "specimen.length": "m",
    "drive.displacement": "m",
    "drive.steps": "",
    "settle.steps": "",
    "solver.damping": "",
    "solver.step_fraction": "",
}
MAY_BE_ZERO = ("strength", "cohesion", "friction_angle", "slope", "dilation_angle", "confinement", "damping")


def numbers(full: bool) -> Grid:
    """Every number of the couplet set to what it cannot be."""
    keys = {**{f"{JOINT}.{key}": unit for key, unit in KEYS.items()}, **OTHERS}
    chosen = keys if full else {key: keys[key] for key in (f"{JOINT}.normal_stiffness", "solver.damping")}
    cells = {}
    for key, unit in chosen.items():
        for column, text in NUMBERS.items():
            if not full and column == "1e-300":
                continue
            value = f"{text} {unit}" if unit else float(text)
            impossible = column in ("negative", "NaN", "infinite") or (
                column == "zero" and not key.endswith(MAY_BE_ZERO)
            )
            must = ("REFUSED",) if impossible else ()
            cells[key.removeprefix(f"{JOINT}."), column] = MapCell(COUPLET, {**FAST, key: value}, sheared, must)
        wrong = {**FAST, key: "1 K"}
        cells[key.removeprefix(f"{JOINT}."), "wrong unit"] = MapCell(COUPLET, wrong, sheared, ("REFUSED",))
    return Grid("Input that cannot be meant", "key", "value", cells)


CONTRADICTIONS: dict[str, Knobs] = {
    "residual cohesion above cohesion": {f"{JOINT}.residual_cohesion": "1 MPa"},
    "residual friction above friction": {f"{JOINT}.tan_residual_friction_angle": 1.2},
    "dilation above residual friction": {f"{JOINT}.dilation_angle": "60 deg"},
    "exponent of 1": {"law": "polynomial", f"{JOINT}.exponent_tension": 1.0},
    "Poisson's ratio of 0.5": {"material.units.poisson_ratio": 0.5},
    "a support on nothing": {"support.0.on": "nowhere"},
    "a drive on what is held": {"drive.on": "bottom"},
    "damping of 1": {"solver.damping": 1.0},
    "an unknown key": {f"{JOINT}.cohesoin": "1 MPa"},
    "equation (11) with scaled masses": {"solver.time_step": "equation-11"},
    "1e9 blocks": {"specimen.divisions": [1000, 1000, 1000]},
}


def contradictions(full: bool) -> Grid:
    """Input that contradicts itself or leads nowhere."""
    cells = {(row, ""): MapCell(COUPLET, knobs, sheared, ("REFUSED",)) for row, knobs in CONTRADICTIONS.items()}
    return Grid("Input that contradicts itself", "what", "", cells)


GRIDS = (numbers, contradictions)
