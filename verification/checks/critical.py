"""The critical step of a stack of three blocks: stiffness, bound, and what happens on both sides of the limit."""

from collections.abc import Sequence

import numpy as np

from masonry.configuration.energy import present
from masonry.model.model import Model, Stepping
from verification.case import Findings, Tolerance
from verification.checks.free_motion import follow, glued
from verification.fixtures import assembled, models, shapes

BELOW, ABOVE = 0.99, 1.05
SKEW = np.array([[1.0, 0.3, 0.2], [0.1, 1.0, -0.2], [0.0, 0.15, 0.9]])
STEPS, EVERY = 100_000, 97


def stack(kinds: Sequence[str], damping: float = 0.0, dt: float | None = None) -> Model:
    """Three skewed blocks, the lowest held; at the proven bound unless a step (s) is given."""
    blocks = shapes.skewed(shapes.stack([0.06, 0.05, 0.08]), SKEW)
    setup = shapes.setup(blocks, kinds, mesh_size=0.1)
    stepping = Stepping("real", dt or "gershgorin", damping=damping, step_fraction=1.0)
    return models.make(setup, glued(2e11, 8e10), stepping, [models.everything(0)])


def kinetic(model: Model) -> float:
    """Half the sum of masses times squared velocities (J)."""
    return 0.5 * sum(float(np.sum(model.masses[kind] * body.v**2)) for kind, body in present(model))


def study(findings: Findings, kinds: Sequence[str], words: str) -> None:
    """All checks of one stack."""
    model = stack(kinds)
    matrix = assembled.stiffness(model, models.STONE)
    random = np.random.default_rng(1).normal(size=matrix.shape[0]) * models.free(model) * 1e-6
    force, wanted = models.forces(model, random), -(matrix @ random) * models.free(model)
    omega, mode = assembled.fastest(model, matrix)
    limit, same = 2.0 / omega, "same discretisation"
    tolerance = Tolerance(1e-12, 1e-15, "sums over contacts and elements: rounding", same)
    quantity = f"{words}: forces against K u, largest deviation"
    findings.check(quantity, "N", np.abs(force - wanted).max(), 0.0, tolerance, scale=np.abs(wanted).max())
    reason = "Gershgorin's bound is never above the limit, but for rounding"
    findings.at_most(f"{words}: proven bound over 2/w_max", "1", model.bound / limit, 1.0 + 1e-12, reason)
    damped = stack(kinds, 0.8)
    tolerance = Tolerance(1e-12, 1e-15, "1/sqrt(1 + xi): rounding")
    value = damped.bound / model.bound
    findings.check(f"{words}: bound at xi = 0.8 over that without damping", "1", value, 1.8**-0.5, tolerance)
    findings.remarks.append(f"{words}: the proven bound is {model.bound / limit:.2f} of the limit 2/w_max")
    _below(findings, kinds, words, BELOW * limit, mode)
    for damping in (0.0, 0.8):
        _above(findings, kinds, words, damping, ABOVE * limit / np.sqrt(1.0 + damping), mode)


def _below(findings: Findings, kinds: Sequence[str], words: str, dt: float, mode: np.ndarray) -> None:
    """1e5 steps of the fastest mode at 0.99 of the limit: v(n+1/2) = v0 cos((n + 1/2) a)/cos(a/2), sin(a/2) = 0.99."""
    model = stack(kinds, dt=dt)
    models.put(model, {kind: body.v for kind, body in present(model)}, 1e-6 * mode)
    name = f"{words}, {BELOW:g} of the limit"
    seen = follow(findings, name, model, STEPS, lambda m: np.array(kinetic(m)), EVERY, rows=100)
    tolerance = Tolerance(
        1e-4, 1e-5, "1/cos^2(a/2), looked for at 1000 phases of the mode: (pi/1000)^2, times 10 for uneven ones"
    )
    quantity = f"{words}: largest kinetic energy in 1e5 steps at {BELOW:g} of the limit, over the first"
    findings.check(quantity, "1", seen.max() / seen[0], 1.0 / (1.0 - BELOW**2), tolerance)


def _above(findings: Findings, kinds: Sequence[str], words: str, damping: float, dt: float, mode: np.ndarray) -> None:
    """Growth a step of the fastest mode at 1.05 of the limit: exp(2 acosh(1.05)); damping then works like stiffness."""
    model = stack(kinds, damping, dt)
    models.put(model, {kind: body.v for kind, body in present(model)}, 1e-20 * mode)
    models.march(model, 20)
    early = kinetic(model)
    models.march(model, 40)
    grown = 0.5 * float(np.log(kinetic(model) / early)) / 40
    tolerance = Tolerance(
        3e-12,
        3e-13,
        "the mode's own factor; what decays of the others is exp(-0.63 * 40) = 1e-11 by then, over 40 steps",
    )
    quantity = f"{words}: growth a step at {ABOVE:g} of the limit, xi = {damping:g}"
    findings.check(quantity, "1", grown, 2.0 * float(np.arccosh(ABOVE)), tolerance)
