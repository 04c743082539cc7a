"""Large displacement in real time: what the time step costs and what it is wrong by, and what soft joints change.

    brick in flight   spin about its middle axis, almost: energy of the spin, which exact motion keeps; second order
    bounce            speed after over before an impact on springs and dashpots (dry_blocks.restitution); first order,
                      as dashpots act on velocities half a step old
    slide             speed down a plane of 20 deg with a friction of 0.2, after 0.2 s: g (sin - mu cos) t
    rocking           energy of motion 0.3 s after a slender block is let go, before it hits:
                      m g R (cos(alpha/2) - cos(alpha - th)),  R th'' = -3/4 g sin(alpha - th)

The last two have rigid ground in their closed forms: what is left with the smallest step falls with the stiffness.
"""

from math import atan, cos, hypot, radians, sin
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from verification.fixtures.dry_blocks import DENSITY, G, block, box, leaning, restitution, slab
from verification.problem import Problem, Refinement, fractions
from verification.scene_runs import SceneRun

STEP, STIFFNESS, SKIN = "time step", "model: normal stiffness", "skin"
ZETA, SLOPE, FRICTION, SLID = 0.2, 20.0, 0.2, 0.2
"""Of the critical dashpot; deg; tan of the angle of friction; s."""
SPIN = np.array([0.1, 10.0, 0.1])
HALF, HIGH, THICK, ROCKED = 0.125, 0.5, 0.5, 0.3
"""m, half sizes of the block that rocks, and its thickness; s."""


def at_the_end(one: SceneRun) -> float:
    """Energy of motion (J)."""
    return float(one.rows["kinetic"][-1])


def rebound(one: SceneRun) -> dict[str, float]:
    """Ratio of the energies of motion after and before, as a ratio of speeds."""
    return {"restitution": float(np.sqrt(at_the_end(one) / one.rows["kinetic"][1]))}


def spin_energy(_: SceneRun) -> dict[str, float]:
    """Of the brick as it was let go."""
    size = np.array([0.24, 0.115, 0.06])
    inertia = DENSITY * size.prod() * (size @ size - size**2) / 12.0
    return {"energy of spin": float(0.5 * inertia @ SPIN**2)}


def slid(_: SceneRun) -> dict[str, float]:
    """m/s, after its time."""
    return {"speed": G * (sin(radians(SLOPE)) - FRICTION * cos(radians(SLOPE))) * SLID}


def rocked(_: SceneRun) -> dict[str, float]:
    """From the angle by quadrature."""
    radius, slender = hypot(HALF, HIGH), atan(HALF / HIGH)
    start = [0.5 * slender, 0.0]
    solution = solve_ivp(lambda _, s: [s[1], -0.75 * G / radius * sin(slender - s[0])], (0.0, ROCKED), start,
                      rtol=1e-12, atol=1e-14)  # fmt: skip
    fallen = radius * (cos(0.5 * slender) - cos(slender - solution.y[0, -1]))
    return {"energy of motion": DENSITY * THICK * 4.0 * HALF * HIGH * G * fallen}


def stiffnesses(group: str) -> Refinement:
    """Joints from soft to stiff."""
    return {
        f"{kn:g} GPa/m": {
            f"contact.{group}.normal_stiffness": f"{kn} GPa/m",
            f"contact.{group}.shear_stiffness": f"{0.5 * kn} GPa/m",
        }
        for kn in (1, 10, 100, 1000)
    }


def steps(**keys: Any) -> Refinement:
    """Fractions of the proven step, each half of the one before."""
    return fractions(keys, 0.9, 0.45, 0.225, 0.1125)


def skins() -> Refinement:
    """Widths within which neighbours are found, each half of the one before, with a fine step: nothing may change."""
    return {f"{share:g}": {"solver.skin": share, "solver.step_fraction": 0.1125} for share in (0.16, 0.08, 0.04, 0.02)}


USUAL: dict[str, Any] = {"solver.rows": 20, "solver.frames": 2}
BOUNCING = {
    "specimen.box": [slab(), box("block", (-0.05, -0.1, 0.02), (0.1, 0.2, 0.1), 1)],
    "contact.unit_unit.normal_dashpot": ZETA,
    "gravity": None,
    "settle": None,
    "motion": [{"on": "block", "velocity": [0, 0, "-1 m/s"]}],
    "solver.duration": "0.04 s",
}
SLIDING = {
    "specimen.box": block(0.07, 0.05),
    "contact.unit_unit.tan_friction_angle": FRICTION,
    "solver.duration": f"{SLID} s",
    **leaning(SLOPE),
}
WEIGHT = DENSITY * 0.14 * 0.1 * 0.2
"""kg, of the block that slides."""
PROBLEMS = (
    Problem(
        *("brick-in-flight", "A brick that spins in free flight", "brick-in-flight"),
        {STEP: {f"{2000 * n} steps": {"solver.time_step": f"{1e-3 / n!r} s"} for n in (2, 4, 8, 16)}},
        USUAL | {"gravity": None, "settle": None},
        measure=lambda one: {"energy of spin": at_the_end(one)},
        exact=spin_energy,
        units={"energy of spin": "J"},
        shipped=("", ""),
    ),
    Problem(
        *("bounce", "A block that bounces on springs and dashpots", "dry-block"),
        {STEP: steps(), SKIN: skins()},
        USUAL | BOUNCING,
        measure=rebound,
        exact=lambda _: {"restitution": restitution(ZETA)},
        units={"restitution": "1"},
        shipped=(STEP, "0.9"),
    ),
    Problem(
        *("slide", "A block that slides down a plane", "dry-block"),
        {STEP: steps(), SKIN: skins(), STIFFNESS: stiffnesses("unit_unit")},
        USUAL | SLIDING,
        measure=lambda one: {"speed": float(np.sqrt(2.0 * at_the_end(one) / WEIGHT))},
        exact=slid,
        units={"speed": "m/s"},
        shipped=(STEP, "0.9"),
    ),
    Problem(
        *("rocking", "A slender block that rocks about its edge", "block-rocking"),
        {STEP: steps(), SKIN: skins(), STIFFNESS: stiffnesses("floor_units")},
        USUAL | {"solver.duration": f"{ROCKED} s"},
        measure=lambda one: {"energy of motion": at_the_end(one)},
        exact=rocked,
        units={"energy of motion": "J"},
        shipped=(STEP, "0.9"),
        dear=True,
    ),
)
