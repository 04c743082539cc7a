"""Models that move by themselves: step by step, with what is to be seen of them, and their energy ledger."""

import time
from collections.abc import Callable

import numpy as np

from masonry.configuration import energy
from masonry.laws.building.contact_properties import ContactProperties
from masonry.laws.building.factory import build
from masonry.model.model import Model
from verification import balance
from verification.case import Findings
from verification.fixtures import models
from verification.fixtures.one_contact import TABLE_1

STRONG = build(
    "unit_unit",
    ContactProperties.of(
        {**TABLE_1, "law": "exponential", "tensile_strength": 1e12, "cohesion": 1e12, "tan_friction": 1.0}
    ),
)
"""Contacts that never yield."""


def loose(kn: float, ks: float = 0.0) -> tuple:
    """Contacts with stiffnesses in Pa/m that press and never pull; without friction."""
    numbers = {"tensile_strength": 0.0, "cohesion": 0.0, "tan_friction": 0.0, "tan_residual_friction": 0.0}
    keys = {"law": "exponential", "normal_stiffness": kn, "shear_stiffness": ks or kn}
    return build("unit_unit", ContactProperties.of({**TABLE_1, **numbers, **keys}))


def glued(kn: float, ks: float) -> tuple:
    """Contacts with stiffnesses in Pa/m that never yield."""
    parameters, joint = STRONG
    return parameters, joint._replace(normal_stiffness=kn, shear_stiffness=ks)


def follow(
    findings: Findings,
    name: str,
    model: Model,
    steps: int,
    look: Callable[[Model], np.ndarray],
    every: int = 1,
    rows: int = 50,
) -> np.ndarray:
    """(steps // every + 1, ...) what `look` sees at the start and after every few steps, under the full dead load.

    The ledger is taken some `rows` times; what is missing in it, over the largest of its terms, is kept in `findings`.
    """
    seen, gaps, scale, begun = [np.copy(look(model))], [], 0.0, time.perf_counter()
    first = balance.residual(energy.ledger(model, energy.observe(model), energy.velocities(model)))
    between = max(1, steps // every // rows)
    for k in range(1, steps // every + 1):
        models.march(model, every - 1)
        before = energy.velocities(model)
        models.march(model, 1)
        seen.append(np.copy(look(model)))
        if k % between == 0:
            terms = energy.ledger(model, energy.observe(model), before)
            gaps.append(balance.residual(terms) - first)
            scale = max(scale, *(abs(terms[key]) for key in ("external_work", "kinetic", "contact_work")))
    findings.imbalance[name] = float(np.abs(gaps).max() / scale)
    findings.seconds[name] = time.perf_counter() - begun
    return np.array(seen)
