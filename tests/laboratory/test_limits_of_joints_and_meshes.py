"""The limits of what is said of joints that stay closed, bend or hinge, and of meshes: a hundredth on either side of
each, by numbers of joints that are given."""

from types import SimpleNamespace

import numpy as np
import pytest

from geometry.joints.faces.strips import Section
from geometry.joints.faces.whole_faces import reach_along
from masonry.assembly.assemble import assemble
from masonry.estimates import closed_joints, hinged_joints
from masonry.estimates.inspection import Inspection
from masonry.estimates.joint_loads import JointWork
from masonry.estimates.meshes import tet_energy
from masonry.estimates.strength import strength_error
from masonry.laboratory.remarks.checks import closed_joints_bend
from masonry.laboratory.remarks.runs import few_points, hinge_moments, turned_beds
from masonry.laboratory.remarks.runs.closed_joints import corner_friction, elastic_movement
from masonry.laboratory.remarks.scenes.noisy_records import peak_of_every_second_sample
from masonry.scene import load
from tests.judgement.frames import frame, on_a_slab
from tests.judgement.test_crushing_energy import SIDE, crushing_energy
from tests.judgement.test_crushing_energy import inspection as crushed
from tests.judgement.test_limits_of_remarks import EITHER_SIDE, fell_at, inspected, said

DRIVEN = SimpleNamespace(accuracy=0.02)
SMALL = SimpleNamespace(is_large=False, drive=DRIVEN, limit=None)


def look(**shares: float) -> SimpleNamespace:
    """A frame of three joints by their works (J), of which the last one bends or slides as said; all of it is 1 J."""
    works = {name: np.array([0.0, 0.0, share]) for name, share in shares.items()}
    bending, sliding = np.array([0.2, 0.3, 0.1]), np.array([0.1, 0.1, 0.2])
    work = JointWork(bending, works.get("sliding", sliding))
    return SimpleNamespace(
        work=work, inelastic=JointWork(works.get("bent", np.zeros(3)), works.get("slid", np.zeros(3)))
    )


@pytest.mark.parametrize(
    ("drive", "grows", "accuracy"),
    [(0.0149, None, 0.015), (0.0151, None, 0.0151), (None, 0.014, 0.015), (None, 0.016, 0.016), (None, None, 0.02)],
)
def test_joints_are_asked_to_the_accuracy_but_no_less_than_three_halves_of_a_per_cent(drive, grows, accuracy):
    scene = SimpleNamespace(
        drive=None if drive is None else SimpleNamespace(accuracy=drive),
        limit=None if grows is None else SimpleNamespace(run_accuracy=grows),
    )
    assert Inspection(SimpleNamespace(scene=scene), None).accuracy == accuracy
    unpaced = SimpleNamespace(drive=SimpleNamespace(accuracy=None), limit=None)
    assert Inspection(SimpleNamespace(scene=unpaced), None).accuracy == 0.02


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
@pytest.mark.parametrize(("sign", "words"), [(1.0, "too stiffly .* % too small"), (-1.0, "too softly .* % too large")])
def test_closed_joints_may_bend_too_stiffly_or_too_softly_by_the_accuracy(share, told, sign, words, monkeypatch):
    error = sign * share * 0.03
    monkeypatch.setattr(elastic_movement, "strength_decides", lambda inspection: False)
    monkeypatch.setattr(closed_joints, "error_in_frame", lambda inspection, looks, number: error * (number == 1))
    monkeypatch.setattr(elastic_movement, "advice_for", lambda assembly: "take more")
    run = SimpleNamespace(
        frames=[0, 1, 2],
        assembly=SimpleNamespace(scene=SMALL, model=None),
        accuracy=0.03,
        peak=2,
        look=lambda number: look(sliding=0.2 if number == 1 else 0.1),
        faces=SimpleNamespace(patch=np.zeros(3), softness=np.ones((3, 3, 3))),
    )
    doubts = elastic_movement.doubts(run)
    assert bool(doubts) == told and all(np.sign(doubt.value) == sign for doubt in doubts)
    assert all(part in doubt.sentence for doubt in doubts for part in words.split(" .* "))


