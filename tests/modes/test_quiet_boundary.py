"""Quiet boundaries: dashpots on faces, and waves that come in through them."""

import numpy as np
import pytest
from scipy.linalg import expm

import masonry
from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from verification.references.swinging_stack import STACK, boxes, keys_of
from verification.scene_runs import load, result_of

SOFT = {"material.units.young_modulus": "10 GPa", "material.units.poisson_ratio": 0.0}
WAVE = {"x": "1 mm/s * 0.5 * (1 - cos(2 * pi * t / 2 ms))", "quantity": "velocity", "duration": "2 ms"}
BLOCK = {"specimen.box": [boxes(STACK)[1]], "support": []}
"""One block of 0.5 x 0.2 x 0.25 m, held by nothing."""


def keys(kinematics, quiet, **more):
    return keys_of(STACK) | SOFT | {"kinematics": kinematics, "quiet": quiet, "specimen.mesh_size": "150 mm"} | more


def test_an_affine_block_stops_as_its_two_equations_say():
    """Nothing but x: m t'' = -Z A v, m a^2/12 H'' = Z A v a/2 - V E H with the velocity v = t' - a/2 H' of the face."""
    base = keys("affine", [{"on": "block 1.x-"}], **BLOCK) | {"solver.duration": "4 ms", "solver.step_fraction": 0.1}
    motion = {"motion": [{"on": "block 1", "velocity": ["1 mm/s", 0, 0]}]}
    gauge = {"gauge": [{"name": "face", "at": "block 1", "direction": "x"}], "solver.rows": 200}
    result = result_of("stack", base | motion | gauge)
    modulus, long = 10e9, STACK.width
    impedance = np.sqrt(modulus * STACK.density) * STACK.depth * STACK.height
    mass = STACK.mass, STACK.mass * long**2 / 12.0
    face = np.array([1.0, -0.5 * long])
    drag = impedance * np.outer(face, face) / np.array(mass)[:, None]
    stiff = np.diag([0.0, modulus * STACK.mass / STACK.density]) / np.array(mass)[:, None]
    system = np.block([[np.zeros((2, 2)), np.eye(2)], [-stiff, -drag]])
    time, moved = result.history.rows["time"], result.history.rows["face"]
    half = 0.5 * float(result.summary["time_step_s"])  # a block has its velocity in the middle of the first step
    exact = np.array([(expm(system * (t - half)) @ [1e-3 * half, 0.0, 1e-3, 0.0])[0] for t in time])
    assert moved == pytest.approx(exact, abs=5e-4 * exact.max())
    way = 1e-3 * (STACK.mass / impedance + half)
    assert moved[-1] == pytest.approx(way, rel=1e-6), "what a dashpot alone would let it go"


def test_a_face_has_the_moments_of_its_area():
    rows = assemble(load("stack", keys("affine", [{"on": "block 1.x-"}], **BLOCK))).model.elements[0].rows[1]
    area = STACK.depth * STACK.height
    normal, shear = np.sqrt(10e9 * STACK.density), np.sqrt(5e9 * STACK.density)
    drag = rows.drag[0]
    known = {(0, 0): 1.0, (3, 3): STACK.width**2 / 4.0, (4, 4): STACK.depth**2 / 12.0, (5, 5): STACK.height**2 / 12.0}
    for place, square in known.items():
        assert drag[place] == pytest.approx(normal * area * square)
    assert drag[1, 1] == pytest.approx(shear * area) and drag[0, 3] == pytest.approx(-normal * area * STACK.width / 2)
    assert drag == pytest.approx(drag.T) and np.linalg.eigvalsh(drag).min() > -1e-9 * drag.max()


@pytest.mark.parametrize("second", ["block 1.x-", "x = 0 mm"])
def test_a_face_that_two_quiet_boundaries_name_is_refused(second):
    """Its dashpots would act twice, and send a third of a wave back: (2 Z - Z)/(2 Z + Z)."""
    place = boxes(STACK)[1] | {"origin": ["0 mm", *boxes(STACK)[1]["origin"][1:]]}
    twice = [{"on": "block 1.x+"}, {"on": "block 1.x-"}, {"on": second, "p_speed": "100 m/s"}]
    with pytest.raises(SceneError, match=rf"quiet\.2\.on = '{second}': quiet\.1 has some of these faces already"):
        assemble(load("stack", keys("affine", twice, **BLOCK | {"specimen.box": [place]})))


@pytest.mark.parametrize("kinematics", ["affine", "tets"])
def test_a_wave_through_the_foot_of_a_stack_brings_it_to_rest_elsewhere_and_the_ledger_closes(kinematics):
    """The stack ends where the wave has put it: twice its velocity at a free end, so twice its displacement. What bends
    it runs up and down for longer."""
    gauge = {"gauge": [{"name": "top", "at": "block 4", "direction": "x"}]}
    quiet = [{"on": "foot.z-", "wave": WAVE}]
    scene = keys(kinematics, quiet, support=[], motion=[], **gauge) | {"solver.duration": "400 ms"}
    result = result_of("stack", scene)
    rows, summary = result.history.rows, result.summary
    assert np.abs(rows["imbalance"]).max() < 1e-10 * rows["external_work"].max()
    assert summary["force_balance"] < 1e-9, "with what the dashpots take"
    assert rows["top"][-1] == pytest.approx(2.0 * 0.5e-3 * 2e-3, rel=0.02)
    assert rows["kinetic"][-1] < 1e-2 * rows["kinetic"].max()


