"""Blocks of all kinds that tumble and deform on springs: momenta are kept, the ledger closes, and the energy that no
force gave falls with the square of the step.
"""

import numpy as np
import pytest

from geometry.joints.find import find_joints
from geometry.meshes.nonmatching import surface_joints
from geometry.meshes.tetrahedralise import mesh_blocks
from masonry.kinematics.dispatch import move, update_positions
from masonry.model.body_arrays import in_rows
from masonry.model.layout import KINDS, Material
from masonry.model.model import Stepping, sort_by_group
from tests.kinematics import bricks
from verification.fixtures import models, shapes

RUBBER = Material(density=1900.0, young_modulus=4e6, poisson_ratio=0.2)
SLANT = np.array([[1.0, 0.3, 0.2], [0.1, 1.0, -0.2], [0.0, 0.0, 0.9]])
MIXTURE = ["rigid", "affine", "tets"]
BLOCKS = shapes.skewed(shapes.stack([0.05, 0.07, 0.06]), SLANT)


def tumbling(
    dt: float, normal: float, shear: float, apart: bool = True, s: shapes.Setup | None = None
) -> bricks.Springs:
    """Three slanted blocks, a kind each, on springs of so many N/m along the normals at the start and across."""
    s = s or shapes.setup(BLOCKS, MIXTURE)
    model = models.make(s, stepping=Stepping("real", dt, damping=0.0), material=RUBBER)
    n = model.contacts.normal[:, :3]
    k = shear * np.eye(3) + (normal - shear) * np.einsum("ci,cj->cij", n, n)
    springs = bricks.Springs(model, k, apart)
    springs.set_velocities(3, 0.6)
    return springs


def between_nodes(kinds: list[str]) -> shapes.Setup:
    """Blocks whose edges do not meet, with contact points of tets that lie between nodes."""
    which = np.array([kind == "tets" for kind in kinds])
    middle = (0.02, -0.01, 0.05), (0.15, 0.09, 0.12)
    corners = [((0, 0, 0), (0.2, 0.1, 0.05)), middle, ((0, 0, 0.12), (0.2, 0.1, 0.18))]
    blocks = shapes.setup(shapes.skewed(shapes.boxes(corners), SLANT), ["rigid"] * 3).blocks
    far = find_joints(shapes.boxes([((9, 9, 9), (10, 10, 10))]))
    mesh = mesh_blocks(blocks, which, 0.1, far)[0]
    joints = sort_by_group(blocks, surface_joints(blocks, find_joints(blocks), mesh))[2]
    assert joints.corner_a is not None
    return shapes.Setup(blocks, np.array([KINDS.index(kind) for kind in kinds]), joints, mesh)


@pytest.mark.parametrize("kinds", [MIXTURE, MIXTURE[::-1]])
@pytest.mark.parametrize("made", [lambda kinds: shapes.setup(BLOCKS, kinds), between_nodes], ids=["nodes", "between"])
def test_momenta_are_kept_to_round_off(kinds, made):
    """Springs that are stiffer along a direction that stays: forces are not along the line between their two ends."""
    springs = tumbling(2e-5, 3e4, 5e3, s=made(kinds))
    start, size = springs.momenta(), [0.0, 0.0]
    for _ in range(10):
        springs.march(50)
        now = springs.momenta()
        size = [max(size[i], np.abs(now[i] - start[i]).max() / np.abs(start[i]).max()) for i in (0, 1)]
    assert max(size) < 2e-13
    assert np.abs(springs.apart).max() > 1e-3


def test_without_apart_a_couple_is_left():
    springs = tumbling(2e-5, 3e4, 5e3, apart=False)
    (_, start), _ = springs.momenta(), springs.march(1000)
    assert np.abs(springs.momenta()[1] - start).max() > 1e-4 * np.abs(start).max()


@pytest.mark.slow
def test_threads_give_the_same_bits():
    one, two = tumbling(2e-5, 3e4, 5e3), tumbling(2e-5, 3e4, 5e3)
    one.march(100, 0.2)
    two.march(100, 0.2, parallel=True)
    assert np.array_equal(one.u, two.u)
    assert all(np.array_equal(a.work, b.work) for (_, a), (_, b) in zip(one.present, two.present, strict=True))