@pytest.mark.parametrize(
    ("accuracy", "rubs", "twists", "few", "told"),
    [
        (0.0198, 0.101, 0.00101, True, True),
        (0.0202, 0.101, 0.00101, True, False),
        (0.0198, 0.099, 0.00101, True, False),
        (0.0198, 0.101, 0.00099, True, False),
        (0.0198, 0.101, 0.00101, False, False),
    ],
)
def test_a_strength_that_dry_joints_with_points_at_their_corners_bear_by_friction_may_be_off_by_two_per_cent(
    accuracy, rubs, twists, few, told, monkeypatch
):
    """Shares of friction and of twists in the work of 1 J; a triangle beside a square and one of more points."""
    monkeypatch.setattr(corner_friction, "strength_decides", lambda inspection: True)
    monkeypatch.setattr(corner_friction, "advice_for", lambda assembly: "take more")
    polygons = [[np.zeros((n, 3))] for n in (4, 4, 3)]
    faces = SimpleNamespace(
        patch=np.zeros(3),
        softness=np.ones((3, 3, 3)),
        start=np.array([0, 9, 13, 16 if few else 17]),
        polygons=polygons,
        dry=np.array([True, False, True]),
    )
    shear = SimpleNamespace(twist=np.array([0.5, -2.0, 0.0]) * twists, turn=np.array([-1.0, 0.25, 7.0]))
    run = SimpleNamespace(
        frames=[0], assembly=SimpleNamespace(scene=SMALL, model=None), accuracy=accuracy, peak=0, faces=faces,
        look=lambda _: look(slid=rubs), shear=lambda _: shear, strength="peak",
    )  # fmt: skip
    doubts = corner_friction.doubts(run)
    assert said(doubts, "joints slide and twist on contact points at their corners alone") == told


@pytest.mark.parametrize(("share", "decides"), EITHER_SIDE)
def test_a_strength_decides_where_a_hundredth_of_the_work_behind_the_peak_is_not_elastic(share, decides):
    behind = look(bent=share * 0.004, slid=share * 0.006)
    outcome = SimpleNamespace(history=SimpleNamespace(rows={}))
    groups = SimpleNamespace(properties=[])
    run = inspected(
        SimpleNamespace(scene=SMALL, model=SimpleNamespace(groups=groups, group_names=[]), pairs=None),
        history=outcome.history,
    )
    outcome.history.frames, run.__dict__["peak"], run._looks[1] = [0, 1], 0, behind
    assert run.gave_way is decides
    assert closed_joints.strength_decides(run) is decides
    assert tet_energy.friction_decides(run) is decides


@pytest.mark.parametrize(("share", "counts"), EITHER_SIDE)
def test_joints_hardly_bend_that_move_their_blocks_by_less_than_a_tenth_of_their_way(share, counts, monkeypatch):
    """The second joint is a small part of all work, and makes half of the movement of its own block."""
    of_turns = iter([np.array([0.01, share * 0.1]), np.array([0.0, 0.5])])
    monkeypatch.setattr(closed_joints, "_beside_its_block", lambda inspection, number, turn: next(of_turns))
    monkeypatch.setattr(closed_joints, "_closed", lambda inspection, looks, number: np.ones(2))
    monkeypatch.setattr(closed_joints, "_work", lambda inspection, now, number: 1e6)
    shear = SimpleNamespace(twist=np.zeros(2), turn=np.zeros(2))
    faces = SimpleNamespace(normal=np.tile([0.0, 0.0, 1.0], (2, 1)), softness=np.tile(np.eye(3), (2, 1, 1)))
    now = SimpleNamespace(moment=np.array([[0.0, 1.0, 0.0], [-2.0, 0.5, 0.0]]), turn=np.zeros((2, 3)))
    off = closed_joints.error_in_frame(SimpleNamespace(faces=faces, shear=lambda number: shear), [now], 0)
    assert off == pytest.approx(1.0 / 3.0 if counts else 0.0)


