"""Nothing depends on where the axes point, on numbering, or on a rigid motion; momentum is kept."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from geometry.joints.find import find_joints
from masonry.configuration.energy import present
from masonry.laws.building import factory
from masonry.laws.building.contact_properties import ContactProperties
from masonry.model.loads import Push
from masonry.model.model import Stepping, sort_by_group
from tests.model.eigen import true_limit
from verification.checks.invariance import contact_forces, momentum
from verification.fixtures import models, shapes

MIXTURES = {
    "rigid": ["rigid"] * 5,
    "affine": ["affine"] * 5,
    "tets": ["tets"] * 5,
    "mixed": ["rigid", "affine", "tets", "affine", "tets"],
}
TURN = Rotation.from_rotvec([0.7, -0.4, 1.1]).as_matrix()
MIRROR = np.diag([-1.0, 1.0, 1.0])
SHEAR = np.array([[1.0, 0.3, 0.2], [0.1, 1.0, -0.2], [0.0, 0.15, 0.9]])
SOFT = factory.build(
    "unit_unit",
    ContactProperties.of(
        {
            "law": "exponential",
            "normal_stiffness": 2e11,
            "shear_stiffness": 8e10,
            "tensile_strength": 0.2e6,
            "cohesion": 0.3e6,
            "tan_friction": 0.9,
            "tan_residual_friction": 0.6,
            "fracture_energy_mode_1": 2.0,
            "fracture_energy_mode_2": 20.0,
        }
    ),
)


def specimen(kinds, shape="wall"):
    """Five blocks in running bond (two, one and a half over, one on top), upright or skewed."""
    blocks = shapes.wall(2, 2)
    top = shapes.boxes([((0.15, 0.0, 0.16), (0.4, 0.1, 0.25))])
    low = np.array([blocks.points[8 * b] for b in range(4)] + [top.points[0]])
    high = np.array([blocks.points[8 * b + 7] for b in range(4)] + [top.points[7]])
    blocks = shapes.boxes(list(zip(low, high, strict=True)))
    if shape == "skewed":
        blocks = shapes.skewed(blocks, SHEAR)
    return shapes.setup(blocks, kinds, mesh_size=0.09)


@pytest.mark.parametrize("shape", ["wall", "skewed"])
@pytest.mark.parametrize("kinds", MIXTURES.values(), ids=MIXTURES)
def test_a_rigid_motion_of_all_blocks_makes_no_force(kinds, shape):
    s = shapes.mapped(specimen(kinds, shape), TURN, (0.4, -0.2, 1.3))
    model = models.make(s)
    rng = np.random.default_rng(1)
    spin = rng.normal(size=3)
    cross = np.cross(np.eye(3), -spin)
    rigid = models.linear_field(model, rng.normal(size=3), cross)
    noise = rng.normal(size=len(rigid)) * np.abs(rigid).max()
    scale = np.abs(models.forces(model, noise)).max()
    assert np.abs(models.forces(model, rigid)).max() < 1e-13 * scale
    assert np.abs(model.contacts.force).max() < 1e-13 * scale, "no contact feels it"


@pytest.mark.parametrize("kinds", MIXTURES.values(), ids=MIXTURES)
def test_contacts_push_both_sides_alike_and_along_one_line(kinds):
    model = models.make(shapes.mapped(specimen(kinds, "skewed"), TURN))
    noise = np.random.default_rng(2).normal(size=len(models.free(model)))
    models.forces(model, noise)
    everywhere = np.abs(model.contacts.force).sum()
    assert np.abs(contact_forces(model)).max() < 1e-13 * everywhere


@pytest.mark.parametrize("law", [models.GLUE, SOFT], ids=["elastic", "softening"])
@pytest.mark.parametrize("kinds", MIXTURES.values(), ids=MIXTURES)
def test_momentum_is_kept_without_supports_and_damping(kinds, law):
    model = models.make(shapes.mapped(specimen(kinds, "skewed"), TURN), law=law)
    rng = np.random.default_rng(3)
    for _, body in present(model):
        body.v[:] = rng.normal(size=body.v.shape) * 0.04
    before = momentum(model)
    swing = sum(np.abs(model.masses[kind] * body.v).sum() for kind, body in present(model))
    models.march(model, 3000)
    assert np.abs(momentum(model) - before).max() < 1e-12 * swing
    assert np.abs(before).max() > 1e-3 * swing
    if law is SOFT:
        assert model.state.intact_n.min() < 0.9, "contacts did crack"


def run(s, law, turn, dt, damping=0.0, order=None):
    """Blocks 0 and 1 (by their old numbers) held; weight and a traction turned with the specimen."""
    order = np.arange(s.blocks.count) if order is None else order
    held = models.everything(*(np.argsort(order)[b] for b in (0, 1)))
    top = int(np.argsort(order)[4])
    push = Push(np.array([s.blocks.block_face_start[top]]), turn @ [6e4, 3e4, -3e4])
    model = models.make(
        *(s, law, Stepping("real", dt, damping=damping), [held], [push]),
        gravity=turn @ np.array([40.0, 30.0, -20.0]) * 2,
    )
    models.march(model, 1500)
    return model


def step_of(s):
    """A step (s) well within the exact limit."""
    return 0.4 * true_limit(models.make(s, holds=[models.everything(0, 1)]))


@pytest.mark.parametrize("law", [models.GLUE, SOFT], ids=["elastic", "softening"])
@pytest.mark.parametrize("turn", [TURN, MIRROR], ids=["turned", "mirrored"])
@pytest.mark.parametrize("kinds", MIXTURES.values(), ids=MIXTURES)
def test_a_turned_or_mirrored_scene_answers_turned_or_mirrored(kinds, turn, law):
    s = specimen(kinds, "wall")
    dt = step_of(s)
    plain, turned = run(s, law, np.eye(3), dt), run(shapes.mapped(s, turn), law, turn, dt)
    for was, is_now in zip(models.displacements(plain), models.displacements(turned), strict=True):
        assert np.abs(is_now - was @ turn.T).max(initial=0.0) < 1e-9 * np.abs(was).max(initial=0.0) + 1e-300
    if law is SOFT:
        assert plain.state.intact_n.min() < 0.9, "contacts did crack"
        assert np.abs(plain.state.dissipated - turned.state.dissipated).max() < 1e-9 * plain.state.dissipated.max()


@pytest.mark.parametrize("law", [models.GLUE, SOFT], ids=["elastic", "softening"])
@pytest.mark.parametrize("kinds", [MIXTURES["rigid"], MIXTURES["affine"]], ids=["rigid", "affine"])
def test_contacts_found_anew_on_turned_blocks_answer_alike(kinds, law):
    s = specimen(kinds, "skewed")
    dt = step_of(s)
    turned = shapes.mapped(s, TURN)
    joints = sort_by_group(turned.blocks, find_joints(turned.blocks))[2]
    anew = shapes.Setup(turned.blocks, turned.kind, joints, None)
    assert len(joints.area) == len(s.joints.area)
    was, is_now = (models.displacements(run(x, law, t, dt))[0] for x, t in ((s, np.eye(3)), (anew, TURN)))
    assert np.abs(is_now - was @ TURN.T).max() < 1e-9 * np.abs(was).max()


@pytest.mark.parametrize("law", [models.GLUE, SOFT], ids=["elastic", "softening"])
@pytest.mark.parametrize("kinds", MIXTURES.values(), ids=MIXTURES)
def test_numbering_blocks_differently_changes_nothing(kinds, law):
    s, order = specimen(kinds, "wall"), np.array([3, 0, 4, 2, 1])
    dt = step_of(s)
    other, nodes = shapes.renumbered(s, order)
    was, is_now = run(s, law, np.eye(3), dt, 0.8), run(other, law, np.eye(3), dt, 0.8, order)
    (blocks_was, nodes_was), (blocks_now, nodes_now) = models.displacements(was), models.displacements(is_now)
    scale = max(np.abs(blocks_was).max(), np.abs(nodes_was).max(initial=0.0))
    assert np.abs(blocks_now - blocks_was[order]).max() < 1e-9 * scale
    assert np.abs(nodes_now - nodes_was[nodes]).max(initial=0.0) < 1e-9 * scale


@pytest.mark.parametrize("kinds", MIXTURES.values(), ids=MIXTURES)
def test_a_damped_elastic_scene_comes_to_the_same_rest_however_it_is_turned(kinds):
    answers = []
    for turn in (np.eye(3), TURN):
        s = shapes.mapped(specimen(kinds, "wall"), turn)
        stepping = Stepping("scaled", damping=0.8)
        model = models.make(s, models.GLUE, stepping, [models.everything(0, 1)], gravity=turn @ [1.0, 2.0, -9.0])
        models.march(model, 40000 if "tets" in kinds else 15000)
        answers.append([field @ turn for field in models.displacements(model)])
    for was, is_now in zip(*answers, strict=True):
        assert np.abs(is_now - was).max(initial=0.0) < 1e-9 * np.abs(was).max(initial=0.0) + 1e-300
