"""The law of docs/own-laws.md against the laws of the program, in the step of a wall; 1 thread.

With LANES = True the law of the page must not cost more than the dearer of the two usual ones of ours, whether the
contacts are quiet, as most are at any moment of a run, or all soften at once. Without it contacts are computed one at a
time: that is held against a loop by hand that does so too. Against ours it would be a matter of the processor, since
ours takes eight contacts in one operation with AVX-512 and in two with AVX2.
"""

import numpy as np
import pytest

from masonry.laws.building.plugins import plugin_law
from masonry.laws.exponential import Exponential
from masonry.laws.linear import Linear
from masonry.laws.polynomial import Polynomial
from tests.laws.own_package import files_of_page, install, law_in_lanes, law_with_if, on_the_path
from verification.reference_step import models, specimens
from verification.reference_step.interleaved import in_turn, require
from verification.reference_step.reference import ReferenceStep

OURS = {
    "exponential": Exponential(5.0, 15.0),
    "linear": Linear(5.0, 15.0),
    "polynomial": Polynomial(5.0, 15.0, 3.0, 2.5),
}
ROUNDS, STEPS = 400, 10
STRETCH, STRETCHED = 5e-8, 60
"""Strain of the wall in each step, where all of it softens, and calls of STEPS steps until it does."""
OWN = (5.0, 15.0, 1e-5, 0.3)


@pytest.fixture(scope="module")
def laws(tmp_path_factory):
    """Shapes by name: ours, and the page's law in lanes, one contact at a time, and with `if`."""
    files = files_of_page()
    files["bilinear_with_if.py"] = law_with_if()
    files["bilinear_in_lanes.py"] = law_in_lanes()
    more = '\nwith-if = "bilinear_with_if"\nin-lanes = "bilinear_in_lanes"\nbilinear'
    files["pyproject.toml"] = files["pyproject.toml"].replace("\nbilinear", more, 1)
    with on_the_path(install(tmp_path_factory.mktemp("page"), files)):
        found = {"own, in lanes": "in-lanes", "own": "bilinear", "own, with if": "with-if"}
        yield OURS | {name: plugin_law(law).parameters_class(*OWN) for name, law in found.items()}


def wall(parameters: tuple, soft: bool) -> tuple[models.Model, ReferenceStep]:
    """A wall in a motion that is the same whatever acts: slow, or such that it gets longer and all of it softens; and
    the same by hand, with the exponential law."""
    model = models.model_of(*specimens.wall(16, 16), law=(parameters, models.JOINT))
    twin = ReferenceStep(models.model_of(*specimens.wall(16, 16), law=(OURS["exponential"], models.JOINT)))
    velocity = np.random.default_rng(1).normal(scale=1e-7, size=(model.blocks.count, 6))
    if soft:
        velocity[:] = 0.0
        velocity[:, 0] = STRETCH * model.layout.centroid[:, 0] / model.dt
    models.make_unstoppable(model)
    twin.make_unstoppable()
    models.set_velocity(model, velocity)
    twin.set_velocity(velocity)
    return model, twin


@pytest.mark.parametrize("state", ["untouched", "all softening"])
def test_an_own_law_is_as_fast_as_ours(figure, laws, state):
    soft, works = state == "all softening", {}
    for name, parameters in laws.items():
        model, twin = wall(parameters, soft)
        works[name], works["by hand"] = models.stepping(model, STEPS), twin.stepping(STEPS)
        for _ in range(STRETCHED if soft else 1):
            works[name]()
            works["by hand"]()
        assert models.evolving(model, works[name]) == soft
    times = {name: t.least for name, t in zip(works, in_turn(*works.values(), rounds=ROUNDS), strict=True)}
    for name in laws.keys() - OURS:
        figure(f"step with the law {name}, {state}: over ours, exponential", times[name] / times["exponential"], "")
        figure("  over one by hand", times[name] / times["by hand"], "")
    require(times["own, in lanes"] / max(times["exponential"], times["linear"]), 1.05, f"own, in lanes, {state}")
    for name in ("own", "own, with if"):  # [0.95, 1.33 with AVX-512; 0.94, 1.31 with AVX2]
        require(times[name] / times["by hand"], 1.6 if soft else 1.15, f"{name}, {state}, over a step by hand")