def test_the_turn_of_a_joint_moves_the_farthest_corner_of_the_block_beyond_it():
    """Over how far that block has moved: a block of 0.2 x 0.2 x 0.1 m that moved by 3 mm on a slab that is held."""
    assembly = on_a_slab()
    corners = np.zeros_like(assembly.specimen.blocks.points)
    corners[assembly.specimen.blocks.points[:, 2] > 0.0] = [0.0, 3e-3, 0.0]
    run = inspected(assembly, [frame(assembly, corners=corners)])
    ratio = closed_joints._beside_its_block(run, 0, np.array([[0.0, 2e-3, 0.0]]))
    reach = 0.05 + np.linalg.norm([0.1, 0.1, 0.05])
    assert ratio == pytest.approx([2e-3 * reach / 3e-3])


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
def test_a_block_is_asked_alone_that_stores_a_hundredth_with_half_of_the_joints_on_it(share, told, monkeypatch):
    """Two blocks with a joint of 0.8 J, of which the first stores as much less as makes it a hundredth of 100 J."""
    stored = share - 0.4
    rest = 100.0 - stored - 50.0 - 0.8
    blocks = SimpleNamespace(count=2)
    joints = SimpleNamespace(block_a=np.array([0]), block_b=np.array([1]))
    energy = object.__new__(tet_energy.EnergyOfTets)
    energy.assembly = SimpleNamespace(joints=joints, specimen=SimpleNamespace(blocks=blocks))
    energy.mesh, energy.lame, energy.owner = None, None, np.array([0, 1, 1])
    errors = np.array([0.3 * share, 0.1, 0.2])
    monkeypatch.setattr(tet_energy, "mesh_error", lambda *_: (np.array([stored, 20.0, 30.0]), errors))
    monkeypatch.setattr(tet_energy.EnergyOfTets, "joints", lambda self, state: np.array([0.8]))
    much = energy.excess(SimpleNamespace(tets=None, rest=rest), "now")
    assert much.of_all == pytest.approx(errors.sum() / 100.0)
    assert (much.of_block, much.block) == pytest.approx((0.3, 0) if told else (0.3 / 50.4, 1))


def bearing(ratio: float, monkeypatch, accuracy: float) -> list:
    """What is told where the strength is so many times what it should be."""
    one = SimpleNamespace(shares=np.array([0.3, 0.7]), in_plane=True, gave=True, at=None, by=lambda point, area: 1.2)
    monkeypatch.setattr(strength_error, "_that_matter", lambda inspection: [(0, one)])
    monkeypatch.setattr(strength_error, "own_points", lambda *_: (np.zeros((1, 3)), np.ones(1)))
    monkeypatch.setattr(strength_error, "_carried", lambda one, borne: borne)
    monkeypatch.setattr(strength_error, "_off", lambda joints, carried: ratio)
    monkeypatch.setattr(few_points, "bears_on_nodes", lambda *_: True)
    run = SimpleNamespace(accuracy=accuracy, assembly=None, faces=None, strength="load that is borne")
    return few_points.doubts(run)


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
@pytest.mark.parametrize(("sign", "word"), [(1.0, "high"), (-1.0, "low")])
def test_few_points_may_change_a_strength_by_the_accuracy(share, told, sign, word, monkeypatch):
    doubts = bearing(1.0 + sign * share * 0.04, monkeypatch, 0.04)
    assert bool(doubts) == told and all(f"may be about 4 % too {word}" in doubt.sentence for doubt in doubts)
    assert all("slide and twist are too few: a joint bears 1.2 times the load" in doubt.sentence for doubt in doubts)


@pytest.mark.parametrize(
    ("ratio", "words"),
    [
        (1.485, "about 49 % too high"),
        (1.515, "about 1.5 times what it should be"),
        (1.0 / 1.485, "about 33 % too low"),
        (1.0 / 1.515, "about 0.66 times what it should be"),
    ],
)
def test_an_error_of_half_of_a_strength_is_told_as_a_factor(ratio, words, monkeypatch):
    (doubt,) = bearing(ratio, monkeypatch, 0.015)
    assert doubt.sentence.endswith(f"the load that is borne may be {words}")


