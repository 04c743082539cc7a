"""A block on its joint swings with each kind of damping of the table [damping]; the bound of the step, from both sides.

     |----|        v(0), mass m, stiffness k:   w^2 = k/m;   s^2 + a0 s + w^2 (1 + a1 s + sum r s T/(1 + s T)) = 0
     | m  |        damping ratio  zeta = -Re s/|s|;   logarithmic decrement  2 pi zeta/sqrt(1 - zeta^2)
     |____|        mass: a0/2w;  stiffness: a1 w/2;  Rayleigh: both;  Maxwell: as asked, within 4 % over a band
     ////// k      local: ln((1 + xi)/(1 - xi))/(2 pi)
     free fall     v = (g/a0) (1 - exp(-a0 t))
     bound         dt = (2/w) (sqrt(1 + z^2) - z),  z = a1 w/2: what swings at 0.99 of it dies away, at 1.01 it grows

Without damping the block swings for 1000 periods, and its energy stays.

Reference: by hand; roots of the polynomial.
"""

import numpy as np

from masonry.model.damping import flat_branches
from verification.case import Case, Findings, Tolerance
from verification.scene_runs import result_of

SCENE = "oscillator"
OMEGA = float(np.sqrt(1e9 * 0.04 / (2000.0 * 0.004)))
HERTZ = OMEGA / (2.0 * np.pi)
STEP, RATIO = 0.01 / OMEGA, 0.05


def between(low: float, high: float) -> list[str]:
    """Two frequencies (Hz) as a scene has them."""
    return [f"{low!r} Hz", f"{high!r} Hz"]


FLAT = RATIO, HERTZ / 3.0, 3.0 * HERTZ
KINDS: dict[str, tuple[dict, float]] = {
    "mass": ({"mass": f"{2.0 * RATIO * OMEGA!r} s^-1"}, RATIO),
    "stiffness": ({"stiffness": f"{2.0 * RATIO / OMEGA!r} s"}, RATIO),
    "rayleigh": (
        {"rayleigh": {"ratio": RATIO, "between": [f"{HERTZ / 2.0!r} Hz", f"{2.0 * HERTZ!r} Hz"]}},
        0.8 * RATIO,
    ),
    "local": ({"local": 0.157}, float(np.log(1.157 / 0.843) / (2.0 * np.pi))),
}
"""What the table says, and the ratio at the frequency of the block."""
ACCURACY: dict[str, tuple[float, float]] = {
    **{"mass": (4e-5, 1e-5), "rayleigh": (5e-4, 1e-4), "local": (2e-4, 5e-5)},
    **dict.fromkeys(("stiffness", "maxwell"), (1e-2, 3e-3)),
}
"""Tolerance and expected error: mass damping is of second order."""


def swinging(damping: dict, duration: float, **more: object) -> dict:
    """Keys of a block that is struck, without weight."""
    return {
        "gravity": None,
        "settle": None,
        "motion": [{"on": "block", "velocity": [0, 0, "1 mm/s"]}],
        "damping": damping,
        "solver.time_step": f"{STEP!r} s",
        "solver.duration": f"{duration!r} s",
        "solver.rows": 4000,
        "solver.frames": 1,
        **{f"solver.{key}": value for key, value in more.items()},
    }


def decrement(rows: dict[str, np.ndarray], count: int) -> float:
    """Logarithmic decrement of a whole swing, from the largest kinetic energies of so many half swings."""
    energy = rows["kinetic"][1:]
    k = np.flatnonzero((energy[1:-1] > energy[:-2]) & (energy[1:-1] >= energy[2:]))[:count] + 1
    before, now, after = energy[k - 1], energy[k], energy[k + 1]
    top = now - (before - after) ** 2 / (8.0 * (before - 2.0 * now + after))
    return float(-np.polyfit(np.arange(count), np.log(top), 1)[0])


