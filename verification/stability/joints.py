"""Joints at their limits: stiffness, confinement, fracture energies down to and below the snap-back limit."""

from verification.references.closed_forms import Joint
from verification.scene_runs import joint_of
from verification.stability.cells import Grid, MapCell
from verification.stability.references import sheared, sheared_over_plastic_slip, torn
from verification.stability.scenes import COUPLET, JOINT, PAIR, Knobs, pascals, slid

LAWS = ("linear", "polynomial", "exponential", "brittle")
STEPS: Knobs = {"drive.steps": 5000, "solver.rows": 200}
PACED: Knobs = {"drive.accuracy": "1 %"}
"""The shipped pace; it replaces the steps."""
NO_SLOPE = {f"{JOINT}.fracture_energy_mode_2_slope": "0 N/m/MPa"}


def stiffnesses(full: bool) -> Grid:
    """Normal stiffness and its ratio to the shear stiffness."""
    normal = [10.0**k for k in range(6, 16)] if full else [1e6, 1e11, 1e15]
    ratios = [1.0, 10.0, 100.0, 1e3, 1e4] if full else [1.0, 1e4]
    cells = {}
    for ratio in ratios:
        for kn in normal:
            knobs = {**STEPS, **pascals(normal_stiffness=kn, shear_stiffness=kn / ratio)}
            cells[f"{ratio:g}", f"{kn:.0e}"] = MapCell(COUPLET, slid(COUPLET, knobs), sheared)
    note = "Below 1e9 Pa/m the confinement of 0.5 MPa closes the joint by more than 1 % of the block's height."
    return Grid("Stiffness of the joint", "kn/ks", "kn [Pa/m]", cells, note=note)


def confinements(full: bool) -> Grid:
    """Compression by law; the linear law with an energy that is enough for some of them only."""
    pressures = ["0 MPa", "0.1 MPa", "1 MPa", "10 MPa", "100 MPa"] if full else ["0 MPa", "100 MPa"]
    cells = {}
    for law in LAWS if full else LAWS[:1]:
        for pressure in pressures:
            cells[law, pressure] = shear_cell({"law": law}, pressure, ("OK", "WARNED"))
    for pressure in pressures:
        few = {"law": "linear", **NO_SLOPE}
        beyond = float(pressure.split()[0]) >= 10.0
        cells["linear, G_II without slope", pressure] = shear_cell(few, pressure, ("REFUSED",) if beyond else ("OK",))
        hidden = {**few, "traction.0.stress": {"z": f"-{pressure}"}}
        must = ("STOPPED",) if beyond else ("OK",)
        cells["as above, load not named", pressure] = shear_cell(hidden, pressure, must, named=False)
    note = (
        "With 58 N/m at all compressions the linear law snaps back above 7.1 MPa: refused where the scene calls the "
        "load its confinement, stopped where the run finds out."
    )
    return Grid("Confinement", "law", "compression", cells, note=note)


def shear_cell(knobs: Knobs, pressure: str, must: tuple[str, ...] = ("OK",), named: bool = True) -> MapCell:
    """The couplet sheared under a compression."""
    set_here = {**STEPS, **knobs, "confinement": pressure if named else "0 Pa"}
    return MapCell(COUPLET, slid(COUPLET, set_here, 1e6 * float(pressure.split()[0])), sheared, must)


RATIOS = (0.1, 0.5, 0.99, 1.01, 1.1, 2.0, 10.0, 100.0, 1e3, 1e4)


