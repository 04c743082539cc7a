"""More and smaller blocks: an elastic bar of rigid blocks tends to the beam with h^2; a crack costs the same energy.

      ##|__|____|____|____|__|    rigid blocks of length h, half ones at the ends; joints kn = E/h, ks = kappa G/h
      ##| h/2  h   h    h  h/2    n joints, the midpoint rule: w = P L^3/(3 E I) (1 - 1/(4 n^2)) + P L/(kappa G A)

Timoshenko (1921) for n -> infinity. The second part tears a couplet of n x n x 1 blocks a unit: whatever n, the joint
that opens takes G for each unit of its area (linear law: the whole area under its curve).
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.scene_text import run as run_text
from verification.scene_runs import result_of

LENGTH, HEIGHT, WIDTH, MODULUS, STRESS = 1.0, 0.2, 0.1, 10e9, 1e4
SHEAR = 5 / 6 * MODULUS / 2
JOINTS = (2, 4, 8, 16)
DIVISIONS = (2, 3, 4)
ENERGY, TEAR = 20.0, "couplet-torn-apart"
BOX = '[[specimen.box]]\nname = "part {k}"\norigin = ["{x!r} m", "0 m", "0 m"]\nsize = ["{h!r} m", "{w} m", "{t} m"]\n'


def beam(joints: int) -> str:
    """The scene of a cantilever of rigid blocks."""
    h = LENGTH / joints
    cuts = np.concatenate([[0.0], h * (np.arange(joints) + 0.5), [LENGTH]])
    boxes = "".join(
        BOX.format(k=k, x=float(a), h=float(b - a), w=WIDTH, t=HEIGHT)
        for k, (a, b) in enumerate(zip(cuts[:-1], cuts[1:], strict=True))
    )
    return f"""
law = "elastic"
kinematics = "rigid"
[specimen]
kind = "boxes"
section = "{HEIGHT * WIDTH!r} m^2"
{boxes}
[material.units]
density = "2000 kg/m^3"
[contact.within_units]
normal_stiffness = "{MODULUS / h!r} Pa/m"
shear_stiffness = "{SHEAR / h!r} Pa/m"
[[support]]
on = "part 0"
fix = "all"
[[traction]]
on = "part {joints}.x+"
stress = {{ z = "{STRESS!r} Pa" }}
[settle]
steps = {5000 * joints}
[solver]
damping = 0.5
rows = 40
"""


def beams(findings: Findings) -> None:
    """The tip of each beam against its own sum, and the order against the beam of infinitely many."""
    force, second = STRESS * HEIGHT * WIDTH, WIDTH * HEIGHT**3 / 12
    bent, sheared = force * LENGTH**3 / (3 * MODULUS * second), force * LENGTH / (SHEAR * HEIGHT * WIDTH)
    tips = []
    for n in JOINTS:
        result = findings.note(f"{n} joints", run_text(beam(n)))
        end = np.abs(result.specimen.blocks.points[:, 0] - LENGTH) < 1e-9
        tips.append(float(result.history.frames[-1].corners[end, 2].mean()))
        tolerance = Tolerance(
            1e-12, 1e-14, "the sum is exact for rigid blocks; what is left is how far the run has come to rest"
        )
        quantity = f"deflection of a bar of {n} joints"
        findings.check(quantity, "m", tips[-1], bent * (1 - 0.25 / n**2) + sheared, tolerance)
    errors = np.abs(np.array(tips) / (bent + sheared) - 1)
    tolerance = Tolerance(
        1e-11,
        1e-12,
        "the midpoint rule of x^2 is in error by exactly 1/(4 n^2); rounding is multiplied by 1/error = 1000",
    )
    findings.check("order of the error in h", "1", np.log2(errors[-2] / errors[-1]), 2.0, tolerance)
    joints = np.array(JOINTS, dtype=float)
    findings.plot(
        "Error of the deflection",
        "joints (1)",
        "error (1)",
        Line("masonry", joints, errors, "points"),
        Line("1/(4 n^2)", joints, 0.25 / joints**2 * bent / (bent + sheared), "dashed"),
        log=True,
    )


def tears(findings: Findings) -> None:
    """Energy per area of the joint, for each division of the units."""
    for n in DIVISIONS:
        result = findings.note(f"{n} x {n} blocks a unit", result_of(TEAR, {"specimen.divisions": [n, n, 1]}))
        dissipated = float(result.summary["energy_j"]["fracture_mode_1"]) / float(result.summary["section_m2"])
        tolerance = Tolerance(
            1e-12, 1e-14, "the law books the area under its curve between two openings exactly, however far apart"
        )
        quantity = f"energy of the open joint per area, {n} x {n} blocks a unit"
        findings.check(quantity, "N/m", dissipated, ENERGY, tolerance)


def run() -> Findings:
    """Bars, then couplets."""
    findings = Findings()
    beams(findings)
    tears(findings)
    return findings


CASE = Case(
    name="refinement-of-blocks",
    row="A24",
    title="More and smaller blocks",
    area="Elastic assemblies",
    run=run,
    problems=("couplet", "wallette-mode-1"),
)
