"""Bars between blocks: what a scene may say of them, and what they do, by hand."""

import numpy as np
import pytest

import masonry
from masonry.assembly import assemble as assembling
from masonry.assembly.assemble import assemble
from masonry.configuration import model_state
from masonry.elements.bars.bar_element import BarPlaces
from masonry.errors import SceneError
from masonry.limit_analysis.analysis import LimitSettings, analyse
from verification.scene_runs import load

HUNG = {
    "gravity": {"z": "-9.81 m/s^2"},
    "drive": None,
    "support": [{"on": "foot", "fix": "all"}, {"on": "block", "fix": ["x", "y", "rotation"]}],
    "bar.0.ends": [["0 m", "0 m", "0 m"], ["0 m", "0 m", "1 m"]],
    "gauge.0": {"name": "z", "at": "block", "direction": "z"},
}
STIFFNESS, WEIGHT = 1e6, 2.0 * 9.81


def hung(**changes):
    """A block of 2 kg that hangs on a bar of 1 MN/m and of 1 kN."""
    return load("block-on-a-bar", HUNG | {key.replace("__", "."): value for key, value in changes.items()})


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"bar.0.ends": [["0 m", "0 m", "0 m"], ["0 m", "0 m", "0 m"]]}, "a bar has a length"),
        ({"bar.0.slack": "1 mm", "bar.0.pretension": "1 N"}, "keep one of slack and pretension"),
        ({"bar.0.slack": "1 mm", "bar.0.compression": True}, "a bar is slack or pushes; leave out slack, or"),
        ({"bar.0.compression": "yes"}, "true or false"),
        ({"bar.0.compression": 1}, "true or false"),
        ({"bar.0.pretension": "2 kN"}, "strength times area is 1000 N"),
        ({"bar.0.repeat": 2}, "spacing: missing"),
        ({"bar.0.spacing": ["1 m", "0 m", "0 m"]}, "belongs to repeat"),
        ({"bar.0.youngs_modulus": "1 GPa"}, "did you mean 'young_modulus'"),
        ({"bar.0.streng": "1 MPa"}, "did you mean 'strength'"),
        ({"bar.0.name": "z"}, "is a column of the results already"),
    ],
)
def test_what_a_table_says_wrong_is_told_with_its_key(changes, said):
    with pytest.raises(SceneError, match=said):
        load("block-on-a-bar", HUNG | changes)


def test_an_end_lies_in_one_block():
    with pytest.raises(SceneError, match="first end at .* lies in no block; the nearest, block 1 .* is 0.05 m away"):
        assemble(hung(**{"bar.0.ends": [["0.1 m", "0 m", "0 m"], ["0 m", "0 m", "1 m"]]}))
    with pytest.raises(SceneError, match="lies in the joint of block 0"):
        assemble(masonry.load("wall-tied", {"bar.0.ends": [["0.6 m", "0.15 m", "0.3 m"], ["0.6 m", "3 m", "0.3 m"]]}))


def test_blocks_of_tets_hold_bars_at_their_surface():
    tets = {
        "kinematics": {"units": "tets"},
        "specimen.mesh": "fan",
        "material.units.young_modulus": "20 GPa",
        "material.units.poisson_ratio": 0.2,
        "support": [{"on": "foot", "fix": "all"}, {"on": "block", "fix": ["x", "y"]}],
    }
    with pytest.raises(SceneError, match="hold bars at their surface; the nearest place there is"):
        assemble(hung(**tets))
    ends = [["20 mm", "10 mm", "50 mm"], ["20 mm", "10 mm", "1.05 m"]]
    places = assemble(hung(**tets, **{"bar.0.ends": ends})).model.elements[0].places
    nodes = assemble(hung(**tets, **{"bar.0.ends": ends})).mesh.nodes
    assert places.fraction[0, 0] @ nodes[places.node[0, 0]] == pytest.approx([0.02, 0.01, 0.05])


@pytest.mark.parametrize("displacements", ["small", "large"])
def test_a_block_that_hangs_stretches_its_bar_by_its_weight(displacements):
    result = masonry.run(hung(displacements=displacements))
    rows, bars = result.history.rows, result.summary["bars"]
    assert rows["bar"][-1] == pytest.approx(WEIGHT, rel=1e-6) and rows["z"][-1] == pytest.approx(-WEIGHT / STIFFNESS)
    assert bars["yielded"] == 0 and result.history.unit("bar") == "N"
    assert rows["elastic_bars"][-1] == pytest.approx(0.5 * WEIGHT**2 / STIFFNESS)
    assert result.summary["energy_imbalance"] < 1e-10 and result.summary["force_balance"] < 1e-10
    assert result.summary["reactions"]["end"]["bars"]["force_n"][2] == pytest.approx(WEIGHT)