@pytest.mark.parametrize(("share", "lifts"), [(0.99, True), (1.01, False)])
def test_a_point_of_a_dry_joint_that_closes_by_a_twentieth_of_the_mean_is_about_to_lift_off(share, lifts):
    """Two joints of two points, of which the second one's bear alike; the first is pressed by 1 um in the mean."""
    faces = SimpleNamespace(
        glued=np.zeros(2, dtype=bool),
        stiffness=np.array([2e9, 5e9]),
        area=np.array([0.3, 0.1]),
        of=np.array([0, 0, 1, 1]),
        sums=lambda values: values.reshape(2, 2).sum(axis=1),
    )
    now = SimpleNamespace(torn=np.zeros(2, dtype=bool), force=np.array([-600.0, -500.0]))
    opening = np.array([-share * 0.05e-6, -1.95e-6, -1e-6, -1e-6])
    last = SimpleNamespace(opening=opening, crushing=None)
    run = SimpleNamespace(faces=faces, frames=[last], peak=0)
    assert strength_error._gave_way(run, [now]).tolist() == [lifts, False]


@pytest.mark.parametrize(("share", "words"), [(0.94, "too low by up to 94 %"), (0.96, "far too low")])
def test_how_much_hinges_lack_is_told_up_to_95_per_cent_of_the_work(share, words, monkeypatch):
    assembly = assemble(load("couplet"))
    monkeypatch.setattr(hinge_moments, "hinges_of", lambda *_: SimpleNamespace(face=np.zeros(1)))
    monkeypatch.setattr(hinged_joints, "lacking_in_frame", lambda *_: share)
    run = inspected(assembly, [frame(assembly, 0)], stopped="")
    run.__dict__["peak"] = 0
    (doubt,) = hinge_moments.doubts(run)
    assert words in doubt.sentence


PLACES = np.array([-0.1, -0.02, 0.05, 0.1])
STRIPS = Section(PLACES, np.array([0.005, 0.0055, 0.006, 0.0031]))


@pytest.mark.parametrize(("share", "feels"), EITHER_SIDE)
def test_a_dry_hinge_bears_at_most_its_pressure_at_its_edge_and_nothing_before_it_feels_its_turn(
    share, feels, monkeypatch
):
    """Of 0.0196 m2, 0.2 m deep, pressed by 3 kN: its edge feels a thousandth of that pressure."""
    monkeypatch.setattr(hinged_joints, "_across", lambda *_: STRIPS)
    faces = SimpleNamespace(stiffness=np.array([2e9]), area=np.array([0.0196]))
    now = SimpleNamespace(force=np.array([-3000.0]))

    def moment(turn: float, opening: float) -> float:
        return hinged_joints._dry_moment(None, faces, now, 0, np.array([0.0, turn, 0.0]), opening, True)

    turn = share * 1e-3 * (3000.0 / 0.0196) / (0.5 * 0.2 * 2e9)
    pressed = -3000.0 / (2e9 * 0.0196)
    by_hand = 2e9 * (pressed + turn * PLACES) @ (STRIPS.area * PLACES)
    assert moment(turn, pressed) == pytest.approx(by_hand if feels else 0.0)
    assert moment(1e-2, 0.0) == pytest.approx(0.5 * 3000.0 * 0.2)


@pytest.mark.parametrize(("share", "wide"), EITHER_SIDE)
def test_a_joint_bears_no_moment_across_a_thousandth_of_the_root_of_its_area(share, wide, monkeypatch):
    """One row of points along x, in the middle of y: across it the outline of the joint is as deep as said."""
    scene = load("couplet", {"specimen.contact_points": "gauss", "specimen.points_per_edge": {"x": 3, "y": 1, "z": 3}})
    assembly = assemble(scene)
    faces = inspected(assembly, []).faces
    depth = share * 1e-3 * float(faces.area[0]) ** 0.5
    outline = faces.middle[0] + depth * np.array([[0.9, 0.4, 0.0], [-0.9, 0.4, 0.0], [0.3, -0.6, 0.0]])
    monkeypatch.setattr(hinged_joints, "corners_of", lambda faces, face: outline)
    assert len(hinged_joints.hinges_of(assembly, faces).face) == wide


