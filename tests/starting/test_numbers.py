"""First scenes of tasks hold the numbers of the user, and answer as closed forms and packaged scenes do."""

import tomllib

import numpy as np
import pytest

import masonry
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.starting.starting import NAMES, scene_of
from tests.docs.running import FOR_LIMIT_ANALYSIS

ODD = {
    "arch": {"span": 2.7, "rise": "650 mm", "thickness": 0.21, "voussoirs": 14, "load": "tilt"},
    "bridge": {"spans": "4,9,6,3.5", "axles": "60 kN,120,110 kN", "spacings": "3.5, 1350 mm", "cover": 0},
    "wall": {"length": 0.24, "height": 0.115, "top": "free", "modulus": "2500 MPa"},
    "facade": {"length": 3.3, "height": 2.9, "thickness": 0.37, "returns": 1.1, "door_width": "90 cm"},
    "house": {"width": 3.7, "height": 5, "ties": 3, "floor": "2.5 kN/m^2"},
    "earthquake": {"length": 1.7, "direction": "across", "peak": "0.25g", "soil": "D", "duration": 3},
    "couplet": {"length": 0.21, "pressure": "350 kPa", "tension": 0.1},
}


@pytest.mark.parametrize("task", NAMES)
@pytest.mark.parametrize("numbers", [{}, ODD], ids=["defaults", "odd"])
def test_every_task_makes_a_scene_that_is_checked_without_a_warning(task, numbers):
    report = laboratory.check(masonry.new(task, **numbers.get(task, {})))
    assert report["blocks"] > 0
    assert [line for line in report["warnings"] if not line.startswith(FOR_LIMIT_ANALYSIS)] == []


def test_a_bridge_is_the_packaged_one_of_the_same_numbers():
    made = masonry.new(
        "bridge", spans=5, rises=1.2, thickness=0.4, cover=0.2, axles=100, friction=0.7, density=2200, strip=1
    )
    made = made.with_({"specimen.arch.0.voussoirs": 25})
    assert masonry.limit(made).factor == pytest.approx(masonry.limit("bridge-single-span").factor, rel=1e-9)


def test_a_bridge_of_many_spans_has_its_piers_where_the_spans_put_them_and_a_road_above_its_highest_crown():
    bridge = masonry.new("bridge", spans=[8, 5.5, 3], pier_width=[1.5, 1.2], pier_height=2.5, cover=0.4)
    specimen = bridge.specimen.build()
    points = specimen.blocks.points
    corners = {round(float(x), 9) for x in points[(np.abs(points[:, 2]) < 1e-9), 0]}
    assert {0.0, 8.0, 9.5, 15.0, 16.2, 19.2} <= corners
    assert points[:, 2].min() < -2.5
    crown = points[specimen.blocks.face_points, 2].max()
    assert 0.0 <= bridge.fill[0].level - 0.4 - crown < 0.003  # between the chords of the ring and its circle
    assert bridge.vehicle.level == bridge.fill[0].level


def test_a_facade_that_nothing_holds_falls_where_its_weight_passes_its_edge():
    facade = masonry.new("facade", height=2.9, thickness=0.37, length=3.3, returns=0, door_width=0)
    assert masonry.limit(facade).factor == pytest.approx(0.37 / 2.9, rel=1e-6)


@pytest.mark.parametrize("at", [0.3, 1.1, 2.0, 3.95])
def test_the_weight_on_an_arch_is_on_the_voussoir_at_its_place(at):
    arch = masonry.new("arch", span=4, rise=1.3, at=at)
    specimen = arch.specimen.build()
    ids = specimen.sets[arch.limit.on]
    points = specimen.blocks.points[np.unique(_points_of(specimen.blocks, int(ids[0])))]
    inside = points[np.argsort(np.hypot(points[:, 0], points[:, 2] - (1.3 - (4 + 1.3**2) / 2.6)))[:4]]
    assert inside[:, 0].min() - 1e-9 <= at - 2.0 <= inside[:, 0].max() + 1e-9


def _points_of(blocks, block):
    faces = range(blocks.block_face_start[block], blocks.block_face_start[block + 1])
    return np.concatenate([blocks.face_points[blocks.face_start[f] : blocks.face_start[f + 1]] for f in faces])


def test_the_weight_that_a_dry_arch_bears_grows_with_its_own():
    light, heavy = (masonry.limit(masonry.new("arch", density=d, depth=0.7)).factor for d in (1800, 2700))
    assert heavy == pytest.approx(1.5 * light, rel=1e-6)


def test_a_couplet_bears_cohesion_and_friction_times_pressure():
    result = masonry.run(masonry.new("couplet", cohesion=0.3, friction=0.6, pressure="0.4 MPa"))
    assert result.peak.stress == pytest.approx(0.3e6 + 0.6 * 0.4e6, rel=0.005)
    assert result.summary["verdict"] == "sound"


def test_what_the_user_gives_is_no_assumption():
    assumed = masonry.new("bridge").assumptions
    stated = masonry.new("bridge", density="22 kN/m^3", friction=0.6).assumptions
    assert "contact.unit_unit.tan_friction_angle" in assumed and "fill.0.density" in assumed
    assert "contact.unit_unit.tan_friction_angle" not in stated and "fill.0.density" in stated


def test_a_bare_number_has_the_unit_of_the_help_and_texts_keep_theirs():
    _, text, _ = scene_of("bridge", {"spans": "8,600 cm", "axles": [90, "9e4 N"]}, "b.toml")
    tables = tomllib.loads(text)
    assert [arch["span"] for arch in tables["specimen"]["arch"]] == ["8 m", "600 cm"]
    assert tables["vehicle"]["axles"] == ["90 kN", "9e4 N"]
    mixed, plain = (scene_of("bridge", {"spans": spans}, "b.toml")[0] for spans in ("800\ncm, 6", np.array([8, 6])))
    assert np.allclose(mixed.specimen.build().blocks.points, plain.specimen.build().blocks.points, rtol=1e-14)


@pytest.mark.parametrize(
    ("task", "numbers", "says"),
    [
        ("brigde", {}, "did you mean 'bridge'?"),
        ("bridge", {"span": 8}, "no option 'span'; .*did you mean 'spans'?"),
        ("bridge", {"pier_width": [1.0, 2.0]}, "^pier_width: a bridge of one span has no pier"),
        ("bridge", {"spans": [8, 6, 7], "pier_width": [1.0, 2.0, 3.0]}, "^pier_width: .*the 2 piers"),
        ("bridge", {"spans": []}, "^spans: give 1 to 20 values"),
        ("bridge", {"spans": True}, "^spans: True is not a quantity"),
        ("bridge", {"spans": 10**400}, "^spans: no number is as large"),
        ("bridge", {"spans": np.array([8.0, np.inf])}, "^spans: 'inf' is not a number and a unit"),
        ("arch", {"load": None, "rise": "2 kN"}, "^rise: kN is a force"),
    ],
)
def test_python_is_told_in_its_own_words(task, numbers, says):
    with pytest.raises(SceneError, match=says):
        masonry.new(task, **numbers)