def energies_in_shear(full: bool) -> Grid:
    """Mode II energy over (peak - residual)^2/(2 ks) at 0.5 MPa."""
    cells = {}
    for law in LAWS[:3] if full else LAWS[:1]:
        for ratio in RATIOS if full else (0.5, 1.01, 1e4):
            joint = joint_of(COUPLET, {})
            limit = float(joint.peak(0.5e6) - joint.residual(0.5e6)) ** 2 / (2.0 * joint.ks)
            knobs = {"law": law, **STEPS, **NO_SLOPE, **pascals(fracture_energy_mode_2=ratio * limit)}
            must = ("REFUSED",) if law == "linear" and ratio < 1.0 else ("OK",)
            cells[law, f"{ratio:g}"] = MapCell(COUPLET, slid(COUPLET, knobs), sheared, must)
            if law == "exponential":
                cells[f"{law}, paced to 1 %", f"{ratio:g}"] = MapCell(COUPLET, paced(slid(COUPLET, knobs)), sheared)
    over_plastic_slip(cells, full, joint_of(COUPLET, {}), limit)
    note = (
        "Over the plastic slip the exponential law snaps back below c0 (peak - residual)/ks, 1.7 times the limit of "
        "the linear law here."
    )
    return Grid("Fracture energy in shear", "law", "G_II over the snap-back limit", cells, note=note)


def over_plastic_slip(cells: dict[tuple[str, str], MapCell], full: bool, joint: Joint, limit: float) -> None:
    """Add the row of the exponential law with the other softening variable."""
    least = joint.c0 * float(joint.peak(0.5e6) - joint.residual(0.5e6)) / joint.ks
    for ratio in RATIOS if full else ():
        knobs = {**STEPS, **NO_SLOPE, **pascals(fracture_energy_mode_2=ratio * limit)}
        knobs[f"{JOINT}.softening_variable"] = "plastic"
        must = ("REFUSED",) if ratio * limit <= least else ("OK",)
        place = "exponential, over plastic slip", f"{ratio:g}"
        cells[place] = MapCell(COUPLET, slid(COUPLET, knobs), sheared_over_plastic_slip, must)


PULL: Knobs = {**STEPS, "confinement": "0 Pa", "drive.direction": "z"}


def energies_in_tension(full: bool) -> Grid:
    """Mode I energy over f_t^2/(2 kn)."""
    joint = joint_of(PAIR, {})
    limit = joint.fT**2 / (2.0 * joint.kn)
    cells = {}
    for law in LAWS[:3] if full else LAWS[:1]:
        for ratio in RATIOS if full else (0.5, 1.01, 1e4):
            opened = joint.opening_at_peak + 8.0 * ratio * limit / joint.fT
            knobs = {"law": law, **PULL, "drive.displacement": f"{opened!r} m"}
            must = ("REFUSED",) if law == "linear" and ratio < 1.0 else ("OK",)
            knobs |= pascals(fracture_energy_mode_1=ratio * limit)
            cells[law, f"{ratio:g}"] = MapCell(PAIR, knobs, torn, must)
            if law == "exponential":
                cells[f"{law}, paced to 1 %", f"{ratio:g}"] = MapCell(PAIR, paced(knobs), torn)
    return Grid("Fracture energy in tension", "law", "G_I over the snap-back limit", cells)


def paced(knobs: Knobs) -> Knobs:
    """The same to an accuracy in place of a number of steps."""
    return {**{key: value for key, value in knobs.items() if key != "drive.steps"}, **PACED}


def brittle(full: bool) -> Grid:
    """Steps up to the peak of a contact that has no fracture energy at all."""
    cells = {}
    for steps in (100, 1000, 10000, 100000) if full else (1000,):
        common = {"law": "brittle", "solver.rows": 200, "drive.steps": steps}
        pull = {**PULL, **common, "drive.displacement": "10 um"}
        cells["tension", str(steps)] = MapCell(PAIR, pull, torn)
        cells["shear", str(steps)] = MapCell(COUPLET, {**common, "drive.displacement": "50 um"}, sheared)
    note = "The elastic energy goes in one step: it is booked to within half a step times the drop."
    return Grid("Brittle contacts", "mode", "steps of the drive", cells, note=note)


GRIDS = (stiffnesses, confinements, energies_in_shear, energies_in_tension, brittle)
