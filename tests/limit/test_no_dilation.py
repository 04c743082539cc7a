"""Friction without dilation, on the way from the dead loads: a published factor, a wedge by hand, runs."""

from pathlib import Path

import numpy as np
import pytest

import masonry
import verification
from masonry.scene import load as load_scene
from masonry.statics.no_dilation import without_dilation
from masonry.statics.problem import RigidBodies, RigidContacts
from masonry.statics.safety import factor_of_safety
from masonry.statics.solve import largest_factor
from tests.limit.blocks import CONES, PLANE, dry, stack, wall

SCENES = Path(verification.__file__).parent / "scenes"

LEFT, RIGHT = ((40.0, 130.0), (60.0, 220.0))
"""Dip and dip direction of the two planes of a wedge, degrees."""


@pytest.mark.parametrize("method", [PLANE, CONES], ids=["plane", "cones"])
def test_wall_1_of_ferris_and_tin_loi_is_within_2_per_mille_of_what_was_published(method):
    solution = without_dilation(*dry(wall(6, halves_below=True), [0], 0.65), method)
    assert solution.converged and solution.solution.factor == pytest.approx(0.6403, rel=2e-3)
    assert solution.with_dilation == pytest.approx(0.642859, rel=1e-6)


def test_the_forces_at_the_end_balance_all_loads_and_keep_to_friction():
    bodies, contacts = dry(wall(10, halves_below=True), [0], 0.65)
    way = without_dilation(bodies, contacts)
    assert way.converged and abs(way.open) < 1e-3 and way.solution.unbalance < 1e-7
    assert way.solution.factor < 0.98 * way.with_dilation, "a higher wall falls earlier than with dilation"
    assert way.solution.normal.min() > -1e-6
    shear = np.abs(np.bincount(contacts.patch, way.solution.shear[:, 0]))
    bears = 0.65 * np.bincount(contacts.patch, way.solution.normal)
    assert (shear - bears).max() < 1e-2 * way.solution.normal.sum() / len(bears)


def test_the_mechanism_slides_without_rising():
    """Joints that slide and stay closed do not open: work is lost by friction alone, as much as the loads do."""
    bodies, contacts = dry(wall(6, halves_below=True), [0], 0.65)
    way = without_dilation(bodies, contacts)
    loads = bodies.dead + way.solution.factor * bodies.live
    gained = float((loads * way.solution.velocity).sum())
    move, arm = way.solution.velocity, contacts.point[:, None] - bodies.centre
    speed = [
        move[block, :3] + np.cross(move[block, 3:], arm[np.arange(len(block)), block])
        for block in (contacts.block_a, contacts.block_b)
    ]
    slip = speed[1] - speed[0]
    along = slip - (slip * contacts.normal).sum(axis=1)[:, None] * contacts.normal
    lost = float((0.65 * way.solution.normal * np.linalg.norm(along, axis=1)).sum())
    assert gained == pytest.approx(lost, rel=0.01) and lost > 0.0
    assert ((slip * contacts.normal).sum(axis=1) > -1e-6 * np.abs(slip).max()).all(), "nothing goes into anything"
    pressed = way.solution.normal > 0.02 * way.solution.normal.max()
    assert np.abs((slip * contacts.normal).sum(axis=1)[pressed]).max() < 1e-3 * np.abs(slip).max()


def test_a_block_that_slides_alone_needs_no_dilation_to_be_right():
    for friction, slender in ((0.3, 2.0), (0.7, 0.5)):
        solution = without_dilation(*dry(stack([(slender, 1.0)]), [0], friction))
        assert solution.solution.factor == pytest.approx(min(friction, slender), rel=1e-6)


def normal_of(dip: float, direction: float) -> np.ndarray:
    """Upward normal of a plane; y is north, x is east."""
    slope, way = np.radians(dip), np.radians(direction)
    return np.array([np.sin(slope) * np.sin(way), np.sin(slope) * np.cos(way), np.cos(slope)])


