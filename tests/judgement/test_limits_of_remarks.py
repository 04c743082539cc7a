"""The limits of what is said of contacts, meshes and turns: asked a hundredth below and a hundredth above each."""

from dataclasses import replace
from math import inf, sqrt
from types import SimpleNamespace

import numpy as np
import pytest

from masonry.assembly.assemble import Assembly, assemble
from masonry.estimates.inspection import Inspection
from masonry.estimates.turns_on_beds import turns_and_slides
from masonry.judgement.doubt import Doubt
from masonry.laboratory.remarks.checks import free_rocking as may_rock
from masonry.laboratory.remarks.runs import (
    blow,
    hard_impacts,
    left_floor,
    rocking,
    turned_beds,
    uncaught_fall,
    unrest_at_end,
)
from masonry.laboratory.remarks.runs.closed_joints import dry_patches
from masonry.laboratory.remarks.scenes import (
    coarse_shaking,
    dilation,
    locking,
    mesh_inertia,
    noisy_records,
    odd_records,
    sharp_edges,
    tension,
    time_step,
)
from masonry.laws.building.contact_properties import ContactProperties
from masonry.monitors.collapse import Fallen, LeftFloor
from masonry.monitors.observer import ObserverRecords
from masonry.scene import load
from tests.judgement.frames import HEIGHT, SIDE, frame, moved, on_a_slab
from tests.large.made import slab
from tests.large.test_meshed_blocks import scene as meshed_scene
from tests.results.test_trust_of_dry_joints import BLOCK, GROUND, HELD, WEIGHT
from tests.results.test_trust_of_dry_joints import scene as small
from tests.scenes import box

EITHER_SIDE = [(0.99, False), (1.01, True)]
"""A share of the limit, and whether something is said."""


def said(doubts: list[Doubt], words: str) -> bool:
    """Whether exactly one doubt is raised, with these words and beyond its limit; nothing else may be."""
    assert len(doubts) <= 1 and all(words in doubt.sentence and doubt.excess >= 1.0 for doubt in doubts)
    return bool(doubts)


def fell_at(step: int | None) -> ObserverRecords:
    """What observers say of a run in which the first block had fallen at a step, or none."""
    return ObserverRecords([] if step is None else [Fallen(3, step, {})])


def inspected(assembly, frames: list | None = None, **outcome) -> Inspection:
    """A run of these frames."""
    history = outcome.pop("history", SimpleNamespace(frames=frames or []))
    return Inspection(assembly, SimpleNamespace(history=history, **outcome))


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
def test_tets_lock_from_a_poisson_ratio_of_three_tenths_on(share, told):
    scene = load("couplet").with_({"material.units.poisson_ratio": share * 0.3, "kinematics": "tets"})
    lines = locking.doubts(SimpleNamespace(scene=scene))
    assert said(lines, "constant-strain tets lock at a Poisson ratio of 0.3") == told


@pytest.mark.parametrize(
    ("ratio", "words"),
    [
        (0.301, "13 % in shear, 22 % in bending, 11 % pressed"),
        (0.4, "13 % in shear, 22 % in bending, 11 % pressed"),
        (0.401, "16 % in shear, 30 % in bending, 23 % pressed"),
        (0.489, "21 % in shear, 72 % in bending, 92 % pressed"),
        (0.4901, "24 % in shear, 4 times in bending, 8 times pressed"),
        (0.4991, "24 % in shear, 11 times in bending, 60 times pressed"),
        (0.49999, "24 % in shear, 11 times in bending, 60 times pressed"),
    ],
)
def test_locking_is_that_of_the_next_ratio_of_the_table(ratio, words):
    assert words in locking.locking_text(ratio)


@pytest.fixture(scope="module")
def meshed() -> Assembly:
    """A meshed block on a slab that is held."""
    boxes = [slab(1.0), box("block", (-0.1, -0.1, 0), (0.2, 0.2, 0.2), "meshed", 1)]
    boxes.append(box("beside", (0.5, -0.1, 0), (0.2, 0.2, 0.2), "bricks", 2))
    return assemble(meshed_scene(boxes, (0, 0, 0), 1))


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
def test_inertia_may_be_a_twentieth_too_large(meshed, share, told, monkeypatch):
    monkeypatch.setattr(mesh_inertia, "inertia_excess", lambda mesh, centroid: np.array([0.0, share * 0.05, 0.0]))
    assert said(mesh_inertia.doubts(meshed), "gives block 1 (meshed) 5 % too much") == told


