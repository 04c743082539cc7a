"""Axles on a road above an arch: what they press on, the least factor over their positions, and what is refused."""

import csv
from dataclasses import replace

import numpy as np
import pytest

import masonry
from masonry.assembly.assemble import joined
from masonry.assembly.growing_loads import bed_of
from masonry.drawings.geometry_picture import geometry_figure
from masonry.drawings.road_drawing import AXLE, BESIDE
from masonry.errors import SceneError
from masonry.scene import load, to_toml
from verification.references.thrust_line import added, ring

G = 9.81
BRIDGE = "bridge-single-span"
LEVEL, PATCH, TAN = 1.8, 0.3, float(np.tan(np.radians(26.565)))
OWN = ring(5.0, 1.2, 0.4, 25)
DEAD = added(OWN.weights(2200 * G), OWN.filled(LEVEL, 1800 * G))
TRUCK = {"vehicle.axles": ["60 kN", "120 kN", "110 kN"], "vehicle.spacings": ["1.5 m", "0.9 m"]}


def by_thrust_line(places, axles, friction: float = 0.7) -> float:
    live = added(*(OWN.under_axle(load, x, LEVEL, PATCH, TAN) for load, x in zip(axles, places, strict=True)))
    return OWN.largest_factor(DEAD, live, friction)


@pytest.fixture(scope="module")
def one_axle():
    return masonry.limit(BRIDGE)


def test_force_and_line_of_action_of_axles_are_kept_and_what_is_beside_the_bridge_does_not_count():
    scene = load(BRIDGE, TRUCK | {"vehicle.direction": "-x"})
    specimen, joints = joined(scene)
    bed, vehicle = bed_of(scene, specimen, joints), scene.vehicle
    for position in (-0.9, 0.0, 0.37, 0.8):
        pressure = bed.pressure(vehicle, position, "-x")
        places = vehicle.places(position, "-x")
        assert places.tolist() == pytest.approx([position - 1.2, position + 0.3, position + 1.2])
        assert pressure.force.sum() == pytest.approx(290e3, rel=1e-12)
        moment = np.dot(vehicle.axles, places)
        assert pressure.force @ pressure.centre[:, 0] == pytest.approx(moment, abs=1e-9 * 290e3)
        assert pressure.centre[:, 1] == pytest.approx(0.5)
    end = OWN.joints[-1, 1, 0]  # the last axle stands above the end of the extrados: half of it presses on the arch
    half = bed.pressure(vehicle, end + 0.3 - 1.5, "-x").force.sum()
    last_two = bed.pressure(vehicle, end - 1.2, "-x").force.sum()
    assert half < 290e3 and last_two == pytest.approx(60e3 + 120e3 + 0.5 * 110e3, rel=1e-9)
    assert bed.pressure(vehicle, 9.0, "-x").force.sum() == 0.0


def test_the_least_factor_is_that_of_a_line_of_thrust_at_many_positions(one_axle):
    x = np.linspace(0.0, 2.8, 113)
    own = [by_thrust_line([place], [100e3]) for place in x]
    assert one_axle.factor == pytest.approx(min(own), rel=1e-3)
    assert abs(abs(one_axle.scene.vehicle.position) - x[int(np.argmin(own))]) < 0.05
    assert one_axle.factor <= min(own)
    position, factor = one_axle.envelope.along("x")
    for k in np.flatnonzero(np.isfinite(factor))[::9]:
        assert factor[k] == pytest.approx(by_thrust_line([position[k]], [100e3]), rel=1e-6)


def test_a_symmetric_bridge_has_a_symmetric_envelope(one_axle):
    envelope = one_axle.envelope
    even = np.arange(0, 81)  # what was solved evenly, before the least was refined
    grid = np.linspace(envelope.position.min(), envelope.position.max(), 81)
    at = [int(np.argmin(np.abs(envelope.position - x))) for x in grid]
    factor = envelope.factor[at][even]
    finite = np.isfinite(factor)
    assert (finite == finite[::-1]).all()
    assert factor[finite] == pytest.approx(factor[finite][::-1], rel=1e-7)
    assert envelope.bound <= envelope.factor.min() <= envelope.bound * (1.0 + 1e-5)