def wedge(friction: float) -> tuple[RigidBodies, RigidContacts, np.ndarray]:
    """A tetrahedron of weight 1 in the notch of two planes, pushed along the notch in plan; and the way down."""
    left, right = normal_of(*LEFT), normal_of(*RIGHT)
    down = np.cross(left, right)
    down /= -np.sign(down[2]) * np.linalg.norm(down)
    top = -2.0 * down
    sides = [np.cross(n, (0.0, 0.0, 1.0)) for n in (left, right)]
    first, second = (top + 1.5 * side * np.sign(side @ down) for side in sides)
    corners = np.array([np.zeros(3), top, first, second])
    push = np.array([down[0], down[1], 0.0]) / np.hypot(down[0], down[1])
    live, dead = np.zeros((2, 6)), np.zeros((2, 6))
    dead[1, 2], live[1, :3] = -1.0, push
    free = np.array([[False] * 6, [True] * 6])
    bodies = RigidBodies(np.array([[0.0, 0.0, -5.0], corners.mean(axis=0)]), free, dead, live)
    none = np.zeros(6)
    contacts = RigidContacts(
        *(np.zeros(6, dtype=np.int64), np.ones(6, dtype=np.int64), corners[[0, 1, 2, 0, 1, 3]]),
        *(np.array([left] * 3 + [right] * 3), np.repeat([0, 1], 3), np.ones(6), np.full(6, friction)),
        *(none, none, np.zeros(6, dtype=bool)),
    )
    return bodies, contacts, down


def push_by_hand(friction: float) -> float:
    """Without dilation it slides along the notch, so that both shear forces act up it: three equations for the normal
    forces and the shear at a push of 0 and of 1, and friction for the push."""
    left, right = normal_of(*LEFT), normal_of(*RIGHT)
    bodies, _, down = wedge(friction)
    matrix = np.column_stack([left, right, -down])
    at_0, at_1 = (np.linalg.solve(matrix, -load) for load in (bodies.dead[1, :3], bodies.live[1, :3]))
    return float((friction * at_0[:2].sum() - at_0[2]) / (at_1[2] - friction * at_1[:2].sum()))


def test_a_keystone_that_is_pulled_up_bears_most_before_its_arch_has_followed_it():
    """The thrust that holds it grows with the load, and goes as it slides up between faces that open."""
    arch = {"limit": {"pattern": "force", "on": "keystone", "force": {"z": "1 kN"}, "accuracy": 0.005}}
    scene = load_scene(SCENES / "arch-of-oppenheim.toml", arch)
    limit, run = masonry.limit(scene, dilation=False), masonry.run(scene).summary["collapse_load"]
    assert 0.995 * run["borne"] < limit.factor < 1.005 * run["falls"]
    assert limit.factor < 0.9 * masonry.limit(scene).factor, "dilation would lift the arch"
    assert any("is left" in remark for remark in limit.remarks)


@pytest.mark.slow
def test_the_facade_falls_without_dilation_where_a_run_falls_and_with_it_where_limit_analysis_says():
    """What stones that are drawn out from between others bear depends on whether they rise: 0.3025 against 0.3547."""
    plain, dilates = grown("facade-tilted"), grown("facade-tilted", dilates=True)
    bound, without = masonry.limit("facade-tilted"), masonry.limit("facade-tilted", dilation=False)
    assert dilates["borne"] == pytest.approx(bound.factor, rel=0.01)
    assert without.factor == pytest.approx(0.5 * (plain["borne"] + plain["falls"]), rel=0.005)
    assert plain["moving"] == without.moving.sum() and plain["falls"] < 0.87 * bound.factor
    for stiffer in (5.0, 0.2):
        knobs = {f"contact.{key}": f"{12.0 * stiffer!r} GPa/m" for key in SHEAR}
        assert grown("facade-tilted", **knobs)["falls"] == pytest.approx(without.factor, rel=0.02)