def test_a_pretension_lifts_the_block_and_is_work_from_outside():
    result = masonry.run(hung(**{"bar.0.pretension": "500 N"}))
    rows = result.history.rows
    assert rows["z"][-1] == pytest.approx((500.0 - WEIGHT) / STIFFNESS)  # nothing holds its ends apart
    assert rows["bar"][-1] == pytest.approx(WEIGHT, rel=1e-6)
    assert result.summary["energy_imbalance"] < 1e-10 and result.summary["dissipation_mismatch"] < 1e-6


def test_two_ends_in_one_block_do_nothing():
    still = masonry.run(hung(**{"bar.0.repeat": 1}))
    beside = {"ends": [["0 m", "0 m", "0 m"], ["20 mm", "0 m", "20 mm"]], "area": "1 cm^2", "young_modulus": "1 GPa"}
    bars = [{**beside, "pretension": "1 kN"}, hung().resolved()["bar"][0]]
    moved = masonry.run(hung(bar=bars))
    assert moved.history.rows["z"][-1] == pytest.approx(still.history.rows["z"][-1], rel=1e-9)
    assert moved.summary["bars"]["largest_force_n"] == pytest.approx(1e3)


def test_the_step_of_a_bar_is_proven_and_sharp():
    """Of a block of mass m on a spring k the bound is 2 sqrt(m / k)."""
    scene = hung(settle={"steps": 0}, solver={"masses": "real", "damping": 0, "duration": "1 s"})
    assert assemble(scene).model.bound == pytest.approx(2.0 * np.sqrt(2.0 / STIFFNESS))
    stiff = {"displacements": "large", "bar.0.young_modulus": "1e6 GPa", "bar.0.strength": None}
    large = assemble(scene.with_(stiff)).model
    assert 0.5 < large.bound / (2.0 * np.sqrt(2.0 / (1e5 * STIFFNESS))) <= 1.0


class OtherBars(BarPlaces):
    """Bars whose element has a name of its own."""

    def element(self, site):
        other = super().element(site)
        other.name = "other_bars"
        return other


def test_two_elements_of_one_name_are_refused(monkeypatch):
    conditions_of = assembling.conditions_of

    def twice(*arguments):
        conditions = conditions_of(*arguments)
        conditions.elements = [*conditions.elements, *conditions.elements]
        return conditions

    monkeypatch.setattr(assembling, "conditions_of", twice)
    with pytest.raises(ValueError, match="two elements of a model are named 'bars'"):
        assemble(hung())
    monkeypatch.undo()
    model = assemble(hung()).model
    model.elements[0].name, model.elements[0].written = "rigid", lambda: {"v": np.zeros(1)}
    with pytest.raises(ValueError, match="two parts of a model write 'rigid.v'"):
        model_state.state(model)


@pytest.mark.parametrize("displacements", ["small", "large"])
def test_bars_of_two_elements_do_what_they_do_as_one(displacements, monkeypatch):
    """Of a block that two slanting bars hold against a weight that lifts it."""
    ends = [["20 mm", "10 mm", "-40 mm"], ["5 m", "20 mm", "-4.97 m"]]
    other = {"ends": [["-30 mm", "0 mm", "-45 mm"], ["5.01 m", "0 mm", "-4.98 m"]], "area": "3 cm^2"}
    bars = [hung(**{"bar.0.ends": ends, "bar.0.fixed_end": None}).resolved()["bar"][0]]
    bars.append(bars[0] | other | {"pretension": "2 N", "name": "other"})
    scene = hung(bar=bars, displacements=displacements, settle={"steps": 300}, gravity={"z": "9.81 m/s^2"})
    whole = masonry.run(scene).history.rows
    conditions_of = assembling.conditions_of

    def apart(*arguments):
        conditions = conditions_of(*arguments)
        (both,) = (one for one in conditions.elements if isinstance(one, BarPlaces))
        arrays = {name: value for name, value in vars(both).items() if name != "columns"}
        one, other = (
            BarPlaces(**{name: value[[k]] for name, value in arrays.items()}, columns={name: 0})
            for k, name in ((1, "other"), (0, "bar"))
        )
        conditions.elements = [one, OtherBars(**vars(other))]
        return conditions

    monkeypatch.setattr(assembling, "conditions_of", apart)
    rows = masonry.run(scene).history.rows
    for name in ("bar", "other", "z", "elastic_bars", "external_work", "imbalance"):
        scale = np.abs(whole[name if name != "imbalance" else "external_work"]).max()
        assert rows[name] == pytest.approx(whole[name], rel=1e-9, abs=1e-9 * scale)
    assert min(whole["other"].max(), whole["bar"].max()) > 1.0, "both pull"


