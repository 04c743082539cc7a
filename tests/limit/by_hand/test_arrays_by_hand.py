"""What stands in arrays, by hand: strengths that are multiplied, planes, bars, positions, sets, joints of any shape."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import masonry
from geometry.joints.find import find_joints
from geometry.polyhedra.construct import extrude
from geometry.polyhedra.measures import moments
from masonry.assembly.road.axle_pressure import Pressure
from masonry.limit_analysis import positions
from masonry.limit_analysis.contact_strengths import rises, touching
from masonry.limit_analysis.element_limits import with_bars, yielding
from masonry.limit_analysis.limit_data import set_of
from masonry.limit_analysis.limit_loads import downward, loads_of
from masonry.limit_analysis.positions import PositionSearch
from masonry.statics.crushing import crushing_of
from masonry.statics.jammed import jammed
from masonry.statics.no_dilation import without_dilation
from masonry.statics.plane import plane_of
from masonry.statics.problem import RigidBodies, RigidContacts, Solution
from masonry.statics.solve import Method, largest_factor
from tests.limit.blocks import CONES, PLANE, dry, stack
from tests.limit.one_block import SIDEWAYS, block
from tests.scenes import load

SLAB = '["2 m", "0.3 m", "0.2 m"]'


def strong() -> RigidContacts:
    """Four points of a joint with friction, cohesion and tension, one of them endless, the last one a bar."""
    _, contacts = dry(stack([(0.5, 1.0)]), [0], 0.6)
    tension, most = np.array([2.0, 3.0, np.inf, 5.0]), np.array([np.inf, np.inf, np.inf, 7.0])
    crush = crushing_of(find_joints(stack([(0.5, 1.0)]), "vertex", 2), 4.0, np.ones(4, dtype=bool))
    link = np.arange(4) == 3
    return replace(contacts, cohesion=np.arange(4.0), tension=tension, crush=crush, link=link, limit=most)


def test_a_safety_divides_what_joints_bear_and_leaves_what_bars_bear():
    weak = strong().weakened(2.0)
    assert weak.friction.tolist() == [0.3] * 4 and weak.cohesion.tolist() == [0.0, 0.5, 1.0, 1.5]
    assert weak.tension.tolist() == [1.0, 1.5, np.inf, 5.0] and weak.limit is not None and weak.limit[3] == 7.0


def test_a_tilt_multiplies_all_strengths_and_leaves_friction():
    grown = strong().with_strength(3.0)
    assert grown.friction.tolist() == [0.6] * 4 and grown.cohesion.tolist() == [0.0, 3.0, 6.0, 9.0]
    assert grown.tension.tolist() == [6.0, 9.0, np.inf, 15.0]
    assert grown.limit is not None and grown.limit.tolist() == [np.inf, np.inf, np.inf, 21.0]
    assert grown.crush is not None and grown.crush.strength == pytest.approx(3.0 * 4.0 * 0.15)


PAIRS = {
    "trapezium": np.array([[0.0, 0.0], [1.2, 0.0], [0.7, 0.5], [0.2, 0.5]]),
    "kite": np.array([[0.0, 0.0], [0.6, 0.2], [1.0, 1.0], [0.2, 0.6]]),
    "pentagon": np.array([[0.0, 0.0], [1.0, 0.1], [1.2, 0.6], [0.6, 1.0], [-0.1, 0.5]]),
}


@pytest.mark.parametrize("name", PAIRS)
def test_a_joint_that_is_no_parallelogram_bears_its_own_shape_made_smaller_about_the_force(name):
    """Two prisms behind each other along y; a force at a share s of the way from the middle to an edge, along any line,
    bears fc A (1 - s)^2: the nearest edge leaves a polygon (1 - s) times as large."""
    loop = PAIRS[name]
    blocks = extrude([loop, loop], np.array([-1.0, 0.0]), np.array([0.0, 1.0]), np.arange(2), ("units",))
    bodies, contacts = dry(blocks, [0], 0.5, dead=(0.0, 0.0, 0.0), live=(0.0, -1.0, 0.0))
    joints = find_joints(blocks, "vertex", 2)
    strength, area = 3.0, float(joints.area.sum())
    limited = replace(contacts, crush=crushing_of(joints, strength, np.ones(len(joints.area), dtype=bool)))
    for share, edge, along in ((0.0, 0, 0.5), (0.3, 1, 0.2), (0.45, 2, 0.7)):
        end = loop[edge] + along * (loop[(edge + 1) % len(loop)] - loop[edge])
        live, arm = bodies.live.copy(), share * (np.array([end[0], 0.0, end[1]]) - bodies.centre[1] * (1.0, 0.0, 1.0))
        live[1, 3:] = np.cross(arm, live[1, :3])
        factor = largest_factor(replace(bodies, live=live), limited, CONES).factor
        assert factor * area == pytest.approx(strength * area * (1.0 - share) ** 2, rel=1e-6)


def test_a_load_that_turns_a_block_out_of_a_plane_and_a_joint_beside_it_are_no_plane_problem():
    bodies, contacts = dry(stack([(0.5, 1.0), (0.4, 0.7)], [0.0, 0.05]), [0], 0.6)
    assert plane_of(bodies, contacts) == 1
    for dof, out in ((0, False), (1, True), (2, False), (3, True), (4, False), (5, True)):
        for name in ("live", "dead"):
            loads = getattr(bodies, name).copy()
            loads[2, dof] += 1e-3
            assert (plane_of(replace(bodies, **{name: loads}), contacts) is None) == out, f"{name}, dof {dof}"
    beside = replace(contacts, point=contacts.point + np.where(contacts.block_a == 1, 1e-3, 0.0)[:, None] * [0, 1, 0])
    assert plane_of(bodies, beside) is None
    narrow = contacts.point.copy()
    upper = contacts.block_a == 1
    narrow[upper, 1] = 0.15 + 0.5 * (narrow[upper, 1] - 0.15)
    assert plane_of(bodies, replace(contacts, point=narrow)) == 1, "narrower on both sides"


@pytest.mark.parametrize("method", [PLANE, CONES], ids=["plane", "cones"])
def test_cohesion_counts_without_dilation_beside_a_pressure_that_changes(method):
    """Pushed along and lifted by 0.4 of it: mu (W - 0.4 F) + c A = F."""
    bodies, contacts = dry(stack([(2.0, 1.0)]), [0], 0.5, live=(1.0, 0.0, 0.4))
    glued = replace(contacts, cohesion=0.2 * contacts.area)
    weight = 2.0 * 0.3
    wanted = (0.5 * weight + 0.2 * 0.6) / (1.0 + 0.5 * 0.4) / weight
    assert without_dilation(bodies, glued, method).solution.factor == pytest.approx(wanted, rel=2e-3)


@pytest.mark.parametrize("light", [1.0, 1e-4])
def test_a_block_on_a_much_heavier_one_has_its_own_factor(light):
    """The upper one slides on the lower one, whatever each weighs: cohesion of 0.1 of its weight, and tension."""
    bodies, contacts = dry(stack([(2.0, 1.0), (1.0, 0.2)], [0.0, 0.3]), [0], 0.3, density=np.array([1.0, 1.0, light]))
    bodies.live[1] = 0.0
    weight = 0.3 * 0.2 * light
    glued = replace(contacts, cohesion=0.1 * weight * contacts.area / 0.3, tension=0.05 * weight * contacts.area / 0.3)
    for method in (PLANE, CONES):
        assert largest_factor(bodies, glued, method).factor == pytest.approx(0.4, rel=1e-6)


def test_bars_pull_their_ends_together_and_yield_by_what_they_bear():
    bodies, contacts = dry(stack([(0.5, 1.0)]), [0], 0.6)
    point = np.array([[[0.4, 0.1, 0.0], [0.4, 0.2, 0.8]], [[0.1, 0.1, 0.3], [9.0, 0.0, 0.3]]])
    along = point[:, 1] - point[:, 0]
    axis = along / np.linalg.norm(along, axis=1, keepdims=True)
    bars = SimpleNamespace(
        count=2, block=np.array([[0, 1], [1, -1]]), point=point, axis=axis,
        least=np.array([-2.0, 0.0]), most=np.array([5.0, 3.0]),
        stiffness=np.array([30.0, 70.0]), pretension=np.array([0.5, 0.0]),
    )  # fmt: skip
    both = with_bars(contacts, bars, bodies, 200.0)  # type: ignore[arg-type]
    assert both.area[4:] == pytest.approx([0.15, 0.35]), "of joints as stiff as the bars"
    assert both.pretension is not None and both.pretension.tolist() == [0.0] * 4 + [0.5, 0.0]
    assert both.is_link.tolist() == [False] * 4 + [True, True] and both.block_b[4:].tolist() == [1, 0]
    assert both.normal[4:] == pytest.approx(-axis), "a force above 0 on the second end goes towards the first one"
    assert both.tension[4:].tolist() == [2.0, 0.0] and both.limit is not None and both.limit[4:].tolist() == [5.0, 3.0]
    assert len(set(both.patch[3:].tolist())) == 3, "each is a joint of its own"
    for force, wanted in (((5.0, 3.0), [1, 1]), ((4.9, 2.9), [0, 0]), ((-2.0, 0.0), [1, 0]), ((-1.9, 0.0), [0, 0])):
        assert yielding(bars, np.array(force)).tolist() == [bool(x) for x in wanted]  # type: ignore[arg-type]


def test_a_skew_tie_holds_a_block_that_would_topple():
    """From the ground 1 m beside the block to its top: W h/2 times the factor is W b/2, and the tie's force by its arm
    about the far edge."""
    tie = (
        '[[bar]]\nends = [["-0.9 m", "0.1 m", "0 m"], ["0 m", "0.1 m", "0.9 m"]]\narea = "1 cm^2"\nstrength = "5 MPa"\n'
    )
    even = tie.replace("0.1 m", "0.15 m") + 'young_modulus = "1 GPa"\n'
    result = masonry.limit(load(block(even)).with_(SIDEWAYS))
    force, arm = 500.0, (0.5 + 0.9) / np.sqrt(2.0)
    weight = 3000.0
    assert result.factor == pytest.approx((weight * 0.25 + force * arm) / (weight * 0.5), rel=1e-6)
    assert result.elements[0].force == pytest.approx([force]) and result.elements[0].yielding.all()


def test_loads_on_a_skew_block_act_about_the_axes_of_space():
    """A voussoir of an arch that leans: pushed at a point off its middle, the moment is arm times force. (Of one that
    does not lean the axes are their own transpose.)"""
    turned = {"about": "x", "angle": "25 deg", "through": ["0 m", "0 m", "0 m"]}
    still = masonry.load("arch", {"drive": None, "specimen.turned": turned})
    specimen, joints = touching(still)
    (number,) = specimen.sets["voussoir 4"]
    push, at = np.array([300.0, 200.0, -500.0]), moments(specimen.blocks)[1][number] + [0.03, 0.07, -0.02]
    words = {key: f"{x!r} N" for key, x in zip("xyz", push.tolist(), strict=True)}
    limit = {"pattern": "force", "on": "voussoir 4", "force": words, "at": [f"{float(x)!r} m" for x in at]}
    loads = loads_of(still.with_({"limit": limit}), specimen, joints)
    live = loads.bodies.live
    assert live[number, :3] == pytest.approx(push)
    assert live[number, 3:] == pytest.approx(np.cross(at - loads.bodies.centre[number], push), rel=1e-9)
    assert not np.delete(live, number, axis=0).any()


def test_an_axle_presses_down_beside_the_middle_of_its_block():
    centre = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]])
    press = Pressure(
        np.array([1, 1, 0]), np.array([10.0, 4.0, 7.0]), np.array([[1.3, 2.2, 9], [0.9, 2, 9], [0, -2, 1]])
    )
    load = downward(press, centre)
    assert load[0] == pytest.approx([0, 0, -7.0, 14.0, 0, 0])
    assert load[1] == pytest.approx([0, 0, -14.0, -10.0 * 0.2, 10.0 * 0.3 - 4.0 * 0.1, 0])


@pytest.mark.parametrize("worst", [0.37, 0.38])
def test_the_worst_position_is_refined_on_either_side_of_the_best_of_those_that_were_solved(worst, monkeypatch):
    """One mechanism, on which the load at x does the work 1 - (x - worst)^2: the factor is 1 over it."""
    bed = SimpleNamespace(
        pressure=lambda vehicle, x, way: Pressure(np.array([0]), np.array([1.0 - (x - worst) ** 2]), np.zeros((1, 3)))
    )
    bodies = RigidBodies(np.zeros((1, 3)), np.ones((1, 6), dtype=bool), np.zeros((1, 6)), np.zeros((1, 6)))

    def solved(loaded: RigidBodies, contacts: RigidContacts, method: Method) -> Solution:
        factor = -1.0 / float(loaded.live[0, 2])
        none = np.zeros((0, 3))
        return Solution("solved", factor, none[:, 0], none, np.array([[0.0, 0.0, -factor, 0.0, 0.0, 0.0]]))

    monkeypatch.setattr(positions, "largest_factor", solved)
    search = PositionSearch(bed, None, bodies, None, PLANE)  # type: ignore[arg-type]
    search.add_way("x", np.linspace(0.0, 1.0, 65))
    envelope = search.envelope()
    assert envelope.position[envelope.least] == pytest.approx(worst, abs=1e-3)
    assert envelope.factor[envelope.least] == pytest.approx(1.0, abs=2e-6) and envelope.bound <= envelope.factor.min()


def test_a_block_is_named_by_the_smallest_set_that_it_is_in():
    specimen = SimpleNamespace(sets={"all": np.arange(9), "course": np.array([1, 2, 3]), "end": np.array([3])})
    assert [set_of(specimen, block) for block in (3, 2, 0, 12)] == ["end", "course", "all", ""]  # type: ignore[arg-type]


@pytest.mark.parametrize(("cutoff", "lasts"), [("7.7 mm", False), ("7.9 mm", True)])
def test_joints_rise_for_good_where_the_rise_lasts_for_a_fiftieth_of_the_smallest_block(cutoff, lasts):
    """The block of 0.2 x 0.3 x 1 m has the size 0.391 m; 2 % of it are 7.83 mm."""
    law = 'law = "brittle"\ntensile_strength = "0 Pa"\ncohesion = "0 Pa"\ntan_residual_friction_angle = 0.7\n'
    law += f'dilation_cutoff = "{cutoff}"\ndilation_angle = "{float(np.degrees(np.arctan(0.7))) - 1e-9!r} deg"\n'
    scene = load(block("", law, '["0.2 m", "0.3 m", "1 m"]'))
    assert rises(scene, *touching(scene)) is lasts


def test_without_strength_the_friction_is_that_which_is_left():
    law = 'law = "brittle"\ntensile_strength = "1 kPa"\ncohesion = "2 kPa"\ntan_residual_friction_angle = 0.45\n'
    scene = load(block("", law, SLAB)).with_(SIDEWAYS)
    weight, area = 2000.0 * 10.0 * 0.12, 0.6
    assert masonry.limit(scene, strength=False).factor == pytest.approx(0.45, rel=1e-7)
    assert masonry.limit(scene).factor == pytest.approx(0.7 + 2e3 * area / weight, rel=1e-6)


@pytest.mark.parametrize("tilt", [0.3, 0.8])
def test_at_a_tilt_cohesion_is_held_against_a_weight_that_keeps_its_size(tilt):
    """(mu W cos t + c A) / (W sin t) on a flat block."""
    law = 'law = "brittle"\ntensile_strength = "0 Pa"\ncohesion = "2 kPa"\ntan_residual_friction_angle = 0.5\n'
    scene = load(block('[limit]\npattern = "tilt"\nabout = "y"\n', law, SLAB))
    t, weight, area = np.arctan(tilt), 2000.0 * 10.0 * 0.12, 0.6
    wanted = (0.7 * weight * np.cos(t) + 2e3 * area) / (weight * np.sin(t))
    assert masonry.limit(scene, safety=True, at=tilt).factor == pytest.approx(wanted, rel=1e-5)


def test_the_forces_at_a_tilt_are_those_of_the_angle_itself():
    """A flat block with cohesion: it presses by W cos t, and its joint bears W sin t along it."""
    law = 'law = "brittle"\ntensile_strength = "0 Pa"\ncohesion = "1 kPa"\ntan_residual_friction_angle = 0.5\n'
    result = masonry.limit(load(block('[limit]\npattern = "tilt"\nabout = "y"\n', law, SLAB)))
    weight, t = 2000.0 * 10.0 * 0.12, np.arctan(result.factor)
    assert weight * np.sin(t) == pytest.approx(0.7 * weight * np.cos(t) + 1e3 * 0.6, rel=1e-6)
    assert result.normal.sum() == pytest.approx(weight * np.cos(t), rel=1e-6)
    assert np.linalg.norm(result.shear.sum(axis=0)) == pytest.approx(weight * np.sin(t), rel=1e-6)


@pytest.mark.parametrize(("pushed", "falls"), [(1.4, True), (1.9, False)])
def test_a_stone_between_walls_is_held_by_the_pressure_of_its_loads_and_not_by_being_jammed(pushed, falls):
    """Pushed against one wall by a share of its weight, friction of 0.6 bears 0.84 or 1.14 of it."""
    loops = [
        np.array([[-0.6, 0.0], [-0.25, 0.0], [-0.25, 0.4], [-0.6, 0.4]]),
        np.array([[0.25, 0.0], [0.6, 0.0], [0.6, 0.4], [0.25, 0.4]]),
        np.array([[-0.25, 0.0], [0.25, 0.0], [0.25, 0.3], [-0.25, 0.3]]),
    ]
    blocks = extrude(loops, np.zeros(3), np.full(3, 0.3), np.arange(3), ("units",))
    solution = jammed(*dry(blocks, [0, 1], 0.6, dead=(pushed, 0.0, -1.0)))
    assert (solution is not None) == falls


@pytest.mark.parametrize(
    ("fixed", "along_x", "along_y"),
    [("", 0.5, 0.3), ("x", 0.5, 0.7), ("y", 0.7, 0.3), ("z", 0.5, 0.3)]
    + [("xz", 0.5, 0.7), ("yz", 0.7, 0.3), ("xy", 0.7, 0.7), ("xyz", 0.7, 0.7)],
)
def test_turns_that_are_held_keep_a_block_from_toppling_about_them_alone(fixed, along_x, along_y):
    """A block of 0.5 x 0.3 x 1 m topples at its width over its height, and slides at 0.7."""
    support = {"on": "block", "fix": [f"rotation {axis}" for axis in fixed]}
    held = {"support": [{"on": "ground", "fix": "all"}, *([support] if fixed else [])]}
    for direction, factor in (("x", along_x), ("y", along_y)):
        wide = '"-1 m", "-1 m", "-1 m"], size = ["3 m", "3 m", "1 m"]'
        text = block("").replace('"-1 m", "0 m", "-1 m"], size = ["3 m", "0.3 m", "1 m"]', wide)
        scene = load(text).with_(held | {"limit": {"pattern": "weight", "direction": direction}})
        assert masonry.limit(scene).factor == pytest.approx(factor, rel=1e-6)