def test_what_a_support_holds_stays_and_weight_rests_on_it():
    support = {"support": [{"on": "foot", "fix": ["z"]}], "gravity": {"z": "-9.81 m/s^2"}, "settle.steps": 4000}
    scene = keys("affine", [{"on": "foot.z-", "wave": WAVE}], motion=[], **support)
    result = result_of("stack", scene | {"solver.duration": "100 ms", "solver.damping": 0.3})
    rows = result.history.rows
    assert np.abs(rows["imbalance"]).max() < 1e-10 * rows["external_work"].max()
    blocks = result.history.frames[-1].corners[:, 2].min()
    assert -1e-4 < blocks < 0.0
    reactions = result.summary["reactions"]
    assert reactions, "what the support bears is told"
    assert result.summary["force_balance"] < 1e-9


def test_large_displacement_has_the_same_waves():
    gauge = {"gauge": [{"name": "top", "at": "block 1", "direction": "x"}], "solver.duration": "3 ms"}
    one = BLOCK | {"motion": [], "specimen.mesh_size": "90 mm"}
    for kinematics in ("affine", "tets"):
        quiet = [{"on": "block 1.x-", "wave": WAVE}, {"on": "block 1.x+"}]
        small = keys(kinematics, quiet, **one) | gauge
        large = small | {"displacements": "large", "solver.time_step": assembled_step(small)}
        results = [result_of("stack", scene) for scene in (small, large)]
        assert max(result.summary["force_balance"] for result in results) < 1e-9
        ends = [result.history.rows["top"][-1] for result in results]
        assert ends[1] == pytest.approx(ends[0], rel=1e-4) and ends[0] > 5e-7


def assembled_step(scene):
    return f"{0.5 * assemble(load('stack', scene)).model.dt!r} s"


def test_the_time_step_is_that_without_and_no_quiet_boundary_is_none():
    plain = assemble(load("stack", keys("affine", []))).model
    quiet = assemble(load("stack", keys("affine", [{"on": "block 4.z+"}]))).model
    assert plain.elements == () and quiet.dt == plain.dt
    slow = {"on": "block 4.z+", "density": "1e9 kg/m^3", "p_speed": "1e4 m/s"}
    stiff = keys("affine", [slow]) | {"solver.duration": "20 ms"}
    rows = result_of("stack", stiff).history.rows
    assert rows["kinetic"][-1] <= rows["kinetic"].max() and np.isfinite(rows["kinetic"]).all()


def test_the_impedance_of_what_goes_on_may_be_another():
    rows = {}
    for times, more in ((1.0, {}), (3.0, {"density": "6000 kg/m^3"})):
        quiet = [{"on": "block 1.x-"} | more]
        rows[times] = assemble(load("stack", keys("affine", quiet, **BLOCK))).model.elements[0].rows[1].drag
    assert np.abs(rows[3.0] - 3.0 * rows[1.0]).max() < 1e-12 * rows[3.0].max()


@pytest.mark.parametrize(
    ("kinematics", "quiet", "more", "reason"),
    [
        ("rigid", [{"on": "block 4.z+"}], {}, "rigid blocks have no waves"),
        ("affine", [{"on": "block 4"}], {}, "waves leave through faces"),
        ("affine", [{"on": "block 4.z+"}], {"solver.masses": "scaled"}, "real time|real masses|needs solver.masses"),
        ("affine", [{"on": "block 4.z+"}], {"gravity": {"z": "-9.81 m/s^2"}, "support": []}, "bears no weight"),
        ("affine", [{"on": "block 4.z+"}], {"ground": {"x": "0.1 g", "duration": "1 s"}}, "has no waves"),
        ("affine", [{"on": "block 4.z+", "wave": WAVE | {"on": "foot"}}], {}, "wave.on: unknown key; allowed: record"),
        ("affine", [{"on": "block 4.z+", "wave": {"x": "0.1 g"}}], {}, "duration"),
    ],
)
def test_what_cannot_be_quiet_is_refused(kinematics, quiet, more, reason):
    with pytest.raises(SceneError, match=reason):
        assemble(load("stack", keys(kinematics, quiet, **more)))


def test_modes_leave_it_out_and_say_so():
    modes = masonry.modes(load("stack", keys("affine", [{"on": "block 4.z+"}])), 3)
    assert "quiet boundaries are left out" in str(modes)


def test_a_record_that_cannot_be_read_is_told_under_the_key_of_its_wave(tmp_path):
    wave = {"record": str(tmp_path / "none.csv"), "x": "a", "quantity": "velocity"}
    with pytest.raises(SceneError, match="^quiet.wave.record: "):
        assemble(load("stack", keys("affine", [{"on": "block 1.x-", "wave": wave}], **BLOCK)))