@pytest.mark.parametrize("kind", MIXTURE)
def test_patches_act_as_contacts_at_the_same_points_do(kind):
    """The upper block of a pair on springs: once through its contact sides, once through what they sum up to."""
    sided, patched = (pair(kind) for _ in range(2))
    layout, body = patched.model.layout, getattr(patched.bodies, kind)
    joints, points = patched.model.joints, patched.model.contacts.sides[:, 1]
    width = {"rigid": 6, "affine": 12, "tets": 3}[kind]
    patches = in_rows(np.zeros((len(body.v), width)))
    body = body._replace(patches=patches, start=np.zeros_like(body.start), apart=None)
    for _ in range(200):
        sided.march(1)
        update_positions(None, body, patched.model.dt, patched.u)
        force = -sided.force
        if kind == "tets":
            patches[...] = 0.0
            np.add.at(patches, joints.node_b, force)
        else:
            patches[0, :3] = force.sum(axis=0)
            lever = joints.point + sided.u[points] - layout.centroid[1] - body.q[0, :3]
            whole = np.cross(lever, force).sum(axis=0) if kind == "rigid" else np.einsum("ci,cj->ij", force, lever)
            patches[0, 3:] = whole.ravel()
        move(None, body, patched.model.dt, None, bricks.ALL_OF_IT, patched.force, patched.u)
    same = getattr(sided.bodies, kind)
    assert np.abs(same.v).max() > 0.01
    assert body.v == pytest.approx(same.v, abs=1e-12 * np.abs(same.v).max())
    assert body.work == pytest.approx(same.work, abs=1e-12 * np.abs(same.work).max())


def pair(kind: str) -> bricks.Springs:
    """A block of a kind above a held one, pulled along y at one edge by springs that are not alike."""
    s = shapes.setup(shapes.skewed(shapes.stack([0.05, 0.07]), SLANT), ["affine" if kind == "rigid" else "rigid", kind])
    model = models.make(s, stepping=Stepping("real", 2e-5, damping=0.0), material=RUBBER)
    stiffness = np.arange(len(model.group))[:, None, None] * 1e3 * np.eye(3)
    springs = bricks.Springs(model, stiffness)
    springs.set_velocities(5, 0.5)
    return springs


def balance(dt: float, time: float, damping=None) -> dict[str, float]:
    """Gap of the ledger, energy that comes from no force, and what the springs got beyond their energy; J."""
    springs = tumbling(dt, 1e4, 1e4)
    springs.march(1)
    before = springs.before()
    springs.march(1, damping)
    first = springs.kinetic(before) + springs.works()[3] - springs.works()[:3].sum()
    gaps = []
    for _ in range(5):
        springs.march(round(time / dt / 5) - 1, damping)
        before = springs.before()
        springs.march(1, damping)
        works, kinetic = springs.works(), springs.kinetic(before)
        gaps.append(abs(kinetic + works[3] - works[:3].sum() - first))
    rotor = springs.bodies.rigid.work[0, 3]
    return {
        "gap": max(gaps),
        "rotor": rotor,
        "geometry": works[3] - rotor - springs.elastic(),
        "springs": -works[0] - springs.in_springs(),
        "moving": kinetic,
        "damping": -works[1],
        "elastic": springs.elastic(),
    }


@pytest.mark.parametrize("damping", [None, 0.2])
def test_the_ledger_closes_to_round_off(damping):
    ledger = balance(4e-5, 0.01, damping)
    assert ledger["gap"] < 1e-13 * (ledger["moving"] + ledger["damping"])
    assert (ledger["damping"] > 0.0) == (damping is not None)


def test_energy_that_no_force_gave_falls_with_the_square_of_the_step():
    coarse, fine, finer = (balance(dt, 0.02) for dt in (4e-5, 2e-5, 1e-5))
    assert fine["elastic"] > 0.01 * fine["moving"]
    for name in ("rotor", "geometry", "springs"):
        assert coarse[name] / fine[name] == pytest.approx(4.0, abs=0.6), name
        assert fine[name] / finer[name] == pytest.approx(4.0, abs=0.3), name
