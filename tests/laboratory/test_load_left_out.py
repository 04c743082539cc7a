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
WEIGHT = {"limit": {"pattern": "weight", "direction": "y"}}
FORCE = {"limit": {"pattern": "force", "on": "keystone", "force": {"z": "-1 kN"}}}
TRACTION = {"limit": {"pattern": "traction", "on": "keystone.z+", "stress": {"z": "-1 kPa"}}}
TILT = {"limit": {"pattern": "tilt", "about": "y"}}


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


def test_a_run_under_dead_loads_alone_is_taken_with_care():
    result = masonry.run(ARCH)
    assert result.verdict == "with care"
    assert [doubt.name for doubt in result.doubts] == ["load_left_out"]
    assert masonry.run(load(ARCH, {"limit": None})).verdict == "sound"


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
