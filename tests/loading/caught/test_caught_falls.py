"""A fall that ends at rest is none: both factors, and the travel between, of loads with slack, gaps and stops."""

import numpy as np
import pytest

import masonry
from masonry.assembly.assemble import assemble
from masonry.configuration import energy, model_state
from masonry.configuration.configuration import configuration_of
from masonry.errors import SceneError
from masonry.judgement.evidence import Evidence
from masonry.judgement.sentence import moved_before, trust
from masonry.laboratory.text import summary_text
from masonry.loading.collapse.catching import closings
from masonry.runtime import state_file
from tests.loading.caught.cases import CASES, Case
from tests.loading.caught.scenes import Bar, Boxed, scene

LEAST = 1e-3
"""Of a factor: by how much an interval may miss it, as vertex points bear elastically."""
B = Boxed("b", (0.0, 0.0, 0.0), (0.4, 1.0, 0.4))
CHAIN = Bar((0.0, 0.5, 0.05), (-2.0, 0.5, 0.05), 0.005, 1500.0)


def marked(case: Case):
    """Large displacement compiles other steps and is followed farther."""
    return pytest.param(case, id=case.name, marks=[pytest.mark.slow] if case.slow else [])


@pytest.mark.parametrize("case", [marked(case) for case in CASES])
def test_a_load_is_borne_after_the_falls_that_come_to_rest(case):
    result = masonry.run(case.scene)
    load = result.summary["collapse_load"]
    assert [fall["travel_m"] for fall in load["caught"]] == pytest.approx(case.travels, rel=0.07)
    begins = (load["borne"], load["falls"]) if not case.travels else (load["moves_from"], load["caught"][0]["falls"])
    assert begins[0] <= case.moves * (1.0 + LEAST) and begins[1] >= case.moves * (1.0 - LEAST)
    if case.bears is None:
        assert load["falls"] is None and [doubt.name for doubt in result.doubts] == ["nothing_fell"]
    else:
        assert load["borne"] <= case.bears * (1.0 + 2 * LEAST) and load["falls"] >= case.bears * (1.0 - 2 * LEAST)
        assert load["falls"] - load["borne"] <= 0.005 * load["falls"] or not case.moves
    assert load["undecided"] == 0 and result.summary["energy_imbalance"] < 1e-12
    assert all(fall["travel_m"] <= load["travel_m"] for fall in load["caught"])


def test_an_engineer_is_told_from_which_load_on_it_moves_by_how_far_and_what_it_bears_then():
    result = masonry.run(scene(B, friction=0.5, bars=[CHAIN]))
    words = " ".join(summary_text(result.summary).split())
    assert "0.499083 is borne before it moves; at 0.500458 it moves by 5.022 mm (block 1) and rests" in words
    assert moved_before(Evidence(result.summary)) == ", beyond 0.4991 only after it moved by up to 5.022 mm"
    assert [doubt.name for doubt in result.doubts] == ["sway"], "its way counts, in small displacement"


def test_a_bar_that_would_bear_only_after_more_than_a_fall_is_told_with_the_travel_to_ask_for():
    """Its slack is two thirds of the block's size: by default a fall is no longer than that size."""
    far = Bar(CHAIN.first, CHAIN.second, 0.8, 1500.0)
    result = masonry.run(scene(B, friction=0.5, bars=[far], more="[solver]\nslip_limit = 1000"))
    load, (doubt,) = result.summary["collapse_load"], result.doubts
    assert doubt.name == "later_rest" and doubt.value == pytest.approx(0.8, rel=0.01)
    assert load["travel_m"] == pytest.approx(0.16 ** (1 / 3)) and load["caught"] == []
    assert doubt.advice == 'where it may move as far, set limit.travel = "1.2e+03 mm"'


def test_a_stop_in_small_displacement_is_no_catch_but_the_run_says_that_blocks_meet():
    """Contacts are those of the shape as drawn. The stop is farther than a fall is followed to show who moves."""
    stop = Boxed("stop", (0.415, 0.0, 0.0), (0.3, 1.0, 0.5), is_support=True)
    result = masonry.run(scene(B, stop, friction=0.5))
    assert result.summary["collapse_load"]["falls"] == pytest.approx(0.5, rel=0.005)
    assert result.summary["verdict"] == "with care" and [doubt.name for doubt in result.doubts] == ["meeting"]
    assert "'b' and 'stop' meet around" in trust(result.summary)