@pytest.mark.slow
def test_a_wall_of_ten_courses_falls_in_a_run_where_it_does_without_dilation():
    """0.564 against 0.580 with dilation."""
    scene = masonry.load("wall-tilted", {"specimen.courses": 11})
    collapse, without = masonry.run(scene).summary["collapse_load"], masonry.limit(scene, dilation=False).factor
    assert without == pytest.approx(0.5 * (collapse["borne"] + collapse["falls"]), rel=0.005)
    assert collapse["falls"] < 0.98 * masonry.limit(scene).factor


SHEAR = [f"{group}.shear_stiffness" for group in ("unit_unit", "lintels_units", "plate")]


def grown(name: str, dilates: bool = False, **knobs) -> dict:
    """The collapse load of a packaged tilt test by a run in small displacement, to 0.5 %."""
    dry = {"normal_stiffness": "30 GPa/m", "shear_stiffness": "12 GPa/m", "tan_friction_angle": 0.6}
    if dilates:
        angle = float(np.degrees(np.arctan(0.6))) - 1e-9
        dry |= {"law": "brittle", "tensile_strength": "0 Pa", "cohesion": "0 Pa", "tan_residual_friction_angle": 0.6}
        dry |= {"dilation_angle": f"{angle!r} deg", "dilation_cutoff": "0.1 m"}
    left_out = {"gravity.tilt": None, "floor": None, "curve": None, "solver": {}, "assumptions": {}}
    small = {"displacements": "small", "specimen.contact_points": "vertex", "settle.steps": 4000}
    contact = {"contact": {key.split(".")[0]: dict(dry) for key in SHEAR}}
    scene = masonry.load(name, left_out | small | contact | {"limit.accuracy": 0.005})
    return masonry.run(scene.with_(knobs)).summary["collapse_load"]


def test_a_wedge_slides_at_its_critical_friction_angle_of_33_36_degrees():
    assert push_by_hand(np.tan(np.radians(33.3572))) == pytest.approx(0.0, abs=2e-6)
    for angle in (34.0, 36.0, 40.0):
        friction = np.tan(np.radians(angle))
        solution = without_dilation(*wedge(friction)[:2])
        assert solution.converged
        by_hand = push_by_hand(friction)
        assert solution.with_dilation - by_hand > 0.05, "with dilation it has to climb out of the notch"
        assert 0.998 * by_hand < solution.solution.factor < 1.04 * by_hand, (
            "held a little before it slides along the notch"
        )


def test_a_wedge_that_dilation_would_lock_for_ever_slides_without_it():
    friction = np.tan(np.radians(60.0))
    solution = without_dilation(*wedge(friction)[:2])
    assert solution.with_dilation == np.inf and solution.converged
    assert solution.solution.factor == pytest.approx(push_by_hand(friction), rel=2e-3)


def test_the_factor_of_safety_of_a_wedge_without_dilation_is_that_of_the_textbook():
    bodies, contacts, _ = wedge(1.0)
    factor, _, _ = factor_of_safety(bodies, contacts, dilation=False)
    assert np.degrees(np.arctan(1.0 / factor)) == pytest.approx(33.3572, abs=0.1)


def test_with_dilation_a_wedge_is_held_down_to_a_lesser_angle_known_by_hand():
    """It leaves both planes at the friction angle, level: sin(phi) = sin(40) sin(60) / sqrt(sin^2(40) + sin^2(60)),
    since the planes dip at right angles to each other in plan."""
    first, second = (np.sin(np.radians(dip)) for dip, _ in (LEFT, RIGHT))
    by_hand = np.degrees(np.arcsin(first * second / np.hypot(first, second)))
    bodies, contacts, _ = wedge(1.0)
    factor, _, _ = factor_of_safety(bodies, contacts)
    assert np.degrees(np.arctan(1.0 / factor)) == pytest.approx(by_hand, abs=1e-3)
    assert by_hand == pytest.approx(31.0743, abs=1e-4)
    assert largest_factor(*wedge(np.tan(np.radians(by_hand + 0.01)))[:2]).factor < 0.01