def test_what_a_bar_remembers_is_kept_and_put_back():
    model = assemble(hung()).model
    names = {name for name in model_state.state(model) if name.startswith("bars.")}
    assert {"bars.tension", "bars.plastic", "bars.plastic_work", "bars.tightening"} < names
    saved = model_state.state(model)
    bars = model.elements[0].bars
    bars.plastic[:] = 1.0
    model_state.restore(model, saved)
    assert bars.plastic[0] == 0.0
    assert assemble(masonry.load("couplet")).model.elements == ()


def test_modes_have_the_stiffness_of_bars():
    result = masonry.modes(hung())
    assert result.frequencies[0] == pytest.approx(np.sqrt(STIFFNESS / 2.0) / (2.0 * np.pi))


BY_HAND = 0.125 + 2.0 * 13.3e6 * 1.13e-4 * 1.65 / (0.5 * 2200.0 * 9.81 * 3.0 * 2.4 * 0.3 * 2.4)


@pytest.mark.parametrize(
    "wishes",
    [LimitSettings(), LimitSettings(dilation=False), LimitSettings(sides=8), LimitSettings(strength=False)],
)
def test_a_tied_wall_turns_about_its_foot_while_its_ties_yield(wishes):
    result = analyse(masonry.load("wall-tied"), wishes)
    assert result.factor == pytest.approx(BY_HAND, rel=1e-6)
    assert result.elements[0].force == pytest.approx(2 * [13.3e6 * 1.13e-4], rel=1e-6)
    assert result.as_data()["bars"]["yielding"] == [0, 1] and "2 of 2 yield" in f"{result}"


def test_ties_that_are_pushed_bear_nothing_unless_they_are_struts():
    back = {"limit": {"pattern": "weight", "direction": "y"}}
    assert masonry.limit(masonry.load("wall-tied", back)).factor == pytest.approx(0.125, rel=1e-6)
    strut = masonry.limit(masonry.load("wall-tied", back | {"bar.0.compression": True}))
    assert strut.factor == pytest.approx(BY_HAND, rel=1e-6) and (strut.elements[0].force < 0.0).all()


def test_a_limit_analysis_says_that_it_leaves_out_slack():
    slack = "; bars bear at once, whatever their slack"
    assert slack in masonry.limit(masonry.load("wall-tied", {"bar.0.slack": "2 mm"})).assumed
    back = {"limit": {"pattern": "weight", "direction": "y"}}  # the ties bear nothing then
    unloaded = masonry.limit(masonry.load("wall-tied", back | {"bar.0.slack": "2 mm"}))
    assert slack not in unloaded.assumed and slack not in masonry.limit("wall-tied").assumed


def test_joints_that_crush_and_ties_that_yield():
    """About a toe of stress fc the pivot lies half of the pressed width inside: a little less than about the edge."""
    result = analyse(masonry.load("wall-tied"), LimitSettings(crushing=5e6))
    assert 0.98 * BY_HAND < result.factor < BY_HAND


def test_pictures_draw_bars_and_mark_those_that_yielded():
    limit, scene = masonry.limit("wall-tied"), masonry.load("wall-tied")
    from masonry.limit_analysis.pictures import mechanism_figure
    from masonry.pictures.overlays.bar_lines import ELASTIC, YIELDED, bar_keys

    drawn = [one for one in mechanism_figure(limit, "side").axes[0].collections if one.get_zorder() == 3.8]
    assert len(drawn) == 1 and len(drawn[0].get_segments()) == 2
    assert [key.get_color() for key in bar_keys(scene.bar)] == [ELASTIC]
    assert [key.get_color() for key in bar_keys(scene.bar, np.array([True, False]))] == [ELASTIC, YIELDED]
    assert bar_keys(()) == []


@pytest.mark.parametrize("frame", ["base", "inertia"])
def test_an_end_in_space_does_not_move_with_the_ground(frame):
    """In the frame of the ground it would: the two were not one motion."""
    bar = {"ends": [["0 m", "0 m", "0 m"], ["0 m", "0 m", "9 m"]], "area": "1 cm^2", "young_modulus": "1 GPa"}
    with pytest.raises(
        SceneError, match=r"bar\.0\.fixed_end.* stays in space, while \[ground\] moves .* \[\[support\]\]"
    ):
        load("block-on-ground", {"ground.as": frame, "bar": [bar | {"fixed_end": "second"}]})