def flat_ratio() -> float:
    """Of the block on Maxwell's branches: from the root that swings."""
    stiffer, relaxation = map(np.array, flat_branches(*FLAT))
    s = -RATIO + 1j
    for _ in range(200):
        x = s * OMEGA * relaxation
        s = 1j * np.sqrt(1.0 + (stiffer * x / (1.0 + x)).sum())
    return float(-s.real / abs(s))


def run() -> Findings:
    """Decrements; a fall; both sides of the bound; a thousand periods."""
    findings = Findings()
    kinds: dict[str, tuple[dict, float]] = KINDS | {
        "maxwell": ({"maxwell": {"ratio": RATIO, "between": between(*FLAT[1:])}}, flat_ratio())
    }
    for kind, (damping, ratio) in kinds.items():
        result = findings.note(kind, result_of(SCENE, swinging(damping, 10.0 / HERTZ)))
        wanted = 2.0 * np.pi * ratio / (1.0 if kind == "local" else np.sqrt(1.0 - ratio**2))
        tolerance = Tolerance(*ACCURACY[kind], "half a step of lag; local: where it turns")
        findings.check(f"logarithmic decrement, {kind}", "1", decrement(result.history.rows, 12), wanted, tolerance)
    falls(findings)
    bound(findings)
    result = findings.note(
        "1000 periods", result_of(SCENE, swinging({}, 1000.0 / HERTZ, time_step=f"{0.3 / OMEGA!r} s"))
    )
    energy = result.history.rows["kinetic"] + result.history.rows["elastic_contacts"]
    early, late = energy[1:400].mean(), energy[-400:].mean()
    reason = "leapfrog keeps v(n-1/2) m v(n+1/2)/2 + k x^2/2 but for rounding"
    findings.at_most("energy lost or won in 1000 periods", "1", abs(late / early - 1.0), 1e-6, reason)
    return findings


def falls(findings: Findings) -> None:
    """Under its weight, off its joint."""
    rate, g = 4.0, 9.81
    knobs = swinging({"mass": f"{rate!r} s^-1"}, 0.4, time_step="0.1 ms", slip_limit=1000.0) | {
        "gravity": {"z": f"-{g} m/s^2"},
        "settle": {"steps": 0},
        "motion": [],
        "contact.unit_unit.normal_stiffness": "1 Pa/m",
        "contact.unit_unit.shear_stiffness": "1 Pa/m",
    }
    rows = findings.note("free fall", result_of(SCENE, knobs)).history.rows
    speed = float(np.sqrt(2.0 * rows["kinetic"][-1] / 8.0))
    wanted = g / rate * (1.0 - np.exp(-rate * rows["time"][-1]))
    tolerance = Tolerance(5e-4, 2e-4, "half a step of 0.1 ms")
    findings.check("speed of a fall under mass damping", "m/s", speed, wanted, tolerance)


def bound(findings: Findings) -> None:
    """Energy that is left after 60 steps on both sides of the bound, z = 1."""
    limit, share = float(2.0 / OMEGA * (np.sqrt(2.0) - 1.0)), {}
    for side in (0.99, 1.01):
        knobs = swinging({"stiffness": f"{2.0 / OMEGA!r} s"}, 60 * side * limit, time_step=f"{side * limit!r} s")
        result = findings.note(f"{side:g} of the bound", result_of(SCENE, knobs))
        kinetic = result.history.rows["kinetic"]
        share[side] = float(np.abs(kinetic[-1] / kinetic[1]))
    why = "the root at the bound is -1; 1 % off it is 0.029 more or less, in 60 steps"
    findings.at_most("energy left at 0.99 of the bound, over that at first", "1", share[0.99], 0.1, why)
    findings.at_most("energy at first over that left, at 1.01 of the bound", "1", 1.0 / share[1.01], 0.1, why)


CASE = Case(
    name="damping-of-a-swing",
    row="A58",
    title="A block that swings with each kind of damping",
    area="Dynamics",
    run=run,
    scene=SCENE,
    no_problems="closed forms of one swing: error against run time is that of the oscillator",
)