def test_a_truck_is_as_bad_in_both_directions_of_a_symmetric_bridge_and_as_by_hand():
    both = masonry.limit(load(BRIDGE, TRUCK | {"vehicle.between": ["-1.5 m", "1.5 m"]}))
    least = [both.envelope.along(way)[1].min() for way in ("x", "-x")]
    assert least[0] == pytest.approx(least[1], rel=2e-3)
    position, way = both.scene.vehicle.position, both.scene.vehicle.direction
    places = both.scene.vehicle.places(position, way)
    assert both.factor == pytest.approx(by_thrust_line(places, [60e3, 120e3, 110e3]), rel=1e-6)
    assert f"leads along {way}" in str(both)


def test_words_and_picture_say_where_each_axle_is_and_which_is_not_on_the_structure():
    axles = {"vehicle.axles": ["60 kN", "120 kN"], "vehicle.spacings": ["3 m"], "vehicle.direction": "x"}
    end = float(OWN.joints[-1, 1, 0])
    beyond = masonry.limit(load(BRIDGE, axles | {"vehicle.position": "2.9 m"}))
    assert beyond.words == (
        "the 2 axles of the vehicle, which leads along x, 180 kN in all, with its middle at x = 2.9000 m, "
        "and axles at 4.4000 m (not on the structure) and 1.4000 m"
    )
    assert beyond.factor == pytest.approx(by_thrust_line([1.4], [120e3]), rel=1e-6)
    close = axles | {"vehicle.spacings": ["1.5 m"], "vehicle.position": f"{end - 0.75!r} m"}
    half = masonry.limit(load(BRIDGE, close)).words
    assert half.endswith(f"axles at {end:.4f} m (50 % of it on the structure) and {end - 1.5:.4f} m")
    figure = geometry_figure(beyond.scene, beyond.specimen, beyond.joints)
    colours = {text.get_text(): text.get_color() for text in figure.axes[0].texts if "kN" in text.get_text()}
    assert colours == {"60 kN": BESIDE, "120 kN": AXLE}


@pytest.mark.parametrize(("place", "friction"), [(0.7, 0.7), (1.25, 0.7), (1.25, 0.3), (-2.0, 0.45)])
def test_a_vehicle_that_stands_is_analysed_where_it_stands(place, friction):
    changes = {"vehicle.position": f"{place} m", "contact.unit_unit.tan_friction_angle": friction}
    result = masonry.limit(load(BRIDGE, changes))
    assert result.envelope is None
    assert result.factor == pytest.approx(by_thrust_line([place], [100e3], friction), rel=1e-6)


def test_without_patch_and_spread_an_axle_is_a_force_on_the_voussoir_below_it():
    changes = {"vehicle.position": "1.2 m", "vehicle.patch": "0 m", "vehicle.spread": "0 deg"}
    there = int(np.searchsorted(OWN.joints[:, 1, 0], 1.2))
    at = [1.2, 0.5, float(OWN.height(np.array([1.2]))[0]) - 1e-3]
    force = {"pattern": "force", "on": f"voussoir {there}", "force": {"z": "-100 kN"}, "at": [f"{x} m" for x in at]}
    own = masonry.limit(load(BRIDGE, {"vehicle": None, "assumptions": {}, "limit": force})).factor
    assert masonry.limit(load(BRIDGE, changes)).factor == pytest.approx(own, rel=1e-4)


OVERHANG = """
law = "friction"
[specimen]
kind = "boxes"
section = "1 m^2"
[[specimen.box]]
name = "foot"
origin = ["0 m", "0 m", "0 m"]
size = ["1 m", "1 m", "1 m"]
[[specimen.box]]
name = "slab"
unit = 1
origin = ["0 m", "0 m", "1 m"]
size = ["1.4 m", "1 m", "0.3 m"]
[material.units]
density = "2000 kg/m^3"
[contact.unit_unit]
normal_stiffness = "30 GPa/m"
shear_stiffness = "12 GPa/m"
tan_friction_angle = 0.7
[[support]]
on = "foot"
fix = "all"
[gravity]
z = "-10 m/s^2"
[vehicle]
on = "slab"
level = "1.5 m"
axles = ["1 kN"]
patch = "0.1 m"
[limit]
pattern = "vehicle"
"""