@pytest.mark.parametrize(("share", "told"), [(1.01, False), (0.99, True)])
def test_edges_may_be_as_sharp_as_36_deg(meshed, share, told, monkeypatch):
    monkeypatch.setattr(sharp_edges, "sharpest_edge", lambda blocks, which: (1, share * 36.0))
    assert said(sharp_edges.doubts(meshed), "has an edge of 35.6 deg") == told


TURNS = [
    ({}, True),
    ({"turned": 0.099, "slid": 0.901}, False),
    ({"turned": 0.101, "slid": 0.899}, True),
    ({"most": 0.0099}, False),
    ({"most": 0.0101}, True),
    ({"friction": 0.99}, False),
    ({"friction": 1.01}, True),
    ({"friction": 1.01, "kinetic": 10.2}, False),
]
"""What changes of turns that make up a half, of 0.1 rad, where friction takes 5 J of a work of 10 J."""


@pytest.mark.parametrize(("changes", "told"), TURNS)
def test_turns_on_beds_are_told_where_they_are_large_and_take_much_of_what_friction_takes(changes, told, monkeypatch):
    now = {"turned": 0.5, "slid": 0.5, "most": 0.1, "friction": 5.0, "kinetic": 1.0} | changes
    monkeypatch.setattr(turned_beds, "turns_and_slides", lambda *_: tuple(now[k] for k in ("turned", "slid", "most")))
    assembly = on_a_slab()
    rows = {"external_work": np.array([0.0, -10.0]), "kinetic": np.array([0.0, now["kinetic"]])}
    rows["friction"] = np.array([0.0, now["friction"]])
    history = SimpleNamespace(frames=[frame(assembly, k) for k in (0, 1)], rows=rows)
    inspection = inspected(assembly, history=history, records=ObserverRecords())
    share = 100.0 * now["turned"] / (now["turned"] + now["slid"])
    assert said(turned_beds.doubts(inspection), f"about {share:.0f} % of all sliding") == told


@pytest.mark.parametrize(("turn", "slide"), [(0.02, 0.0), (-0.02, 0.0), (0.0, 0.003), (0.02, 0.003)])
def test_a_turn_and_a_slide_under_a_pressure_have_the_lengths_of_their_ways(turn, slide):
    """The four corners have half the diagonal as their lever; a turn to and fro sums up, but is no large turn."""
    assembly, pressure = on_a_slab(), 1e4
    pressed = {"normal_stress": np.full(len(assembly.joints.area), -pressure)}
    ways = [moved(assembly, 1, share * turn, (share * slide, 0.0, 0.0)) for share in (0.0, 0.5, 1.0, 0.0)]
    frames = [frame(assembly, k, corners=corners, **pressed) for k, corners in enumerate(ways)]
    turned, slid, most = turns_and_slides(assembly, frames)
    force, lever = pressure * SIDE**2, 0.5 * sqrt(2.0) * SIDE
    assert turned == pytest.approx(force * lever * 2.0 * abs(turn), rel=1e-3)
    assert slid == pytest.approx(force * 2.0 * slide, rel=1e-3)
    assert most == pytest.approx(0.0, abs=1e-5), "but for squares of the turn"
    assert turns_and_slides(assembly, frames[:3])[2] == pytest.approx(abs(turn), rel=1e-3)


def test_what_lifts_while_it_turns_rubs_nothing():
    assembly = on_a_slab()
    pressed = {"normal_stress": np.full(len(assembly.joints.area), -1e4)}
    frames = [frame(assembly, 0, **pressed), frame(assembly, 1, corners=moved(assembly, 1, 0.02, (0.01, 0.0, 0.0)))]
    assert turns_and_slides(assembly, frames) == (0.0, 0.0, 0.0)