@pytest.mark.parametrize(("count", "halved"), [(15, False), (16, True)])
def test_noise_is_looked_for_in_sixteen_steps_or_more(count, halved):
    motion = SimpleNamespace(
        duration=0.1 * count,
        peak_acceleration=7.0,
        displacement_at=lambda time: 1e-3 * np.sin(40.0 * time),
    )
    assert (peak_of_every_second_sample(motion, "displacement", 10.0) != 7.0) is halved


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
def test_a_check_tells_of_closed_joints_from_two_per_cent_on(share, told, monkeypatch):
    lacks, points = share * 0.02 / (1.0 - share * 0.02), np.array([0.6, 0.8])
    oscillator = SimpleNamespace(
        load=np.ones(3), free=np.array([0, 2]), normal=np.array([4.0, 9.0]), shear=np.array([1.0, 1.0]),
        forces=lambda jumps: jumps,
    )  # fmt: skip
    monkeypatch.setattr(closed_joints_bend, "lacking_flexibility", lambda joints: SimpleNamespace(any=True))
    monkeypatch.setattr(closed_joints_bend, "oscillator_of", lambda scene: oscillator)
    jump = np.column_stack([points / np.array([2.0, 3.0]), np.zeros((2, 2))])
    monkeypatch.setattr(closed_joints_bend, "equilibrium", lambda oscillator, closed: jump)
    monkeypatch.setattr(closed_joints_bend, "lacking_share", lambda *given: lacks / given[-1])
    monkeypatch.setattr(closed_joints_bend, "advice_for", lambda assembly: "take more")

    def lines(contacts: int) -> list[str]:
        joints = SimpleNamespace(area=np.ones(contacts))
        scene = SimpleNamespace(drive=None, limit=None)
        model = SimpleNamespace(groups=SimpleNamespace(properties=[]), group_names=[])
        return closed_joints_bend.remarks(SimpleNamespace(scene=scene, joints=joints, model=model, pairs=None))

    assert [("about 2 %" in line) for line in lines(2)] == [True] * told
    monkeypatch.setattr(closed_joints_bend, "equilibrium", lambda oscillator, closed: np.ones((len(closed), 3)))
    oscillator.normal = oscillator.shear = np.full(20_000, 1.0 / 60_000)
    assert len(lines(20_000)) == told and not lines(20_001)


@pytest.mark.parametrize(("mean", "told"), [(0.891, True), (0.909, False)])
def test_a_joint_crushed_evenly_where_its_mean_closing_is_nine_tenths_of_the_largest(mean, told):
    run = crushed("small", 10, 1.0)
    x = run.assembly.joints.point[:, 0] - 0.5 * SIDE
    run.frames[0].crushing[:] = np.where(x > 0.0, 1.0, 2.0 * mean - 1.0)
    assert bool(crushing_energy.doubts(run)) is told


@pytest.mark.parametrize(("fell", "count"), [(None, 4), (3, 4), (2, 3), (1, 2)])
def test_turns_on_beds_count_up_to_the_frame_in_which_a_block_fell(fell, count, monkeypatch):
    looked_at = []
    monkeypatch.setattr(turned_beds, "turns_and_slides", lambda _, frames: looked_at.append(len(frames)) or (0, 0, 0))
    assembly = on_a_slab()
    rows = {"external_work": np.array([0.0, -1.0]), "kinetic": np.zeros(2), "friction": np.array([0.0, 1.0])}
    history = SimpleNamespace(frames=[frame(assembly, k) for k in range(4)], rows=rows)
    inspection = inspected(assembly, history=history, records=fell_at(fell))
    assert turned_beds.doubts(inspection) == [] and looked_at == [count]


def test_points_reach_as_far_as_they_do_in_the_direction_in_which_they_reach_least():
    """Points of a plate that is wider on one side, towards both of its ends and across."""
    arm = np.array([[0.3, 0.1, 0.0], [-0.1, 0.1, 0.0], [-0.1, -0.05, 0.0]])
    outline = np.array([[0.5, 0.2, 0.0], [-0.3, 0.2, 0.0], [-0.3, -0.1, 0.0]])
    x, y = np.eye(3)[:2]
    for along, reach in ((x, 0.1 / 0.3), (-x, 0.6), (y, 0.5), (-y, 0.5)):
        assert reach_along(arm, outline, along[None]) == pytest.approx(reach)
    assert reach_along(arm, outline, np.array([-x, y, x])) == pytest.approx(1.0 / 3.0)
    assert reach_along(arm, outline, np.zeros((0, 3))) == np.inf
