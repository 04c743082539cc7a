"""Weights and tractions on blocks of each kind: what the joints below carry, what the loads have done, what is stored.

         | q          a column of two blocks on a held one, its own weight and an oblique traction q on top;
       __v__          the loads act in full from the start, and all comes to rest with damping
      |  2  |
      |-----|  N2 = q A - W2               settling of rigid blocks: u1 = N1/(kn A), u2 = u1 + N2/(kn A)
      |  1  |                              affine blocks besides, nu = 0: their own shortening by the mean stress,
      |-----|  N1 = q A - W1 - W2                                        (q A - weight above - half their own)/(E A)
      |/////|
                                           work of the loads = sum of W u + q A u(top), and twice what is stored

Reference: statics; Clapeyron.
"""

import numpy as np

from masonry.configuration import energy
from masonry.model.layout import Material
from masonry.model.loads import Push
from masonry.model.model import Model, Stepping
from masonry.monitors.settling import unbalanced
from verification import balance
from verification.case import Case, Findings, Tolerance
from verification.checks.free_motion import glued
from verification.fixtures import models, shapes

KN, KS, GRAVITY = 2e9, 8e8, np.array([1.0, -2.0, -9.81])
YOUNG = 5e8
STONE = Material(density=1900.0, young_modulus=YOUNG, poisson_ratio=0.0)
SIDES, HEIGHTS = (0.2, 0.1), (0.05, 0.06, 0.08)
AREA = SIDES[0] * SIDES[1]
TRACTION = np.array([1e3, -5e2, -2e4])
WEIGHTS = STONE.density * AREA * np.outer(HEIGHTS[1:], GRAVITY)
STEPS = 6000
STATICS = Tolerance(1e-12, 1e-13, "statics: rounding, and how far all has come to rest")


def column(kind: str, load_factor: np.ndarray) -> Model:
    """Three blocks, the lowest held, under a `load_factor` (3,) of each component of both loads; not yet moved."""
    setup = shapes.setup(shapes.stack(HEIGHTS, SIDES), ["rigid", kind, kind], mesh_size=0.06)
    count = len(setup.blocks.face_start) - 1
    level = np.array([setup.blocks.face(f)[:, 2].min() for f in range(count)])
    top = Push(np.flatnonzero(np.isclose(level, sum(HEIGHTS))), load_factor * TRACTION)
    stepping = Stepping("scaled", damping=0.8)
    return models.make(setup, glued(KN, KS), stepping, [models.everything(0)], [top], load_factor * GRAVITY, STONE)


def at_rest(findings: Findings, words: str, model: Model) -> dict[str, float]:
    """The ledger of a column that has come to rest."""
    models.march(model, STEPS - 1)
    before = energy.velocities(model)
    models.march(model, 1)
    terms = energy.ledger(model, energy.observe(model), before)
    findings.imbalance[words] = abs(float(balance.residual(terms))) / balance.largest(terms)
    return terms


def oblique(findings: Findings, kind: str) -> None:
    """Reactions along x, y and z, their moments about the middle of the joint, and Clapeyron's theorem."""
    model = column(kind, np.ones(3))
    before = energy.velocities(model)
    models.march(model, 1)
    tolerance = Tolerance(1e-12, 1e-14, "no contact answers yet: rounding")
    value = unbalanced(model, before)
    findings.check(f"{kind}: unbalanced force over the loads, in the first step", "1", value, 1.0, tolerance)
    terms = at_rest(findings, f"{kind}, oblique", model)
    for upper in (1, 2):
        below = model.joints.block_b == upper
        had = -model.contacts.force[below].sum(axis=0)
        wanted = -(TRACTION * AREA + WEIGHTS[upper - 1 :].sum(axis=0))
        for axis, value, reference in zip("xyz", had, wanted, strict=True):
            findings.check(f"{kind}: reaction below block {upper} along {axis}", "N", value, reference, STATICS)
        foot = np.array([0.5 * SIDES[0], 0.5 * SIDES[1], sum(HEIGHTS[:upper])])
        turning = np.cross(model.joints.point[below] - foot, -model.contacts.force[below]).sum(axis=0)
        places = [(sum(HEIGHTS[: b + 1]) - 0.5 * HEIGHTS[b], WEIGHTS[b - 1]) for b in range(upper, 3)]
        places.append((sum(HEIGHTS), TRACTION * AREA))
        upset = -np.sum([np.cross([0.0, 0.0, level - foot[2]], force) for level, force in places], axis=0)
        for k, axis in enumerate("xy"):
            quantity = f"{kind}: moment of the reaction below block {upper} about {axis}"
            findings.check(quantity, "N m", turning[k], upset[k], STATICS)
    stored = terms["elastic_blocks"] + terms["elastic_contacts"]
    quantity = f"{kind}: work of the loads, twice what is stored"
    findings.check(quantity, "J", terms["external_work"], 2.0 * stored, STATICS)


def upright(findings: Findings, kind: str) -> None:
    """Settling and the work of the loads, by hand."""
    model = column(kind, np.array([0.0, 0.0, 1.0]))
    terms = at_rest(findings, f"{kind}, upright", model)
    load, weight = TRACTION[2] * AREA, WEIGHTS[:, 2]
    foot = load + weight[::-1].cumsum()[::-1]
    own = (foot - 0.5 * weight) * HEIGHTS[1:] / (YOUNG * AREA) if kind == "affine" else np.zeros(2)
    low = foot[0] / (KN * AREA) + 0.5 * own[0]
    high = low + 0.5 * own[0] + foot[1] / (KN * AREA) + 0.5 * own[1]
    work = weight @ [low, high] + load * (high + 0.5 * own[1])
    moved = models.displacements(model)[0][:, 2]
    pairs = (("settling of block 1", "m", moved[1], low), ("settling of block 2", "m", moved[2], high),
             ("work of the loads", "J", terms["external_work"], work))  # fmt: skip
    for name, unit, value, reference in pairs:
        findings.check(f"{kind}: {name}", unit, value, reference, STATICS)


def run() -> Findings:
    """Reactions of each kind of block; settling and works where they can be written down."""
    findings = Findings()
    for kind in ("rigid", "affine", "tets"):
        oblique(findings, kind)
        if kind != "tets":
            upright(findings, kind)
    return findings


CASE = Case(
    "weights-and-reactions",
    "A3",
    "Weights and tractions against reactions, settling and works",
    area="Elastic assemblies",
    run=run,
    quick=True,
    no_problems="linear and at rest: exact at any setting",
)