def drawn_in(share: float) -> Assembly:
    """Two dry blocks on the ground in small displacement, with points at a share of the way to the corners."""
    beside = box("beside", (0.5, 0, 0), (0.2, 0.1, 0.5), "units", 2)
    assembly = assemble(small([GROUND, BLOCK, beside], [HELD], WEIGHT))
    joints = assembly.joints
    middle = np.where(joints.patch == 0, joints.point[joints.patch == 0].mean(axis=0)[:, None],
                      joints.point[joints.patch == 1].mean(axis=0)[:, None]).T  # fmt: skip
    return replace(assembly, joints=replace(joints, point=middle + share * (joints.point - middle)))


@pytest.mark.parametrize(("share", "told"), [(1.01, False), (0.99, True)])
def test_points_count_as_at_the_edge_from_nine_tenths_of_the_way_on(share, told):
    lines = may_rock.remarks(drawn_in(0.9 * share))
    assert len(lines) == told and all("these reach 0.89 of the way" in line for line in lines)


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
@pytest.mark.parametrize("farthest", [1e-3, -1e-3])
def test_a_joint_has_rocked_where_it_opened_by_a_thousandth_of_the_largest_movement(share, told, farthest):
    """The other joint opens or closes by a mm as a whole."""
    assembly = drawn_in(0.5)
    first, second = (np.flatnonzero(assembly.joints.patch == k) for k in (0, 1))
    opening, stress = np.zeros((2, len(assembly.joints.area)))
    opening[second], stress[first[1:]] = farthest, -1e4
    opening[first[0]] = share * 1e-6
    doubts = rocking.doubts(inspected(assembly, [frame(assembly, opening=opening, normal_stress=stress)]))
    assert said(doubts, "joints without tension opened on one side") == told


@pytest.mark.parametrize(("share", "told"), [(1.01, False), (0.99, True)])
def test_dry_joints_decide_where_no_block_has_moved_by_a_thousandth_of_the_smallest(share, told):
    assembly = on_a_slab()
    edge = (SIDE**2 * HEIGHT) ** (1.0 / 3.0)
    corners = moved(assembly, 1, 0.0, (0.0, -share * 1e-3 * edge, 0.0))
    doubts = dry_patches.doubts(inspected(assembly, [frame(assembly), frame(assembly, 1, corners=corners)]))
    assert said(doubts, "no block moved by more than a thousandth of its size") == told


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
def test_a_tension_beyond_the_apex_is_cut_and_told(share, told):
    """1 MPa of cohesion over a tangent of 0.5."""
    doubts = tension.doubts(assemble(glued(tensile_strength=f"{share * 2.0} MPa")))
    assert said(doubts, "is beyond the apex of the Coulomb line") == told


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
def test_a_fracture_energy_may_hold_a_joint_over_an_opening_of_a_block(share, told):
    scene = glued(tensile_strength="0.1 MPa")
    edge = float(np.cbrt(assemble(scene).model.layout.volume.min()))
    scene = glued(tensile_strength="0.1 MPa", fracture_energy_mode_1=f"{share * 1e5 * edge!r} N/m")
    assert said(tension.doubts(assemble(scene)), "keeps the joint together over an opening of") == told


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
def test_a_dilation_that_does_not_end_within_the_travel_of_the_drive_or_the_skin_is_told_in_mm(share, told):
    given, joint = SimpleNamespace(dilation_cutoff=None), SimpleNamespace(dilation_cutoff=share * 2e-3)
    doubts = dilation.of_group("bed", given, joint, 2e-3, inf)
    assert (
        said(doubts, "within the drive's 2 mm: by its fracture energy the cohesion is gone at a slip of 2.02 mm")
        == told
    )
    doubts = dilation.of_group("bed", given, joint, 1.0, 2e-3)
    assert said(doubts, "faces without strength that have slid 2 mm are detected anew") == told


