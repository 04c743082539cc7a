"""Quasi-static mass scaling: it redistributes the mass, brings every dof to one bound, and leaves rest as it is."""

from dataclasses import replace

import numpy as np
import pytest

from masonry.configuration.energy import present
from masonry.model.model import Stepping
from masonry.model.supports import Hold
from tests.model.eigen import true_limit
from verification.fixtures import models, shapes

KINDS = {
    "rigid": ["rigid"] * 4,
    "affine": ["affine"] * 4,
    "tets": ["tets"] * 4,
    "mixed": ["rigid", "affine", "tets", "rigid"],
}
QUASI_STATIC = Stepping(damping=0.8)
HOLDS = [models.everything(0), Hold(np.array([1]), (1,))]


def made(kinds, stepping=QUASI_STATIC, material=models.STONE, gravity=(0.5, 1.0, -9.81)):
    s = shapes.setup(shapes.wall(2, 2), kinds, mesh_size=0.1)
    return models.make(s, models.GLUE, stepping, HOLDS, gravity=gravity, material=material)


@pytest.mark.parametrize("fraction, damping", [(0.9, 0.8), (0.5, 0.0)])
@pytest.mark.parametrize("kinds", KINDS.values(), ids=KINDS)
def test_scaled_masses_keep_the_total_mass_of_what_moves(kinds, fraction, damping):
    scaled = made(kinds, Stepping("scaled", step_fraction=fraction, damping=damping))
    real = made(kinds, Stepping("real", damping=damping))
    for masses in (scaled.masses, real.masses):
        assert all((m >= 0).all() for m in masses.values())
    total = [sum(float(model.masses[kind][:, :3].sum()) for kind, _ in present(model)) for model in (scaled, real)]
    assert total[0] == pytest.approx(total[1], rel=1e-12)
    assert scaled.bound > real.bound, "that is what they are for"


@pytest.mark.parametrize("fraction, damping", [(0.9, 0.8), (0.5, 0.0)])
@pytest.mark.parametrize("kinds", KINDS.values(), ids=KINDS)
def test_every_freedom_with_scaled_masses_sits_at_the_same_bound(kinds, fraction, damping):
    """Row sums of the exact stiffness stay below what the masses were made for, so each own bound is dt/fraction."""
    model = made(kinds, Stepping("scaled", step_fraction=fraction, damping=damping))
    assert model.bound == pytest.approx(model.dt / fraction, rel=1e-12)
    real = made(kinds, Stepping("real", damping=damping))
    # with real masses each dof has its own bound; masses scale as (bound wanted / bound had) squared
    which = models.free(model)
    had = own_bounds(kinds, damping)[which]
    wanted = had * np.sqrt(models.mass_vector(model)[which] / models.mass_vector(real)[which])
    assert wanted == pytest.approx(model.dt / fraction, rel=1e-9)


def own_bounds(kinds, damping: float) -> np.ndarray:
    """The bound that each dof alone would set with real masses: all others made ever so heavy."""
    from masonry.model import stable_step

    bounds = []
    right = stable_step.stable_step

    def spy(sums, masses, free, xi):
        steps = {kind: 2.0 * np.sqrt(masses[kind] / sums[kind] / (1.0 + xi)) for kind in sums if len(sums[kind])}
        bounds.append(models.gather({kind: steps[kind] for kind in ("rigid", "affine", "tets") if kind in steps}))
        return right(sums, masses, free, xi)

    stable_step.stable_step = spy
    try:
        made(kinds, Stepping("real", damping=damping))
    finally:
        stable_step.stable_step = right
    return bounds[0]


@pytest.mark.parametrize("kinds", KINDS.values(), ids=KINDS)
def test_the_exact_limit_with_scaled_masses_is_not_below_their_bound(kinds):
    model = made(kinds)
    limit = true_limit(model)
    assert 0.4 * limit < model.bound <= limit * (1 + 1e-9)


@pytest.mark.parametrize("kinds", KINDS.values(), ids=KINDS)
def test_the_answer_at_rest_does_not_depend_on_density_or_on_scaling(kinds):
    """The weight is kept the same: gravity times density."""
    steps, answers = 30000 if "tets" in kinds else 12000, []
    cases = [("scaled", 1.0), ("scaled", 1e-6), ("scaled", 1e4)] + ([("real", 1.0)] if kinds == KINDS["affine"] else [])
    for masses, share in cases:
        material = replace(models.STONE, density=models.STONE.density * share)
        gravity = np.array([0.5, 1.0, -9.81]) / share
        model = made(kinds, Stepping(masses, damping=0.8), material, gravity)
        models.march(model, steps)
        answers.append(np.concatenate([field.ravel() for field in models.displacements(model)]))
    for other in answers[1:]:
        assert np.abs(other - answers[0]).max() < 1e-9 * np.abs(answers[0]).max()


def test_a_time_step_in_seconds_scales_the_masses_to_it():
    plain, given = made(KINDS["mixed"]), made(KINDS["mixed"], Stepping("scaled", 1e-3, 0.9, 0.8))
    assert given.dt == 1e-3
    assert given.bound == pytest.approx(1e-3 / 0.9)
    ratio = models.mass_vector(given)[models.free(given)] / models.mass_vector(plain)[models.free(plain)]
    assert ratio == pytest.approx((given.dt / plain.dt) ** 2, rel=1e-12)


def test_the_weight_is_real_where_the_masses_of_motion_are_scaled():
    model = made(KINDS["mixed"])
    weight = -sum(float(body.load[:, 2].sum()) for _, body in present(model))
    assert weight == pytest.approx(4 * 1900 * 0.2 * 0.1 * 0.08 * 9.81, rel=1e-12)