def test_a_wall_that_turns_too_far_before_its_chain_is_tight_is_told_in_small_displacement():
    """It would turn by 50 mm over 1.5 m, more than small displacement allows."""
    wall, chain = Boxed("b", (0.0, 0.0, 0.0), (0.4, 1.0, 2.0)), Bar((0.0, 0.5, 1.5), (-2.0, 0.5, 1.5), 0.05, 4000.0)
    result = masonry.run(scene(wall, friction=0.7, bars=[chain]))
    names = {doubt.name for doubt in result.doubts}
    assert result.summary["verdict"] == "with care" and {"falls_by_turning", "later_rest"} <= names
    assert result.summary["collapse_load"]["later_m"] == pytest.approx(
        0.05 / 1.5 * np.hypot(1.02, 0.8 ** (1 / 3)), rel=0.02
    )
    assert {doubt.advice for doubt in result.doubts} == {'take displacements = "large"'}


def test_a_fall_goes_on_from_a_snapshot_in_its_midst_bit_by_bit(tmp_path):
    case = next(case for case in CASES if case.name == "one chain after the other")
    one, other = (assemble(case.scene) for _ in range(2))
    first, second = (assembly.plan.loading(assembly.model, 100) for assembly in (one, other))
    while not (first.phase.name == "dropping" and first.phase.looked == 8):
        advance(one.model, first)
    state_file.write(tmp_path / "state.npz", {"model": model_state.state(one.model), "loading": first.state()})
    snapshot = state_file.read(tmp_path / "state.npz")
    model_state.restore(other.model, snapshot["model"])
    second.restore(snapshot["loading"])
    while advance(one.model, first) | advance(other.model, second):
        pass
    assert len(first.outcome(0.0).caught) == 2 and second.outcome(0.0).caught == first.outcome(0.0).caught
    assert second.outcome(0.0).borne == first.outcome(0.0).borne
    ends = (model_state.state(assembly.model).values() for assembly in (one, other))
    assert all(np.array_equal(*both) for both in zip(*ends, strict=True))


def advance(model, loading) -> bool:
    """Take a chunk of steps; whether there was one."""
    chunk = loading.next()
    if chunk is not None:
        configuration, force = configuration_of(model), np.zeros(chunk.steps)
        configuration.advance(chunk, 1, 0, chunk.steps - 1, force)
        before = energy.velocities(model)
        configuration.advance(chunk, 1, chunk.steps - 1, 1, force[-1:])
        loading.feel(0, before)
    return chunk is not None


PRESS = """
law = "friction"
kinematics = "rigid"
[specimen]
kind = "boxes"
section = "0.2 m^2"
box = [{name = "lower", origin = ["0 m", "0 m", "0 m"], size = ["1 m", "0.2 m", "0.2 m"], unit = 0},
  {name = "upper", origin = ["0 m", "0 m", "0.2 m"], size = ["1 m", "0.2 m", "2 m"], unit = 1}]
points_per_edge = {x = 10, y = 2, z = 1}
contact_points = "gauss"
[material.units]
density = "2000 kg/m^3"
[contact.unit_unit]
normal_stiffness = "5e+10 Pa/m"
shear_stiffness = "2e+10 Pa/m"
tan_friction_angle = 2.0
crushing = "cap"
compressive_strength = "5 MPa"
fracture_energy_compression = "8 N/mm"
closing_at_peak = "0.1 mm"
[[support]]
on = "lower"
fix = "all"
[[support]]
on = "upper"
fix = ["x", "y", "rotation"]
[[traction]]
on = "upper.z+"
stress = {z = "-1 MPa"}
[limit]
pattern = "traction"
on = "upper.z+"
stress = {z = "-1 MPa"}
accuracy = "1 %"
up_to = 20
"""


def test_a_fall_by_crushing_is_a_fall_as_any_other(tmp_path):
    """It bears (1 + factor) MPa of 5."""
    path = tmp_path / "press.toml"
    path.write_text(PRESS, encoding="utf-8")
    result = masonry.run(path)
    load = result.summary["collapse_load"]
    assert load["borne"] <= 4.0 <= load["falls"] and result.summary["verdict"] != "stopped"
    assert {doubt.name for doubt in result.doubts} <= {"few_points"}, "by less than its points may be off"
    assert load["moving"] == 1 and result.history.rows["load_factor"][-1] == load["falls"]


def test_a_travel_needs_a_load_that_grows():
    with pytest.raises(SceneError, match="limit.travel: a run whose load grows takes what moves farther for a fall"):
        scene(B, friction=0.5, limit='pattern = "weight"\ndirection = "x"\ntravel = "5 mm"').with_(
            {"limit.accuracy": None}
        )


def test_gaps_close_after_as_many_times_the_motion_as_are_left_of_them():
    then, now = [4.0, 4.0, 1.0, -1.0, 2.0], [3.0, 0.0, 1.5, -2.0, 2.0]
    assert closings(np.array(then), np.array(now)).tolist() == [3.0, 0.0, *3 * [float("inf")]]