@pytest.mark.parametrize(
    ("of_all", "of_one", "words"),
    [
        (0.99e-8, 0.99e-6, ""),
        (1.01e-8, 0.0, "when the run ended not all was at rest, as solver.until asks: 1e-08"),
        (
            0.0,
            1.01e-6,
            "when the run ended block 1, which began at (0, 2, 0) m, was not at rest, as solver.until asks",
        ),
    ],
)
def test_what_moves_to_the_end_of_a_run_that_was_to_end_at_rest_is_told(of_all, of_one, words, monkeypatch):
    monkeypatch.setattr(unrest_at_end, "left_of_motion", lambda model, most: np.array([0.0, of_one]))
    model = SimpleNamespace(layout=SimpleNamespace(centroid=np.array([[0.0, 0.0, 0.0], [0.0, 2.0, 0.0]])))
    plan = SimpleNamespace(ends_before=lambda steps: False)
    assembly = SimpleNamespace(scene=SimpleNamespace(solver=SimpleNamespace(until="rest")), model=model, plan=plan)
    rows = {"kinetic": np.array([0.0, 4.0, 4.0 * of_all])}
    doubts = unrest_at_end.doubts(inspected(assembly, history=SimpleNamespace(rows=rows), steps=9))
    assert said(doubts, words) == bool(words)


RISEN = {"borne_through": 0.005, "records": ObserverRecords()}
"""A peak that has just risen, and nothing fell."""


def struck(**outcome):
    """A peak of 6 MPa, and 2 in the highest row."""
    assembly = SimpleNamespace(specimen=SimpleNamespace(section=0.5), plan=SimpleNamespace(settle=0))
    rows = {"step": np.array([5, 10]), "stress": np.array([1e6, 2e6])}
    return inspected(
        assembly,
        **{"standing_rows": rows, "displacement_at_peak": 1e-3, "peak_force": 3e6, "blow": 0.0} | RISEN | outcome,
    )


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
def test_a_peak_is_a_blow_where_it_is_a_fifth_above_all_rows(share, told):
    assembly = SimpleNamespace(specimen=SimpleNamespace(section=0.5), plan=SimpleNamespace(settle=10))
    rows = {"step": np.array([5, 10, 20]), "stress": np.array([9e6, 1e6, 2e6])}
    force = share * 1.2 * 2e6 * 0.5
    run = inspected(assembly, standing_rows=rows, displacement_at_peak=1e-3, peak_force=force, **RISEN, blow=force)
    assert said(blow.doubts(run), "the peak is a blow between two rows, and the highest row shows 2 MPa") == told


@pytest.mark.parametrize(("through", "told"), [(0.0099, True), (0.0101, False)])
def test_a_peak_that_was_there_for_a_hundredth_of_the_way_is_no_blow_whatever_rows_show(through, told):
    run = struck(borne_through=through)
    assert said(blow.doubts(run), "the peak is a blow between two rows") == told


@pytest.mark.parametrize(("share", "fallen", "told"), [(0.99, False, False), (1.01, False, True), (1.01, True, False)])
def test_a_blow_that_does_not_count_is_told_where_nothing_fell(share, fallen, told):
    """What falls stands in `collapse`."""
    run = struck(blow=share * 3e6, borne_through=1.0, records=fell_at(2 if fallen else None))
    assert said(blow.doubts(run), f"a blow of {6.0 * share:.4g} MPa is not counted for the peak") == told


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
def test_a_time_step_above_its_proven_bound_is_told(share, told):
    assembly = assemble(load("couplet"))
    model = replace(assembly.model, dt=share * assembly.model.bound)
    assert said(time_step.doubts(replace(assembly, model=model)), "above the proven bound") == told


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
def test_steps_that_are_long_beside_the_swings_of_earthquakes_are_told(share, told):
    model = SimpleNamespace(dt=sqrt(24.0 * 0.01 * share) / (50.0 * np.pi))
    for ground, is_large in (((), True), (("one",), False), (("one",), True)):
        scene = SimpleNamespace(ground=ground, is_large=is_large)
        lines = coarse_shaking.doubts(SimpleNamespace(scene=scene, model=model))
        assert said(lines, "make a swing of 25 Hz too fast by 1 %") == (told and bool(ground) and is_large)


