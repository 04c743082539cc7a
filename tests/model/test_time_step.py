"""The proven time step against the exact one: stiffness through the compiled step, then eigenvalues."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from geometry.blocks import TetMesh
from masonry.configuration.energy import present
from masonry.laws.elastic import Elastic
from masonry.laws.state import JointProperties
from masonry.model.damping import Swing
from masonry.model.layout import Material
from masonry.model.model import Stepping
from masonry.model.stable_step import tet_row_sums
from tests.model.eigen import frequencies, true_limit
from verification.fixtures import models, shapes
from verification.fixtures.models import free, mass_vector, stiffness_matrix
from verification.fixtures.scene_text import assembled
from verification.scene_runs import result_of

LEAST_RATIO = {"scaled": 0.4, "real": 0.04}
"""Slivers with real masses cost most: turns and strains of a block share one length. Usual blocks reach 0.4 to 1."""
kinds = st.sampled_from(["rigid", "affine", "tets"])


def power_iteration(model, turns: int = 3000) -> float:
    """w_max (rad/s) by repeated application of the compiled step alone."""
    which, mass = models.free(model), models.mass_vector(model)
    vector, omega = np.random.default_rng(5).normal(size=len(which)) * which, 0.0
    for _ in range(turns):
        vector = -models.forces(model, vector / np.linalg.norm(vector)) / np.where(which, mass, 1.0)
        omega = np.sqrt(np.linalg.norm(vector))
    return float(omega)


scenes = st.fixed_dictionaries(
    {
        "kinds": st.lists(kinds, min_size=3, max_size=3),
        "heights": st.lists(st.floats(-2.7, -0.7).map(lambda x: 10**x), min_size=3, max_size=3),
        "size": st.tuples(st.floats(0.05, 0.3), st.floats(0.05, 0.3)),
        "kn": st.floats(7, 14).map(lambda x: 10**x),
        "ks_over_kn": st.floats(-3, 0).map(lambda x: 10**x),
        "young": st.floats(7, 11.5).map(lambda x: 10**x),
        "nu": st.sampled_from([0.0, 0.2, 0.4, 0.49]),
        "skew": st.floats(-0.6, 0.6).map(lambda x: round(x, 3)),
        "masses": st.sampled_from(["real", "scaled"]),
        "damping": st.sampled_from([0.0, 0.8]),
        "points": st.sampled_from([("gauss", 1), ("gauss", 2), ("gauss", 3), ("vertex", 2), ("vertex", 4)]),
        "held": st.booleans(),
    }
)


def made(c: dict, swing: Swing | None = None):
    """A stack of three blocks, skewed; heights from 2 mm (slivers of 100 : 1) to 0.2 m."""
    shear = np.array([[1.0, 0.0, c["skew"]], [0.0, 1.0, 0.5 * c["skew"]], [0.0, 0.0, 1.0]])
    blocks = shapes.skewed(shapes.stack(c["heights"], c["size"]), shear)
    rule, count = c["points"]
    s = shapes.setup(blocks, c["kinds"], mesh_size=max(c["size"]), rule=rule, points_per_edge=count)
    law = Elastic(), JointProperties(c["kn"], c["kn"] * c["ks_over_kn"])
    stepping = Stepping(c["masses"], damping=c["damping"], swing=swing)
    held = [models.everything(0)] if c["held"] else []
    return models.make(s, law, stepping, held, material=Material(1900.0, c["young"], c["nu"]))


@settings(max_examples=120, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(c=scenes)
def test_the_bound_is_never_above_the_true_limit_and_not_far_below(c):
    model = made(c)
    ratio = model.bound / true_limit(model)
    assert ratio <= 1.0 + 1e-9
    assert ratio >= LEAST_RATIO[c["masses"]]


@pytest.mark.parametrize("ratio", [0.1, 1.0, 30.0])
@settings(max_examples=12, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(c=scenes)
def test_the_bound_with_dashpots_is_never_above_the_true_limit_and_not_far_below(ratio, c):
    """ratio: that of the stiffest swing of the contacts, blocks taken as soft, to its critical damping."""
    c = c | {"masses": "real"}
    bare, of_contacts = made(c), made(c | {"young": 1e-3})
    which = free(bare)
    root = np.sqrt(mass_vector(bare)[which] / (1.0 + c["damping"]))
    springs, contacts = (stiffness_matrix(m)[np.ix_(which, which)] / np.outer(root, root) for m in (bare, of_contacts))
    time = 2.0 * ratio / np.sqrt(np.linalg.eigvalsh(contacts)[-1])
    bound = made(c, Swing(local=c["damping"], stiffness_time=time)).bound

    def stays(dt: float) -> bool:
        return np.linalg.eigvalsh(0.5 * dt * time * contacts + 0.25 * dt**2 * springs)[-1] <= 1.0

    assert stays(bound * (1.0 - 1e-9))
    assert not stays(bound / 0.15)


def test_a_power_iteration_finds_the_same_limit_as_the_eigenvalues():
    s = shapes.setup(shapes.stack([0.05, 0.08, 0.06]), ["rigid", "affine", "tets"], mesh_size=0.15)
    model = models.make(s, holds=[models.everything(0)])
    assert power_iteration(model) == pytest.approx(frequencies(model)[-1], rel=1e-3)


def swinging(kinds, damping: float, seed: int = 6):
    s = shapes.setup(shapes.stack([0.05, 0.08]), kinds, mesh_size=0.3)
    model = models.make(s, models.GLUE, Stepping("real", damping=damping, step_fraction=0.99), [models.everything(0)])
    for kind, body in present(model):
        body.v[:] = np.random.default_rng(seed).normal(size=body.v.shape) * np.where(body.dt_over_mass > 0, 1e-3, 0.0)
        if kind != "tets":
            body.v[:, 3:] *= 10.0
    return model


def kinetic(model) -> float:
    return 0.5 * sum(float(np.sum(model.masses[kind] * body.v**2)) for kind, body in present(model))


@pytest.mark.parametrize("damping", [0.0, 0.8])
@pytest.mark.parametrize("kinds", [["rigid", "rigid"], ["rigid", "affine"], ["rigid", "tets"]], ids="-".join)
def test_just_below_the_bound_a_million_steps_stay_bounded(kinds, damping):
    model = swinging(kinds, damping)
    assert model.dt == pytest.approx(0.99 * model.bound)
    first, most = kinetic(model), 0.0
    for _ in range(100):
        models.march(model, 10_000 if damping == 0.0 else 1_000)
        most = max(most, kinetic(model))
    assert most < 20 * first
    if damping == 0.8:
        assert kinetic(model) < 1e-12 * first


@pytest.mark.parametrize("damping", [0.0, 0.8])
@pytest.mark.parametrize("kinds", [["rigid", "rigid"], ["rigid", "affine"], ["rigid", "tets"]], ids="-".join)
def test_the_stiffest_mode_grows_just_above_the_true_limit_and_not_below(kinds, damping):
    for share, grows in ((0.99, False), (1.01, True)):
        model = swinging(kinds, damping)
        limit = true_limit(model)
        model = remade(kinds, damping, share * limit)
        velocity = {kind: body.v for kind, body in present(model)}
        models.put(model, velocity, 1e-6 * stiffest_mode(model))
        first = kinetic(model)
        models.march(model, 400)
        assert (kinetic(model) > 1e6 * first) == grows


def remade(kinds, damping: float, dt: float):
    s = shapes.setup(shapes.stack([0.05, 0.08]), kinds, mesh_size=0.3)
    return models.make(s, models.GLUE, Stepping("real", dt, damping=damping), [models.everything(0)])


def stiffest_mode(model) -> np.ndarray:
    which = models.free(model)
    root = np.sqrt(models.mass_vector(model)[which])
    matrix = models.stiffness_matrix(model)[np.ix_(which, which)] / np.outer(root, root)
    mode = np.zeros(len(which))
    mode[which] = np.linalg.eigh(0.5 * (matrix + matrix.T))[1][:, -1] / root
    return mode / np.abs(mode).max()


def test_row_sums_of_tets_are_those_of_the_stiffness_of_each():
    random, lam, mu = np.random.default_rng(3), [2e9, 5e8], [1e9, 3e9]
    nodes = random.normal(size=(12, 3))
    tets = np.array([random.choice(12, 4, replace=False) for _ in range(9)])
    edges = nodes[tets[:, 1:]] - nodes[tets[:, :1]]
    turned = np.linalg.det(edges) < 0
    tets[turned] = tets[turned][:, [1, 0, 2, 3]]
    mesh = TetMesh(nodes, np.array([0, 0, 12]), tets, np.array([0, 4, 9]))
    sums = np.zeros((12, 3))
    tet_row_sums(sums, SimpleNamespace(mesh=mesh), np.column_stack([lam, mu]))
    plain, eye = np.zeros((12, 3)), np.eye(3)
    for t, tet in enumerate(tets):
        block = int(t >= 4)
        slope = np.linalg.inv(np.column_stack([np.ones(4), nodes[tet]]))[1:].T
        elasticity = lam[block] * np.einsum("ik,jl->ikjl", eye, eye)
        elasticity += mu[block] * (np.einsum("ij,kl->ikjl", eye, eye) + np.einsum("il,kj->ikjl", eye, eye))
        volume = np.linalg.det(nodes[tet[1:]] - nodes[tet[0]]) / 6
        stiffness = volume * np.einsum("ak,ikjl,bl->aibj", slope, elasticity, slope)
        plain[tet] += np.abs(stiffness).sum(axis=(2, 3))
    np.testing.assert_allclose(sums, plain, rtol=1e-9)


@pytest.mark.parametrize("masses", ["real", "scaled"])
def test_what_is_held_and_led_throughout_has_a_step_by_which_its_strength_is_found(masses):
    """Nothing is free: the upper unit is pulled off by a drive that leaves it no other motion."""
    supports = [{"on": "bottom", "fix": "all"}, {"on": "top", "fix": ["x", "y", "rotation"]}]
    pulled = {"drive.direction": "z", "drive.displacement": "0.006 mm", "drive.rate": "1 mm/s", "drive.accuracy": None}
    scene = {"support": supports, "traction": [], "settle": None, "solver.masses": masses}
    result = result_of("couplet", scene | pulled)
    assert result.summary["peak_stress_pa"] == pytest.approx(0.58e6, rel=1e-2)
    assert result.summary["steps"] > 100


FRAME = """law = "elastic"
kinematics = "rigid"
displacements = "{displacements}"
[specimen]
kind = "boxes"
section = "0.12 m^2"
box = [
    {{name = "left", origin = ["0 m", "0 m", "0 m"], size = ["0.4 m", "0.3 m", "0.5 m"]}},
    {{name = "right", origin = ["0.75 m", "0.05 m", "0 m"], size = ["0.35 m", "0.25 m", "0.5 m"]}},
    {{name = "top", origin = ["0.1 m", "0 m", "0.5 m"], size = ["0.9 m", "0.3 m", "0.4 m"]}},
]
[material.units]
density = "2000 kg/m^3"
[contact.within_units]
normal_stiffness = "10 GPa/m"
shear_stiffness = "4 GPa/m"
[gravity]
z = "-9.81 m/s^2"
[[support]]
on = "left"
fix = "all"
[[support]]
on = "right"
fix = ["x", "y", "z"]
[solver]
masses = "real"
damping = 0
duration = "1 s"
[damping]
{damping}
"""
"""Two posts of unlike size, and a lintel that reaches beyond one of them."""


def damped(displacements: str, damping: str):
    return assembled(FRAME.format(displacements=displacements, damping=damping)).model


@pytest.mark.parametrize("displacements", ["small", "large"])
@pytest.mark.parametrize(
    "damping", ['stiffness = {ratio = "5 %", at = "4 Hz"}', 'rayleigh = {ratio = "3 %", between = ["2 Hz", "9 Hz"]}']
)
def test_the_price_of_dashpots_is_told_and_the_damping_that_is_advised_does_not_ask_it(displacements, damping):
    bare, dear = damped(displacements, ""), damped(displacements, damping)
    told = float(dear.limited_by.split("make it ")[1].split(" times shorter")[0])
    assert told == pytest.approx(bare.bound / dear.bound, rel=0.005)
    z = swing_time(damping) / bare.bound
    of_row_sums = 1.0 / (np.sqrt(1.0 + z**2) - z)
    assert 2.0 < told < of_row_sums / (1.8 if displacements == "small" else 4.0)
    assert "damping.maxwell" in dear.limited_by
    mild = damped(displacements, 'maxwell = {ratio = "5 %", between = ["2 Hz", "20 Hz"]}')
    assert 1.0 < bare.bound / mild.bound < 1.2
    assert "dashpots" not in bare.limited_by + mild.limited_by


def test_dashpots_of_a_box_that_may_press_all_over_turn_it_three_times_as_fast_as_they_move_it():
    """In large displacement, faces of area S lumped at corners: k S (b^2 + c^2) / 4 over m (b^2 + c^2) / 12 about each
    axis, twice for what presses there; the smallest box decides."""
    time, (length, width, height) = 0.2, (0.35, 0.25, 0.5)
    most = 2.0 * 3.0 * 10e9 * 2.0 * (1.0 / length + 1.0 / width + 1.0 / height) / 2000.0
    bound = damped("large", f'stiffness = "{time} s"').bound
    assert bound == pytest.approx(2.0 / (time * most), rel=1e-3)


def swing_time(damping: str) -> float:
    """a1 (s) of what the test asks for, by hand."""
    return 0.05 / (np.pi * 4.0) if damping.startswith("stiffness") else 0.03 / (np.pi * (2.0 + 9.0))


@pytest.mark.parametrize(("share", "is_told"), [(0.99, False), (1.01, True)])
def test_a_price_below_twice_the_steps_is_not_told(share, is_told):
    bare, long = damped("small", "").bound, 1.0
    dear = damped("small", f'stiffness = "{long!r} s"').bound
    rate = 2.0 * (1.0 - (dear / bare) ** 2) / (dear * long)  # 1/s2, of 1 = dt a1 rate / 2 + (dt / bare)^2
    times = 2.0 * share
    time = 2.0 * times * (1.0 - 1.0 / times**2) / (rate * bare)
    assert ("times shorter" in damped("small", f'stiffness = "{time!r} s"').limited_by) == is_told
