"""Modes of a stack of rigid blocks on elastic joints, and how it swings when it is let go in one of them.

     | b | h   up and down, n masses on n springs: w = 2 sqrt(k/m) sin((2 j - 1) pi/(4 n + 2))
     |---|     sideways, shear and rocking: zeros of a product of transfer matrices (Myklestad, 1944)
     |   |     many blocks: a Timoshenko beam that starts half a joint below the masses
     |---|     a run that starts at the velocities of a mode returns at its frequency
     |   |
    //////

Frequencies come from the square of a sum of strains and lose no digit; what the beam leaves is of second order in h.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from masonry.modal_analysis.vibration import ModesSettings, analyse
from verification.case import Case, Findings, Line, Tolerance
from verification.references.swinging_stack import STACK, Stack, keys_of, set_off
from verification.scene_runs import load, result_of

TALL = replace(STACK, count=40)
PERIODS, SPEED = 3.0, 1e-4
KIND = "closed form"


def along(stack: Stack, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Hz of the modes of a stack that move along x, and of those along z, by their effective masses."""
    modes = analyse(load("stack", keys_of(stack)), ModesSettings(count))
    return modes.frequencies[modes.share[:, 0] > 1e-6], modes.frequencies[modes.share[:, 2] > 1e-6]


class FreeSwing(NamedTuple):
    """Hz of a mode, of the leapfrog for it, and of a run that starts in it; its time (s), how far the top moves (m)."""

    mode: float
    leapfrog: float
    run: float
    time: np.ndarray
    moved: np.ndarray

    @property
    def fast(self) -> float:
        """Share by which the leapfrog is ahead."""
        return self.leapfrog / self.mode - 1.0


def swing(findings: Findings, number: int) -> FreeSwing:
    """A run that starts in a mode that moves along x."""
    modes = analyse(load("stack", keys_of(STACK)), ModesSettings(24))
    which = np.flatnonzero(modes.share[:, 0] > 1e-6)[number]
    rows = modes.shapes[which]["rigid"][1:]
    rows = SPEED * rows / np.abs(rows[:, 0]).max()
    frequency = float(modes.frequencies[which])
    keys = keys_of(STACK) | {
        "motion": set_off(STACK, rows[:, 0], rows[:, 4]),
        "solver.duration": f"{PERIODS / frequency!r} s",
        "gauge": [{"name": "top", "at": f"block {STACK.count}", "direction": "x"}],
    }
    result = result_of("stack", keys)
    findings.note(f"swing in mode {number + 1}", result)
    time, moved = result.history.rows["time"], result.history.rows["top"]

    def gap(guess: np.ndarray) -> np.ndarray:
        return np.asarray(guess[0] * np.sin(2.0 * np.pi * guess[1] * frequency * time + guess[2]) - moved / size)

    size = float(np.abs(moved).max())
    fit = least_squares(gap, [1.0, 1.001, 0.0], xtol=1e-14, ftol=1e-14, gtol=1e-14)
    half = 0.5 * float(result.summary["time_step_s"])
    leapfrog = float(np.arcsin(2.0 * np.pi * frequency * half) / (2.0 * np.pi * half))
    return FreeSwing(frequency, leapfrog, float(fit.x[1]) * frequency, time, moved)


def run() -> Findings:
    """Frequencies of a short stack and a tall one; free swings of the short one."""
    findings = Findings()
    sideways, upright = along(STACK, 24)
    for name, values, known in (
        ("sideways", sideways, STACK.sideways(3)),
        ("up and down", upright, STACK.up_and_down()[:3]),
    ):
        for k in range(3):
            findings.check(f"frequency {k + 1} {name}", "Hz", values[k], known[k], Tolerance(1e-11, 1e-12, "rounding"))
    tall, _ = along(TALL, 16)
    for k, (value, known_hz) in enumerate(zip(tall[:3], TALL.beam(3), strict=True)):
        tolerance = Tolerance(1e-3, 3e-4, "blocks in place of a beam: of second order in their height")
        findings.check(f"frequency {k + 1} of {TALL.count} blocks and of the beam", "Hz", value, known_hz, tolerance)
    for k in range(3):
        free = swing(findings, k)
        tolerance = Tolerance(3.0 * free.fast, free.fast, "the leapfrog is fast by (w dt)^2/24", "same discretisation")
        findings.check(f"frequency of a free swing in mode {k + 1}", "Hz", free.run, free.mode, tolerance)
        tolerance = Tolerance(1e-11, 1e-12, "rounding", "same discretisation")
        quantity = f"the same with the leapfrog's own frequency, mode {k + 1}"
        findings.check(quantity, "Hz", free.run, free.leapfrog, tolerance)
        if k == 0:
            findings.plot("Swing in mode 1", "time (ms)", "displacement of the top (um)",
                          Line("run", 1e3 * free.time, 1e6 * free.moved))  # fmt: skip
    return findings


CASE = Case(
    "modes-of-a-stack",
    "A44",
    "Modes of a stack of blocks, and its free swing",
    area="Dynamics",
    run=run,
    quick=True,
    scene="stack",
    no_problems="a stack of rigid blocks has no size to choose; the run's step is bound by its stiffest joint",
)