@pytest.mark.parametrize(("peak", "told"), [(0.99e-3, 1), (1.01e-3, 0), (4.95, 0), (5.05, 1)])
def test_records_that_shake_as_no_earthquake_does_are_told_unless_they_are_scaled_to_a_peak(peak, told):
    ground = SimpleNamespace(record="own.csv", peak=None, scale=-2.0, PLACE="ground")
    ground.motions = {"x": SimpleNamespace(peak_acceleration=2.0 * peak * 9.80665)}
    assembly = SimpleNamespace(scene=SimpleNamespace(ground=(ground,), waves=()))
    assert said(odd_records.doubts(assembly), "which is none of an earthquake") == bool(told)
    ground.peak = 4.0
    assert not odd_records.doubts(assembly)


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
def test_records_whose_acceleration_is_noise_are_told_at_a_peak_of_so_much_more_than_by_every_second_sample(
    share, told, monkeypatch
):
    monkeypatch.setattr(noisy_records, "peak_of_every_second_sample", lambda motion, quantity, rate: 2.0)
    ground = SimpleNamespace(record="own.csv", quantity="displacement", rate=100.0, PLACE="ground")
    ground.motions = {"y": SimpleNamespace(peak_acceleration=share * 1.15 * 2.0)}
    assembly = SimpleNamespace(scene=SimpleNamespace(ground=(ground,), waves=()))
    assert said(noisy_records.doubts(assembly), "with every second sample: its differences are noise") == told
    ground.quantity = "acceleration"
    assert not noisy_records.doubts(assembly)


@pytest.mark.parametrize(("blocks", "others"), [(1, ""), (3, ", and 2 more later")])
def test_blocks_that_left_the_floor_are_told_with_the_first_of_them_and_how_many_followed(blocks, others):
    run = inspected(None, records=ObserverRecords([LeftFloor(4, 0.25, blocks)]))
    assert said(left_floor.doubts(run), f"block 4 had left the floor after 0.25 s{others}: what leaves it falls on")
    assert not left_floor.doubts(inspected(None, records=ObserverRecords()))


@pytest.mark.parametrize(
    ("shaken", "dashpot", "fell", "told"), [(1, 0, 1, 1), (0, 0, 1, 0), (1, 1, 1, 0), (1, 0, 0, 0)]
)
def test_blocks_that_fall_on_shaken_ground_without_dashpots_are_told(shaken, dashpot, fell, told):
    given = {"floor_units": None, "unit_unit": float(dashpot)}
    properties = {name: ContactProperties("friction", 1e9, 1e9, normal_dashpot=value) for name, value in given.items()}
    pairs = SimpleNamespace(properties=properties)
    assembly = SimpleNamespace(scene=SimpleNamespace(ground=("one",) * shaken), pairs=pairs)
    run = inspected(assembly, records=fell_at(9 if fell else None))
    assert said(hard_impacts.doubts(run), "no impact lost energy") == bool(told)


@pytest.mark.parametrize(("shaken", "floor", "fell"), [(1, None, 1), (0, None, 1), (1, {}, 1), (1, None, 0)])
def test_a_fall_off_shaken_ground_that_no_floor_ends_is_told(shaken, floor, fell):
    assembly = SimpleNamespace(scene=SimpleNamespace(ground=("one",) * shaken, floor=floor, is_large=True))
    run = inspected(assembly, records=fell_at(9 if fell else None))
    assert said(uncaught_fall.doubts(run), "no floor catches them") == (shaken and floor is None and bool(fell))


def glued(**contact: str):
    """Two bricks with a mortared joint."""
    given = {
        "law": "linear",
        "normal_stiffness": "200 GPa/m",
        "shear_stiffness": "80 GPa/m",
        "tensile_strength": "0.1 MPa",
        "cohesion": "1 MPa",
        "tan_friction_angle": 0.5,
        "tan_residual_friction_angle": 0.5,
        "fracture_energy_mode_1": "100 N/m",
        "fracture_energy_mode_2": "500 N/m",
    } | contact
    return load("couplet").with_({f"contact.unit_unit.{key}": value for key, value in given.items()})
