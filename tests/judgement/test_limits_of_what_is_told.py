"""More limits of doubts, a hundredth below and a hundredth above: strains, coarse tets, a tension left out, what came
loose, swings at rest, hinges, and joints whose edge crushed."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from masonry.assembly.assemble import Assembly, assemble
from masonry.errors import Stopped
from masonry.estimates import hinged_joints
from masonry.estimates.meshes.tet_energy import ExcessEnergy
from masonry.laboratory import laboratory
from masonry.laboratory.remarks.runs import coarse_mesh, crushing_energy, hinge_moments, rocking
from masonry.laboratory.remarks.runs.deformed_blocks import of_strains
from masonry.laboratory.remarks.scenes import shaken_drive, tension
from masonry.laboratory.summary.rest import rest
from masonry.monitors.collapse import Strains
from masonry.rows.columns import CRUSHING, FACTOR
from masonry.rows.history import Frame, History
from masonry.scene import load
from masonry.timeloop.run_outcome import Outcome
from tests.judgement.frames import frame
from tests.judgement.test_crushing_energy import SIDE, STRENGTH
from tests.judgement.test_crushing_energy import inspection as crushed
from tests.judgement.test_crushing_energy import scene as crushing_scene
from tests.judgement.test_limits_of_remarks import EITHER_SIDE, glued, inspected, said
from tests.results.test_trust_of_dry_joints import BLOCK, DRY, GROUND, HELD, WEIGHT
from tests.results.test_trust_of_dry_joints import scene as small
from tests.scenes import box


@pytest.mark.parametrize(("share", "told"), [(1.01, False), (0.99, True)])
def test_blocks_may_be_squeezed_to_four_fifths_of_their_volume(share, told):
    assert said(of_strains(Strains(share * 0.8, 1.0, 1.5)), "are squeezed to 0.79 of their volume") == told


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
def test_blocks_may_be_stretched_as_far_as_the_step_is_proven_for(share, told):
    assert said(of_strains(Strains(1.0, share * 1.6, 1.6)), "are stretched by 1.62, more than the 1.6") == told


@pytest.mark.parametrize(("share", "told"), [(1.01, False), (0.99, True)])
def test_a_tension_below_a_hundred_thousandth_of_the_cohesion_is_left_out_and_told(share, told):
    """1 MPa of cohesion."""
    doubts = tension.doubts(assemble(glued(tensile_strength=f"{share * 10.0} Pa", fracture_energy_mode_1="1e-9 N/m")))
    assert said(doubts, "is less than 1e-5 of the cohesion of 1e+06 Pa") == told


@pytest.mark.parametrize(
    ("of_all", "of_block", "accuracy", "words"),
    [
        (0.99 * 0.05, 0.99 * 0.2, None, ""),
        (1.01 * 0.05, 0.0, None, "the tets are too large for how stress varies in blocks"),
        (0.99 * 0.08, 0.0, 0.08, ""),
        (1.01 * 0.08, 0.0, 0.08, "the tets are too large for how stress varies in blocks"),
        (0.0, 1.01 * 0.2, 0.3, "the tets of block 1 at (0.1, 0.25, 1.5) m are too large"),
    ],
)
def test_tets_may_store_a_twentieth_too_much_or_the_accuracy_and_a_fifth_in_one_block(
    of_all, of_block, accuracy, words, monkeypatch
):
    mesh = SimpleNamespace(tet_start=np.array([0, 0, 0]))
    excess = ExcessEnergy(of_all, of_block, 1, np.zeros(0), "at the end")
    monkeypatch.setattr(coarse_mesh, "excess_energies", lambda inspection, mesh: [excess])
    monkeypatch.setattr(coarse_mesh, "friction_decides", lambda inspection: False)
    monkeypatch.setattr(coarse_mesh, "finer", lambda *_: "take a smaller one")
    layout = SimpleNamespace(centroid=np.array([[0.0, 0.0, 0.0], [0.1, 0.25, 1.5]]))
    drive = None if accuracy is None else SimpleNamespace(accuracy=accuracy)
    specimen = SimpleNamespace(mesh="gmsh", mesh_size=None)
    scene = SimpleNamespace(drive=drive, limit=None, specimen=specimen)
    run = inspected(SimpleNamespace(mesh=mesh, model=SimpleNamespace(layout=layout), scene=scene), [None])
    assert said(coarse_mesh.doubts(run), words) == bool(words)


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
@pytest.mark.parametrize("accuracy", [0.03, 0.001])
def test_hinges_may_lack_the_accuracy_but_no_less_than_three_halves_of_a_per_cent(share, told, accuracy, monkeypatch):
    """The worse of the peak and the frame behind it."""
    limit = max(accuracy, 0.015)
    assembly = assemble(load("couplet", {"drive.accuracy": accuracy}))
    monkeypatch.setattr(hinge_moments, "hinges_of", lambda *_: SimpleNamespace(face=np.zeros(1)))
    lacks = iter([0.0, share * limit])
    monkeypatch.setattr(hinged_joints, "lacking_in_frame", lambda *_: next(lacks))
    run = inspected(assembly, [frame(assembly, 0), frame(assembly, 1)], stopped="")
    run.__dict__["peak"] = 0
    assert (
        said(hinge_moments.doubts(run), "turned about it and bear no moment there, as a hinge: the peak may be") == told
    )


@pytest.mark.parametrize(
    ("made", "meant", "told"),
    [(0.99 * 1.2, 1.0, False), (1.01 * 1.2, 1.0, True), (0.99 * 0.1, 0.0, False), (1.01 * 0.1, 0.0, True)],
)
def test_a_drive_may_shake_a_fifth_more_than_its_rows_and_less_than_is_felt(made, meant, told, monkeypatch):
    monkeypatch.setattr(shaken_drive, "accelerations", lambda table: (made, meant))
    history = [[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]]
    drive = SimpleNamespace(accuracy=None, path=SimpleNamespace(duration=2.0), history=history, steps=None)
    assembly = SimpleNamespace(scene=SimpleNamespace(drive=drive), model=SimpleNamespace(scaled=False))
    assert said(shaken_drive.doubts(assembly), "accelerates by up to") == told


def at_rest(assembly: Assembly, frames: list[Frame], kinetic: float = 0.0, **more: np.ndarray):
    """What is told of rest, of a run with these frames and this kinetic energy over a stored J."""
    rows = {"step": np.array([0, assembly.plan.settle + 10]), "kinetic": np.array([0.0, kinetic])}
    rows |= {"elastic_blocks": np.zeros(2), "elastic_contacts": np.array([0.0, 1.0])} | more
    observed = {"unbalanced": [0.0], "still_moving": [0.0], "of_a_block": [-1.0], "energy_of_a_block": [0.0]}
    observed |= {"block": [0.0], "swing_in_a_step": np.array([0.5])}
    history = History(rows, frames)
    return rest(assembly, Outcome(history, observed=observed))


TWO = [GROUND, BLOCK, box("on top", (0, 0, 0.5), (0.2, 0.1, 0.1), "units", 2)]
GLUE = DRY.replace('"friction"', '"brittle"') + '\ntensile_strength = "0.1 MPa"\ncohesion = "0.2 MPa"'


def parted(share: float, joint: int, bears: float) -> tuple[Assembly, Frame]:
    """A tall block and one on top of it: those above a joint (0, 1) have gone up by a share of a thousandth of the
    smallest; at that joint a contact presses by so much, at the others all do."""
    assembly = assemble(small(TWO, [HELD], WEIGHT))
    blocks, joints = assembly.specimen.blocks, assembly.joints
    size = (0.2 * 0.1 * 0.1) ** (1.0 / 3.0)
    corners = np.zeros_like(blocks.points)
    corners[blocks.points[:, 2] > (0.45 if joint else 0.05), 2] = 1e-3 * share * size
    here = np.isclose(joints.point[:, 2], 0.5 * joint)
    stress = np.where(here, 0.0, -1e4)
    stress[np.flatnonzero(here)[0]] = bears
    return assembly, frame(assembly, corners=corners, normal_stress=stress)


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
def test_what_no_joint_holds_came_loose_from_a_thousandth_of_the_smallest_block_on(share, told):
    assembly, last = parted(share, 0, 0.0)
    words = at_rest(assembly, [last]).came_loose
    assert bool(words) == told and (not told or words.endswith("m came loose, and 1 more"))
    assembly, last = parted(share, 1, 0.0)
    words = at_rest(assembly, [last]).came_loose
    assert bool(words) == told and (not told or words == "block 2 at (0.1, 0.05, 0.55) m came loose")


@pytest.mark.parametrize("joint", [0, 1])
def test_a_contact_that_bears_holds_and_a_drive_or_a_factor_asks_for_a_fall(joint):
    assembly, last = parted(1e3, joint, -1.0)
    assert at_rest(assembly, [last]).came_loose == ""
    assembly, last = parted(1e3, joint, 0.0)
    assert at_rest(assembly, [last]).came_loose != ""
    assert at_rest(assembly, [last], **{FACTOR: np.zeros(2)}).came_loose == ""
    driven = assemble(small(TWO, [HELD], WEIGHT + '[drive]\non = "block"\ndirection = "z"\ndisplacement = "1 mm"\n'))
    assert at_rest(driven, [last]).came_loose == ""


@pytest.mark.parametrize(("share", "told"), EITHER_SIDE)
def test_swings_under_dead_loads_count_from_a_millionth_of_what_is_stored_on(share, told):
    assembly = assemble(small(TWO, [HELD], WEIGHT))
    assert at_rest(assembly, [frame(assembly)], share * 1e-6).swing_too_wide == (0.0625 if told else None)
    pushed = small(TWO, [HELD], WEIGHT + '[solver]\nmasses = "real"\nduration = "1 s"\n')
    motion = {"motion": [{"on": "block", "velocity": ["1 mm/s", "0 m/s", "0 m/s"]}]}
    assert at_rest(assemble(pushed.with_(motion)), [frame(assembly)], 0.0).swing_too_wide == 0.0625, "it is set off"


@pytest.mark.parametrize(("share", "told"), [(0.99, True), (1.01, False)])
def test_a_joint_whose_edge_crushed_does_not_rock_about_a_point(share, told):
    """It closes by 1 mm at its strength, and a tenth of that for good is a toe. Without a drive it is asked."""
    assembly = assemble(crushing_scene("small", 2))
    assembly = replace(assembly, scene=assembly.scene.model_copy(update={"drive": None}))
    left = assembly.joints.point[:, 0] < 0.5 * SIDE
    closing = np.zeros(len(left))
    closing[np.flatnonzero(left)[0]] = share * 0.1 * STRENGTH / 10e9
    last = frame(
        assembly, opening=np.where(left, -1e-4, 1e-4), normal_stress=np.where(left, -1e6, 0.0), crushing=closing
    )
    doubts = rocking.doubts(inspected(assembly, [last]))
    assert said(doubts, "opened on one side and turn about their outermost contact points") == told


def test_the_energy_of_crushing_is_not_asked_beside_the_factor_of_a_load():
    run = crushed("small", 6, 0.5)
    assert crushing_energy.doubts(run)
    run.outcome.history.rows[FACTOR] = np.zeros(len(run.outcome.history.rows[CRUSHING]))
    assert crushing_energy.doubts(run) == []


def test_a_block_that_shears_off_its_glue_came_loose_and_nothing_is_said_of_a_drive():
    """It hangs on the side of one that is held, by 0.2 MPa of cohesion, and is pressed down by more."""
    beside = box("beside", (0.6, 0, -0.1), (0.05, 0.1, 0.1), "units", 1)
    pushed = '[[traction]]\non = "beside.z+"\nstress = {z = "-2 MPa"}\nhistory = [["0 s", 0], ["1 s", 1]]\n'
    scene = small([GROUND, beside], [HELD], WEIGHT + pushed)
    strength = {"tensile_strength": "0.2 MPa", "cohesion": "0.2 MPa", "law": "brittle"}
    scene = scene.with_({f"contact.unit_unit.{key}": value for key, value in strength.items()})
    with pytest.raises(Stopped, match="runs away. Block 1 came loose: no joint that bears anything holds it"):
        laboratory.run(scene.with_({"kinematics": "rigid", "settle": {"steps": 2000}}))