def test_a_bar_to_a_block_that_is_held_shakes_alike_on_a_moving_base_and_by_forces_of_inertia():
    """What the refusal above advises. A block of 2 kg on a rod of 1 MN/m swings with 112.5 Hz on ground of acceleration
    a0 sin w t: relative to it by -a0/(w0^2 - w^2) (sin w t - w/w0 sin w0 t)."""
    rock = {"name": "rock", "origin": ["-1.1 m", "-50 mm", "-50 mm"], "size": 3 * ["100 mm"], "unit": 2}
    scene = load("block-on-a-bar")
    tables = scene.resolved()
    boxes = [*tables["specimen"]["box"], rock]
    supports = [*tables["support"], {"on": "rock", "fix": "all"}]
    ground = {"x": "20 m / (1 s * 1 s) * sin(2 pi t / 0.1 s)"}
    keys = {"bar.0.fixed_end": None, "bar.0.strength": None, "bar.0.compression": True, "bar.0.young_modulus": "10 GPa"}
    keys |= {"drive": None, "specimen.box": boxes, "support": supports, "damping": {}, "solver.rows": 200}
    keys |= {"solver.step_fraction": 0.05, "solver.masses": "real"}
    keys["gauge"] = [{"name": "x", "at": "block", "direction": "x", "relative_to": "rock"}]
    moved = [
        masonry.run(scene.with_(keys | {"ground": ground | {"duration": "0.1 s", "as": frame}})).history.rows["x"]
        for frame in ("inertia", "base")
    ]
    time, w0, w, a0 = np.linspace(0.0, 0.1, 20_001), np.sqrt(1e6 / 2.0), 20.0 * np.pi, 20.0
    exact = a0 / (w0**2 - w**2) * (np.sin(w * time) - w / w0 * np.sin(w0 * time))
    assert np.abs(moved[0]).max() == pytest.approx(np.abs(exact).max(), rel=5e-3)
    assert moved[0] == pytest.approx(moved[1], abs=1e-8 * np.abs(exact).max())


@pytest.mark.parametrize("displacements", ["small", "large"])
def test_what_a_bar_gives_to_its_end_in_space_counts_with_the_supports(displacements):
    """Of a rod at 45 deg it is half of its stiffness times the displacement. A drive to an accuracy is as fast as where
    a block holds the other end."""
    ends = [["0 mm", "0 mm", "0 mm"], ["-2 m", "0 mm", "2 m"]]
    rod = {"bar.0.ends": ends, "bar.0.strength": None, "bar.0.young_modulus": "200 GPa", "displacements": displacements}
    drive = {"drive.history": None, "drive.steps": None, "drive.displacement": "0.4 mm", "drive.accuracy": "5 %"}
    dry = {"law": "friction", "contact.unit_unit.tan_friction_angle": 0}  # such a drive goes by the forces of both ends
    scene = load("block-on-a-bar", rod | drive | dry | {"solver.rows": 50})
    rock = {"name": "rock", "origin": ["-2.1 m", "-50 mm", "1.95 m"], "size": 3 * ["200 mm"], "unit": 2}
    boxes = [*scene.resolved()["specimen"]["box"], rock]
    supports = [*scene.resolved()["support"], {"on": "rock", "fix": "all"}]
    held = scene.with_({"bar.0.fixed_end": None, "specimen.box": boxes, "support": supports})
    space, block = masonry.run(scene), masonry.run(held)
    for result in (space, block):
        assert abs(result.history.rows["force"][-1]) == pytest.approx(np.sqrt(2.0) * 1e3, rel=1e-3)
        assert result.summary["reaction_mismatch_max"] < 1e-9
    assert space.summary["steps"] == block.summary["steps"]


@pytest.mark.parametrize("strength", [None, "10 MPa"])
def test_a_bar_that_is_pulled_aside_turns_by_thirty_degrees_and_its_force_with_it(strength):
    """A block that a rod of 1 m holds from above goes aside: over the first steps next to nothing is stored."""
    bar = {"name": "bar", "ends": [["0 m"] * 3, ["0 m", "0 m", "1 m"]], "fixed_end": "second", "area": "1 cm^2"}
    rod = [bar | {"young_modulus": "10 GPa"} | ({"strength": strength} if strength else {})]
    aside = {"displacements": "large", "drive.history": ["577.35 mm", "300 mm"], "drive.steps": 10_000}
    result = masonry.run(load("block-on-a-bar", aside | {"bar": rod}))
    rows = result.history.rows
    longer, plastic, force = np.hypot(1.0, rows["x"]) - 1.0, 0.0, []
    for length in longer:
        plastic = max(plastic, length - 1e-3) if strength else 0.0
        force.append(max(STIFFNESS * (length - plastic), 0.0))
    assert np.abs(rows["bar"] - force).max() < 1e-9 * max(force)
    last = rows["x"].argmax()
    pushes = force[last] * rows["x"][last] / (1.0 + longer[last])
    assert rows["stress"][last] * result.summary["section_m2"] == pytest.approx(pushes, rel=1e-3)
    assert result.summary["energy_imbalance"] < 1e-12
