"""Looks at models that do not run: what each counts, by hand, and its limits a hundredth below and above."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from masonry.assembly.assemble import Assembly, assemble
from masonry.configuration.energy import Seen
from masonry.configuration.joint_forces import JointForces, Points
from masonry.configuration.parts.affine_blocks import AffinePart, DeformingPart
from masonry.elements.joints.joint_crushing import CrushedContacts, JointCrushing
from masonry.elements.joints.joint_patches import Patches
from masonry.errors import Stopped, TurnedTooFar
from masonry.laboratory.remarks.runs.deformed_blocks import of_strains
from masonry.model.kinds import KIND
from masonry.monitors.collapse import Collapse, Fallen, LargestDeformation
from masonry.monitors.observer import View
from masonry.monitors.openings import Openings
from masonry.monitors.reactions import WorkOfLoads, balance, moved_by, of_motion, open_by
from masonry.monitors.settling import unbalanced
from masonry.monitors.slide import Slide, is_roller
from masonry.monitors.stability import Watch
from masonry.rows.history import Standing
from masonry.scene import load
from tests.kinematics.bricks import turn
from tests.large.made import dry, slab
from tests.results.test_trust_of_dry_joints import BLOCK, GROUND, HELD, WEIGHT
from tests.results.test_trust_of_dry_joints import scene as small
from tests.scenes import box

EITHER_SIDE = [(0.99, False), (1.01, True)]
"""A share of a limit, and whether it is too much."""
TERMS = ("external_work", "elastic_blocks", "elastic_contacts", "fracture_mode_1", "fracture_mode_2", "friction")
CLOSED = dict.fromkeys((*TERMS, "damping", "kinetic", "contact_work", "imbalance"), 0.0)


def couplet() -> Assembly:
    return assemble(load("couplet").with_({"drive.accuracy": None, "drive.steps": 100}))


def seen(model, **arrays: np.ndarray) -> View:
    """What contacts show, nothing but these arrays."""
    zero = {name: np.zeros(len(model.group)) for name in Seen._fields}
    return View(Seen(**(zero | arrays)))


def stops(watched: Watch, model, **terms: float) -> bool:
    try:
        watched.look(model, View(None, terms=CLOSED | terms), 7)
    except Stopped as stop:
        assert "unstable at step 7" in str(stop)
        return True
    return False


@pytest.mark.parametrize(("share", "too_much"), EITHER_SIDE)
def test_a_run_is_stopped_by_motion_and_by_energies_that_cannot_be(share, too_much):
    """A hundred times the largest work so far as kinetic energy; a fifth of it between the two sums."""
    model = couplet().model
    watched = Watch(model, 0.02)
    assert not stops(watched, model, external_work=-4.0, contact_work=0.0)
    assert stops(watched, model, external_work=1.0, kinetic=share * 400.0) == too_much
    assert stops(watched, model, external_work=1.0, contact_work=share * 0.8) == too_much
    assert stops(watched, model, contact_work=2.0 + share * 0.8, elastic_contacts=0.5, friction=1.5) == too_much
    size = (0.2 * 0.05 * 0.05) ** (1.0 / 3.0)
    model.bodies.rigid.v[1, 0] = share * 0.01 * size / model.dt
    if too_much:
        with pytest.raises(Stopped, match=r"rigid block 1 at .*, movement along x, runs away"):
            watched.check(3)
    else:
        watched.check(3)


@pytest.mark.parametrize(("share", "too_much"), EITHER_SIDE)
def test_a_run_goes_on_where_the_two_sums_part_as_much_is_set_free_at_once(share, too_much):
    """Of 3 J that are stored 1 J is set free, and as much is in no sum; a fifth of the work may be so besides."""
    model = couplet().model
    watched = Watch(model, 0.02)
    assert not stops(watched, model, external_work=4.0, contact_work=3.0, elastic_contacts=3.0)
    open_ = 1.0 + share * 0.8
    assert stops(watched, model, external_work=4.0, contact_work=2.0 + open_, elastic_contacts=2.0) == too_much


@pytest.mark.parametrize(("share", "too_much"), EITHER_SIDE)
def test_a_block_may_turn_by_the_limit(share, too_much):
    model = couplet().model
    model.bodies.rigid.q[1, 4] = -share * 0.02
    watched = Watch(model, 0.02)
    if too_much:
        with pytest.raises(TurnedTooFar, match=r"rigid block 1 at .* has rotated by 0.0202 rad"):
            watched.check(3)
    else:
        watched.check(3)
        assert watched.rotation == pytest.approx(0.0198)


def test_openings_are_told_in_m_and_closures_over_the_thinner_block():
    """A block 0.5 m high on ground of 0.1 m."""
    model = assemble(small([GROUND, BLOCK], [HELD], WEIGHT)).model
    found = Openings(model).look(model, seen(model, opening=np.array([2e-4, -1e-4, -3e-5, 0.0])), 0)
    assert found == {"widest": 2e-4, "overlap": pytest.approx(1e-4 / 0.1)}


def test_what_a_joint_crushed_is_no_overlap():
    """The second is closed by 0.1 mm, of which 0.08 mm are crushed."""
    model = SimpleNamespace(state=SimpleNamespace(crushed=np.array([[0.0, 0.0, 0.0], [8e-5, 9e-5, 1.0]])))
    assert CrushedContacts(model).closed(np.array([-1e-5, -1e-4])) == pytest.approx([1e-5, 2e-5])


def test_what_is_unbalanced_is_what_accelerates_over_the_dead_loads():
    assembly = assemble(load("arch"))
    model, body = assembly.model, assembly.model.bodies.rigid
    free = body.dt_over_mass[:, :3] > 0.0
    before = [np.zeros_like(body.v)]
    body.v[:, 2] = np.where(free[:, 2], -9.81 * model.dt, 0.0)
    loads = np.abs(body.load[:, :3])[free].sum()
    wanted = (model.masses["rigid"][:, 2] * 9.81)[free[:, 2]].sum() / loads
    assert unbalanced(model, before) == pytest.approx(wanted)
    body.v[...] = before[0]
    assert unbalanced(model, before) == 0.0


def test_the_work_of_a_load_is_the_trapezoid_of_its_factor_over_the_way_that_it_goes():
    """20 mm under a factor from 0 to 1, 10 mm back under one from 1 to 0.5; its settling ends after the first."""
    assembly = couplet()
    model, work = assembly.model, WorkOfLoads(assembly.recording.surroundings)
    force = model.bodies.rigid.load[1, 2]
    assert force == pytest.approx(-0.5e6 * 0.01)
    for down, factor, settling in ((-0.02, 1.0, True), (-0.01, 0.5, False)):
        model.bodies.rigid.q[1, 2] = down
        work.look(model, replace(seen(model), load_factors=[factor], settling=settling), 0)
    first, second = force * -0.02 * 0.5, force * 0.01 * 0.75
    (done,) = work.records()
    assert done.by_load == pytest.approx([first + second])
    assert done.settling == pytest.approx([first])


def test_damping_and_inertia_are_those_of_what_is_free_about_the_origin():
    """The upper unit may slide and rise: minus mass times acceleration, and what damping holds it by, at its middle."""
    model = couplet().model
    body, mass, middle = model.bodies.rigid, model.masses["rigid"], model.layout.centroid[1]
    before = [np.zeros_like(body.v)]
    body.v[1, [0, 2]], body.hold[1, :3] = (3e-6, -2e-6), (7.0, 99.0, -5.0)
    damping, inertia = of_motion(model, before)
    assert model.bodies.rigid.dt_over_mass[1, :3].tolist() != [0.0] * 3
    pull = np.where(body.dt_over_mass[1, :3] > 0.0, [7.0, 99.0, -5.0], 0.0)
    slows = -mass[1, :3] * [3e-6, 0.0, -2e-6] / model.dt
    assert damping == pytest.approx([*pull, *np.cross(middle, pull)])
    assert inertia == pytest.approx([*slows, *np.cross(middle, slows)])
    assert np.abs(inertia).max() > 0.0 and pull[1] == 0.0


@pytest.mark.parametrize("moved", [False, True])
def test_a_force_at_an_arm_has_its_moment_about_the_origin_whatever_moves_and_deforms(moved):
    """Of an affine block: force times arm along its axes, which have become what its deformation makes of them."""
    rng = np.random.default_rng(8)
    axes, frame = turn(0, 0.4) @ turn(2, 1.3), np.eye(3) + 0.3 * rng.normal(size=(3, 3))
    centre, shift, force, arm = rng.normal(size=(4, 3))
    only, where = {"affine": np.array([0])}, {"affine": centre[None]}
    layout = SimpleNamespace(members=only, owner=only, axes=axes[None], place=where)
    model = SimpleNamespace(layout=layout, masses={"affine": None})
    body = SimpleNamespace(frame=frame[None], q=shift[None])
    part = (DeformingPart if moved else AffinePart)(model, KIND["affine"], body)
    acts = np.concatenate([force, np.outer(force, arm).ravel()])[None]
    place = centre + shift + frame @ axes @ arm if moved else centre + axes @ arm
    assert part.resultant(np.array([0]), acts) == pytest.approx([*force, *np.cross(place, force)])


def standing(reactions, loads, inertia=(0.0,) * 6) -> Standing:
    rows = (np.array(reactions, dtype=float), np.array(loads, dtype=float))
    return Standing(0, 0.0, *rows, np.zeros(6), np.array(inertia), np.zeros((0, 3)))


def test_a_balance_is_open_by_what_is_left_over_the_largest_force_or_moment_over_the_size():
    """Of 40 N, and of 200 Nm over 2 m, which is the largest."""
    one = standing([[0, 0, 40, 0, 0, 0]], [[0, 0, -39, 0, 200, 0]], inertia=[0, 0, -0.5, 0, -199, 0])
    assert open_by([one], 2.0) == pytest.approx(0.5 / 100.0)
    assert open_by([one], 4.0) == pytest.approx(0.5 / 50.0)
    assert open_by([one], 2.0, least=1000.0) == pytest.approx(0.5 / 1000.0)
    still = standing([[0, 0, 1, 0, 0, 0]], [[0, 0, -1, 0, 0, 0]])
    assert open_by([one, still], 2.0) == open_by([one], 2.0) and open_by([still], 2.0) == 0.0
    assert moved_by(one, [one, still], 2.0) == pytest.approx(99.5 / 100.0)
    assert open_by([standing(np.zeros((1, 6)), np.zeros((1, 6)))], 1.0) == 0.0
    told = balance((("support.0", "base"),), ("gravity",), one)
    assert told["sum"] == {"force_n": [0.0, 0.0, 0.5], "moment_nm": [0.0, 1.0, 0.0]}
    assert told["gravity"]["force_n"] == [0.0, 0.0, -39.0] and told["support.0"]["on"] == "base"


def fallen() -> Assembly:
    """A block of 0.2 x 0.2 x 0.1 m on a slab, in large displacement."""
    boxes = [slab(2.0), box("block", (-0.1, -0.1, 0.0), (0.2, 0.2, 0.1), "units", 1)]
    return assemble(dry(boxes, turned="points_per_edge = 2"))


@pytest.mark.parametrize(("share", "falls"), EITHER_SIDE)
def test_a_block_has_fallen_when_it_went_down_by_half_its_least_width(share, falls, monkeypatch):
    model = fallen().model
    monkeypatch.setattr(Patches, "deepest", lambda *_: (0.0, (0, 1)))
    model.bodies.rigid.q[1, :3] = 5.0, 0.0, -share * 0.5 * 0.1
    look = Collapse(model)
    look.look(model, replace(seen(model), terms=CLOSED | {"kinetic": 3.0}), 11)
    energies = {key: value for key, value in CLOSED.items() if key != "imbalance"} | {"kinetic": 3.0}
    assert look.records() == ([Fallen(1, 11, energies)] if falls else [])
    model.bodies.rigid.q[1, 2] = -9.0
    look.look(model, seen(model), 12)
    assert look.step == (11 if falls else 12), "the first time counts"


def test_what_slides_along_forces_of_inertia_has_not_fallen(monkeypatch):
    model = fallen().model
    monkeypatch.setattr(Patches, "deepest", lambda *_: (0.0, (0, 1)))
    model.bodies.rigid.load[1, :3] = 0.5 * np.array([-model.bodies.rigid.load[1, 2], 0.0, 0.0])
    model.bodies.rigid.q[1, :3] = 3.0, 0.0, 0.0
    look, along_load = Collapse(model, (0.0, 0.0, -9.81)), Collapse(model)
    for one in (look, along_load):
        one.look(model, seen(model), 11)
    assert not look.has_fallen and along_load.has_fallen
    model.bodies.rigid.q[1, 2] = -0.051
    look.look(model, seen(model), 12)
    (record,) = look.records()
    assert look.has_fallen and (record.block, record.step) == (1, 12)


@pytest.mark.parametrize(("share", "stopped"), EITHER_SIDE)
def test_an_overlap_of_half_the_thinner_block_ends_the_run(share, stopped, monkeypatch):
    model, widths = fallen().model, []

    def deepest(self, width):
        widths.append(width)
        return share * 0.5, (0, 1)

    monkeypatch.setattr(Patches, "deepest", deepest)
    look = Collapse(model)
    if stopped:
        with pytest.raises(Stopped, match="overlap by 0.51 of the width of the thinner one"):
            look.look(model, seen(model), 11)
    else:
        assert look.look(model, seen(model), 11)["overlap"] == pytest.approx(0.495)
    assert widths[0] == pytest.approx([0.1, 0.1])


@pytest.mark.parametrize(("share", "stopped"), EITHER_SIDE)
def test_patches_that_crushed_by_a_tenth_of_the_thinner_block_end_the_run(share, stopped, monkeypatch):
    model = fallen().model
    monkeypatch.setattr(JointCrushing, "in_patches", lambda *_: (share * 0.1, (0, 1)))
    look = Collapse(model)
    if stopped:
        with pytest.raises(Stopped, match="crushed where they meet by 0.101 of the width of the thinner one"):
            look.look(model, seen(model), 11)
    else:
        assert look.look(model, seen(model), 11)["overlap"] >= 0.0


@pytest.mark.parametrize(("least", "told"), [(0.808, False), (0.792, True)])
def test_a_block_that_is_squeezed_below_eight_tenths_is_told(least, told):
    look = LargestDeformation(1.5)
    look.look(None, View(None, least=least, longest=1.0), 0)
    assert bool(of_strains(look.records()[0])) == told


@pytest.mark.parametrize(("wide", "counts"), [(0.99, True), (1.01, False)])
def test_a_contact_that_is_open_by_a_thousandth_of_its_joint_touches_nothing(wide, counts):
    """Of 50 mm, the shorter side of the joint; pressed ones always touch."""
    model = couplet().model
    model.contacts.u[model.contacts.sides[:, 1].astype(int), 0] = 0.02
    slip, tau = np.full(4, 0.02), np.full(4, 1.0)
    look = Slide(model, 1.0)
    assert look.look(model, seen(model, opening=np.full(4, wide * 5e-5), slip=slip, tau=tau), 0)["slip"] == (
        pytest.approx(0.1) if counts else 0.0
    )
    pressed = seen(model, opening=np.full(4, 1.0), slip=slip, sigma=np.full(4, -1.0))
    assert look.look(model, pressed, 0)["slip"] == pytest.approx(0.1)


@pytest.mark.parametrize(("share", "rolls"), [(0.99, True), (1.01, False)])
def test_an_elastic_contact_is_a_roller_up_to_a_millionth_of_its_normal_stiffness_in_shear(share, rolls):
    stiffness = {"normal_stiffness": "100 GPa/m", "shear_stiffness": f"{share * 1e5!r} Pa/m"}
    keys = {f"contact.unit_unit.{key}": value for key, value in stiffness.items()}
    built = assemble(load("couplet", {"law": "elastic"}).with_(keys))
    assert is_roller(built.model.groups.properties[0]) == rolls


@pytest.mark.parametrize("turned", [np.eye(3), turn(0, 0.7) @ turn(2, -2.0)])
@pytest.mark.parametrize("upside", [False, True])
def test_a_joint_bears_the_force_and_the_moment_of_its_patches_about_its_normal_too(turned, upside):
    """Four points press and rub unlike each other; contacts of the joint have the same sums, in the frame at first."""
    model = fallen().model
    joints = model.joints
    rng, middle = np.random.default_rng(2), np.array([0.01, -0.02, 0.0])
    place = middle + np.array([[0.05, 0.04, 0.0], [-0.05, 0.05, 0.0], [-0.04, -0.05, 0.0], [0.05, -0.04, 0.0]])
    acts = np.column_stack([rng.normal(size=(4, 2)), [-5.0, -6.0, -4.0, -5.5]])  # on the slab
    motion, centre = model.large.near.motion, model.layout.centroid
    for frames in (motion.frame, model.large.bonds.frames):
        frames[0] = turned
    motion.moved[0, :3] = 0.3, -0.2, 0.1
    now = centre[0] + motion.moved[0, :3] + (place - centre[0]) @ turned.T
    pair = np.tile([1, 0] if upside else [0, 1], (4, 1))
    sign = -1.0 if upside else 1.0
    points = Points(pair, pair, now, sign * acts @ turned.T, np.tile(sign * turned[:, 2], (4, 1)))
    found = (
        JointForces(model, model.large, lambda near: points).take() * np.where(joints.block_a == 0, 1.0, -1.0)[:, None]
    )
    assert found.sum(axis=0) == pytest.approx(acts.sum(axis=0), abs=1e-9)
    moments = [np.cross(at - middle, force).sum(axis=0) for at, force in ((joints.point, found), (place, acts))]
    assert np.abs(moments[1]).min() > 1e-3, "about all axes, the normal among them"
    assert moments[0] == pytest.approx(moments[1], abs=1e-9)
