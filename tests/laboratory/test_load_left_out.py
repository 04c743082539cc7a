"""A run that leaves out the load of [limit] says so; one of a vehicle is refused."""

import pytest

import masonry
from masonry.assembly.assemble import assemble
from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.laboratory.remarks.scenes.load_left_out import doubts
from masonry.scene import load

ARCH, BRIDGE = "arch-own-weight", "bridge-single-span"
HEAVY = {"vehicle.axles": ["6000 kN", "12000 kN"], "vehicle.spacings": ["1.5 m"], "vehicle.direction": "x"}
NONE = {"limit.accuracy": "none"}
WEIGHT = {"limit": {"pattern": "weight", "direction": "y"}}
FORCE = {"limit": {"pattern": "force", "on": "keystone", "force": {"z": "-1 kN"}}}
TRACTION = {"limit": {"pattern": "traction", "on": "keystone.z+", "stress": {"z": "-1 kPa"}}}
TILT = {"limit": {"pattern": "tilt", "about": "y"}}


def named(result) -> set[str]:
    """Its doubts."""
    return {doubt.name for doubt in result.doubts}


def raised(scene: str, changes: dict) -> list[str]:
    """The sentences of the doubt about a scene."""
    return [doubt.sentence for doubt in doubts(assemble(load(scene, changes)))]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (FORCE, "the force on 'keystone'"),
        (TRACTION, "the traction on 'keystone.z+'"),
        (WEIGHT, "the weight along another direction"),
        (TILT, "gravity turned about an axis"),
    ],
)
def test_each_load_that_a_run_leaves_out_is_told(changes, words):
    (sentence,) = raised(ARCH, changes)
    assert sentence == f"a run leaves out the load of [limit], {words}: its answer is that of the other loads alone"
    grows = {"limit": changes["limit"] | {"accuracy": "1 %"}}
    assert raised(ARCH, grows) == [], "a run applies it"


@pytest.mark.parametrize(
    ("scene", "changes"),
    [
        (ARCH, {"limit": None}),
        (ARCH, WEIGHT | {"gravity.y": "1 m/s^2"}),
        (ARCH, {"limit": {"pattern": "weight", "direction": "-z"}}),
        ("wall-ws100", {}),
        ("facade-tilted", {}),
        ("wall-out-of-plane", {}),
        ("wall-tilted", {}),
    ],
)
def test_nothing_is_told_where_a_run_has_this_load_or_one_in_its_place(scene, changes):
    assert raised(scene, changes) == []


def test_weight_the_other_way_is_left_out():
    assert raised(ARCH, WEIGHT | {"gravity.y": "-1 m/s^2"})


def test_a_run_under_dead_loads_alone_is_taken_with_care_unless_that_is_said_to_be_meant():
    result = masonry.run(load(ARCH, FORCE))
    assert result.verdict == "with care"
    assert named(result) == {"load_left_out"} and result.summary["left_out"] == ""
    meant = masonry.run(ARCH)
    assert named(meant) == set() and meant.summary["left_out"] == "the force on 'keystone'"
    assert "left out           the force on 'keystone' (limit.accuracy = 'none')" in str(meant)
    assert named(masonry.run(load(ARCH, {"limit": None}))) == set()


def test_an_accuracy_takes_the_place_of_none():
    assert load(ARCH).limit.run_accuracy is None and not load(ARCH).grows
    assert load(ARCH, {"limit.accuracy": "1 %"}).limit.run_accuracy == 0.01
    with pytest.raises(SceneError, match=r"^limit.accuracy: .*; or 'none', by which runs leave this load out"):
        load(ARCH, {"limit.accuracy": "nothing"})
    with pytest.raises(SceneError, match="^limit.accuracy: 'None' is not allowed; did you mean 'none', by which runs"):
        load(ARCH, {"limit.accuracy": "None"})
    with pytest.raises(SceneError, match=r"^limit.up_to: a run whose load grows ends there"):
        load(ARCH, {"limit.up_to": 3})


def test_a_bridge_without_its_axles_has_its_dead_loads_alone():
    result = masonry.run(load(BRIDGE, NONE))
    assert named(result) == {"closed_joints"} and result.summary["left_out"].startswith(
        "the axle of the vehicle, 100 kN"
    )
    weight = masonry.run(load(BRIDGE, {"vehicle": None, "limit": None}))
    reactions = [one.summary["reactions"]["end"]["support.0"]["force_n"] for one in (result, weight)]
    assert reactions[0] == reactions[1]


@pytest.mark.parametrize("place", [{}, {"vehicle.position": "1.5 m"}])
def test_a_run_never_leaves_out_a_vehicle(place):
    scene = load(BRIDGE, HEAVY | place)
    with pytest.raises(SceneError, match=r"^limit.accuracy: missing; .* leaves out the axles .* vehicle.position"):
        masonry.run(scene)
    (warning,) = [line for line in masonry.check(scene)["warnings"] if "vehicle" in line]
    assert "is refused" in warning and "limit.accuracy = '1 %'" in warning and "`masonry limit`" in warning


def test_the_command_refuses_it_too(tmp_path, capsys):
    assert main(["run", BRIDGE, "--quiet", "--out", str(tmp_path / "out")]) == 2
    assert "limit.accuracy: missing" in capsys.readouterr().err
    assert not (tmp_path / "out" / "summary.json").exists()
    assert main(["check", BRIDGE]) == 0
    assert "leaves out the load of [limit]" in " ".join(capsys.readouterr().out.split())
