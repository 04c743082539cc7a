"""A small wall in which every term of the energy ledger is at work, and what is asked of the ledger."""

from collections.abc import Sequence

import numpy as np

from masonry.laboratory.result import Result
from masonry.monitors import energy
from verification import balance
from verification.case import Findings, Line
from verification.fixtures.scene_text import assembled

TERMS = ("elastic_blocks", "elastic_contacts", "fracture_mode_1", "fracture_mode_2", "friction", "damping", "kinetic")

CONTACT = """law = "{law}"
normal_stiffness = "150 GPa/m"
shear_stiffness = "70 GPa/m"
tensile_strength = "0.2 MPa"
cohesion = "0.3 MPa"
tan_friction_angle = 0.9
residual_cohesion = "0.01 MPa"
tan_residual_friction_angle = 0.6
fracture_energy_mode_1 = "5 N/m"
fracture_energy_mode_2 = "40 N/m"
fracture_energy_mode_2_slope = "130 N/m/MPa"
exponent_tension = 3.0
exponent_shear = 2.5
{more}
"""
MATERIAL = 'density = "1900 kg/m^3"\nyoung_modulus = "5 GPa"\npoisson_ratio = 0.2\n'
CORNERS = ((0.0, 0.0, "hard"), (0.2, 0.0, "fine"), (0.1, 0.08, "soft"), (0.3, 0.08, "fine"), (0.1, 0.16, "soft"))
PAIRS = ("fine_hard", "hard_soft", "fine_soft", "fine_fine", "soft_soft")


def scene_of(kinematics: str, law: str, solver: str, finer: int = 1, more: str = "", one_group: bool = False) -> str:
    """Five blocks in running bond, the lower two held: weight, tractions, and the top block pushed along x.

    finer      as many steps more
    one_group  all blocks and contacts are of one group
    """
    groups = ["units" if one_group else group for *_, group in CORNERS]
    pairs = ("unit_unit",) if one_group else PAIRS
    boxes = ",\n  ".join(
        f'{{name = "b{k}", origin = ["{x} m", "0 m", "{z} m"], size = ["0.2 m", "0.1 m", "0.08 m"], '
        f'group = "{group}", unit = {k}}}'
        for k, ((x, z, _), group) in enumerate(zip(CORNERS, groups, strict=True))
    )
    contact = CONTACT.format(law=law, more=more)
    return (
        f'kinematics = {kinematics}\n[specimen]\nkind = "boxes"\nsection = "0.02 m^2"\nmesh_size = "90 mm"\n'
        f"box = [\n  {boxes}\n]\n"
        + "".join(f"[material.{group}]\n{MATERIAL}" for group in dict.fromkeys(groups))
        + "".join(f"[contact.{pair}]\n{contact}" for pair in pairs)
        + '[[support]]\non = "b0"\nfix = "all"\n[[support]]\non = "b1"\nfix = ["x", "y", "z", "rotation"]\n'
        + f'[drive]\non = "b4"\ndirection = "x"\ndisplacement = "0.1 mm"\nsteps = {3000 * finer}\n'
        + '[[traction]]\non = "b3.z+"\nstress = {x = "2 kPa", z = "-0.1 MPa"}\n'
        + '[[traction]]\non = "b4.z+"\nstress = {z = "-0.3 MPa"}\n'
        + f'[gravity]\nz = "-9.81 m/s^2"\ny = "1 m/s^2"\n[settle]\nsteps = {800 * finer}\n'
        + f"[solver]\nrows = 200\nrotation_limit = 1.0\n{solver}\n"
    )


def identity(findings: Findings, words: str, result: Result, absent: tuple[str, ...] = ()) -> None:
    """The balance at every row, which of its terms are on, and that no dissipation is ever given back."""
    findings.note(words, result)
    rows = result.history.rows
    work = float(np.abs(rows["external_work"]).max())
    on = sum(float(np.abs(rows[term]).max()) > 1e-6 * work for term in TERMS)
    fall = min(float(np.diff(rows[key]).min()) for key in ("fracture_mode_1", "fracture_mode_2", "friction", "damping"))
    findings.check(f"{words}: balance of all terms, largest at any row", "J",
                   float(np.abs(balance.residual(rows)).max()), 0.0, "closed form", 1e-12, 1e-15,
                   "an identity of leapfrog with trapezoids: rounding", work)  # fmt: skip
    findings.check(f"{words}: terms that are on", "1", on, len(TERMS) - len(absent), "closed form", 1e-14, 0.0,
                   "more than 1e-6 of the external work, else the scene shows nothing")  # fmt: skip
    findings.check(f"{words}: dissipation and damping never fall, largest fall", "J", min(fall, 0.0), 0.0,
                   "closed form", 1e-12, 1e-15, "rounding of sums", work)  # fmt: skip
    lines = tuple(Line(t.replace("_", " "), 1e3 * rows["time"], rows[t]) for t in (*TERMS, "external_work"))
    findings.plot(f"Energies, {words}", "time (ms)", "energy (J)", *lines)


def planted(findings: Findings, text: str) -> None:
    """A joule put into each of the works that a ledger sums up must be missing in the program's own balance."""
    model = assembled(text).model
    moving = next(body for body in model.bodies if body is not None)
    for column, name in enumerate(("contacts", "damping", "external")):
        view, still = energy.observe(model), energy.velocities(model)
        before = energy.ledger(model, view, still)["imbalance"]
        moving.work[0, column] += 1.0
        after = energy.ledger(model, view, still)["imbalance"]
        findings.check(f"a joule planted in the work of {name} shows as imbalance", "J", after - before, 1.0,
                       "closed form", 1e-12, 1e-15, "a sum of a few numbers: rounding")  # fmt: skip


def two_sums(findings: Findings, words: str, runs: Sequence[Result], expected: float) -> None:
    """What the laws book as spent against the work taken less the energy stored: equal as the step,
    halved from the first run to the second, vanishes; `expected` is their difference over the first at the finer step.
    """
    off = [balance.mismatch(result) for result in runs]
    findings.check(f"{words}: the two sums of the dissipation, over the first", "1", off[1], 0.0, "closed form",
                   3.0 * expected, expected, "of first order in the step, by what a contact slips in one",
                   1.0)  # fmt: skip
    findings.check(f"{words}: order of their difference in dt", "1", float(np.log2(off[0] / off[1])), 1.0,
                   "closed form", 0.2, 0.05, "each contact starts to soften somewhere in a step, so the constant "
                   "varies")  # fmt: skip