def test_an_axle_tips_a_slab_that_hangs_over_where_its_patch_comes_to_the_edge(tmp_path):
    """The slab weighs 8.4 kN, 0.3 m from the edge that it tips about; the patch ends with the slab 0.35 m beyond it."""
    (tmp_path / "overhang.toml").write_text(OVERHANG)
    result = masonry.limit(load(tmp_path / "overhang.toml"))
    assert result.factor == pytest.approx(8.4 * 0.3 / 0.35, rel=1e-6)
    assert result.scene.vehicle.position == pytest.approx(1.35, abs=1e-5)


@pytest.mark.parametrize(("place", "arm"), [("1.4 m", 0.4), ("1.39 m", 0.39)], ids=["at the end", "before it"])
def test_an_axle_that_is_a_line_presses_whole_at_the_end_of_the_slab(tmp_path, place, arm):
    (tmp_path / "overhang.toml").write_text(OVERHANG)
    keys = {"vehicle.patch": "0 m", "vehicle.position": place}
    factor = masonry.limit(load(tmp_path / "overhang.toml", keys)).factor
    assert factor == pytest.approx(8.4 * 0.3 / arm, rel=1e-5)


def test_a_specimen_far_from_the_origin_and_turned_about_has_the_same_factor(one_axle):
    far = {"specimen.turned": {"about": "z", "angle": "180 deg", "through": ["500 m", "0 m", "0 m"]}}
    x = 1000.0 + one_axle.scene.vehicle.position
    result = masonry.limit(load(BRIDGE, far | {"vehicle.position": f"{x!r} m"}))
    assert result.factor == pytest.approx(one_axle.factor, rel=1e-8)


def test_a_vault_in_bond_bears_what_its_arch_bears(one_axle):
    vault = {"kind": "vault", "span": "5 m", "rise": "1.2 m", "thickness": "0.4 m", "courses": 25, "length": "1 m"}
    vault |= {"units_per_course": 2, "contact_points": "vertex"}
    x = one_axle.scene.vehicle.position
    result = masonry.limit(load(BRIDGE, {"specimen": vault, "vehicle.position": f"{x!r} m"}))
    assert result.factor == pytest.approx(one_axle.factor, rel=1e-6)


def test_twice_the_weight_bears_twice_the_load_at_the_same_place(one_axle):
    twice = {"material.units.density": "4400 kg/m^3", "fill.0.density": "3600 kg/m^3"}
    result = masonry.limit(load(BRIDGE, twice))
    assert result.factor == pytest.approx(2.0 * one_axle.factor, rel=1e-6)
    assert abs(result.scene.vehicle.position) == pytest.approx(abs(one_axle.scene.vehicle.position), abs=1e-3)


def test_span_and_rise_are_a_radius_and_an_angle():
    inner, half = 3.2041666666666666, float(np.arcsin(2.5 / 3.2041666666666666))
    circle = {"specimen.span": None, "specimen.rise": None}
    circle |= {"specimen.radius": f"{inner + 0.2!r} m", "specimen.angle": f"{2.0 * half!r} rad"}
    own, other = (joined(load(BRIDGE, changes))[0].blocks.points for changes in ({}, circle))
    assert own - other == pytest.approx(np.broadcast_to([0.0, 0.0, 1.2 - inner], own.shape), abs=1e-12)
    assert own[:, 2].max() == pytest.approx(1.6, abs=2e-2) and own[:, 0].max() == pytest.approx(
        2.5 * (inner + 0.4) / inner
    )
    semicircle = load(BRIDGE, {"specimen.rise": "2.5 m", "vehicle.level": "3 m", "fill.0.level": "3 m"})
    assert semicircle.specimen.ring == pytest.approx((2.7, np.pi, 0.0))


def test_the_envelope_is_written_as_a_table_and_drawn(one_axle, tmp_path):
    names = [path.name for path in one_axle.save(tmp_path)]
    assert names == ["limit.json", "mechanism.png", "thrust.png", "envelope.csv", "envelope.png"]
    with (tmp_path / "envelope.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert min(float(row["factor"]) for row in rows) == pytest.approx(one_axle.factor, rel=1e-6)
    assert one_axle.as_data()["position"] == one_axle.scene.vehicle.position
    assert "vehicle.position=" in str(one_axle)


def test_a_table_of_somebody_else_stays_and_one_of_ours_goes(one_axle, tmp_path):
    standing = replace(one_axle, envelope=None)
    (tmp_path / "envelope.csv").write_text("mine\n")
    standing.save(tmp_path)
    assert (tmp_path / "envelope.csv").read_text() == "mine\n"
    one_axle.save(tmp_path / "ours")
    standing.save(tmp_path / "ours")
    assert sorted(path.name for path in (tmp_path / "ours").glob("envelope*")) == []


def test_a_scene_with_a_vehicle_is_written_and_read_again(tmp_path):
    scene = load(BRIDGE, TRUCK | {"vehicle.position": "0.4 m", "vehicle.direction": "-x"})
    (tmp_path / "again.toml").write_text(to_toml(scene))
    again = load(tmp_path / "again.toml")
    assert (again.vehicle, again.specimen) == (scene.vehicle, scene.specimen)
    assert load(BRIDGE, {"vehicle.between": ["0 m", "1 m"]}).with_({"vehicle.position": "1 m"}).vehicle.between is None


WRONG = {
    "spaces": ({"vehicle.spacing": ["1 m"]}, "did you mean 'spacings'"),
    "axle": ({"vehicle.axle": ["1 kN"]}, "did you mean 'axles'"),
    "counts": ({"vehicle.axles": ["1 kN", "2 kN"]}, "2 axles have 1 spacings; here are 0"),
    "way": (TRUCK | {"vehicle.position": "0 m"}, "give direction = 'x' or '-x'"),
    "kind": ({"vehicle.axles": ["1 m"]}, "force"),
    "beyond": ({"vehicle.between": ["2 m", "1 m"]}, "a lower and a higher position"),
    "both": ({"vehicle.between": ["1 m", "2 m"], "vehicle.position": "1 m"}, "keep one of them"),
    "pattern": ({"limit.pattern": "vehicel"}, "did you mean 'vehicle'"),
    "alone": ({"limit": None}, "give [limit] pattern = 'vehicle'"),
    "none": ({"vehicle": None, "assumptions": {}}, "'vehicle' needs a table [vehicle]"),
    "run": ({"limit.accuracy": "1 %"}, "`masonry limit` finds the worst one"),
    "ring": ({"specimen.radius": "3 m"}, "radius and angle, or span and rise"),
    "rise": ({"specimen.rise": "2.6 m"}, "half of the span or less, 2.5 m"),
    "half": ({"specimen.rise": None}, "missing; give radius and angle of the ring, or span and rise"),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_is_wrong_with_a_vehicle_is_said_in_one_message(case):
    changes, words = WRONG[case]
    with pytest.raises(SceneError) as error:
        load(BRIDGE, changes)
    assert words in str(error.value) and "\n" not in str(error.value)


NO_ANSWER = {
    "low": ({"vehicle.level": "1.4 m"}, "reaches up to 1.59769 m; give that or more"),
    "far": ({"vehicle.position": "30 m"}, "acts on no block that can move"),
    "way": ({"vehicle.between": ["20 m", "30 m"]}, "it reaches from -3.7"),
    "face": ({"vehicle.on": "voussoirs.y+"}, "name a set, without a face"),
    "skew": ({"specimen.turned": {"about": "z", "angle": "30 deg"}}, "a road along x lies on faces"),
    "twice": ({"vehicle.on": "voussoir"}, "did you mean"),
    "thin": ({"specimen.thickness": "0.02 m", "fill": []}, "it cannot stand under its dead loads"),
}


@pytest.mark.parametrize("case", NO_ANSWER)
def test_a_vehicle_without_an_answer_is_refused_in_one_message(case):
    changes, words = NO_ANSWER[case]
    with pytest.raises(SceneError) as error:
        masonry.limit(load(BRIDGE, changes))
    assert words in str(error.value)
