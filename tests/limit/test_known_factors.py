"""Limit analysis against closed forms and published factors: walls, strips, stacks, arches."""

from dataclasses import replace

import numpy as np
import pytest

from geometry.structures.arch import arch
from masonry.statics.problem import RigidBodies, RigidContacts
from masonry.statics.solve import STANDS, largest_factor, standing
from tests.limit.blocks import CONES, PLANE, PYRAMIDS, dry, stack, wall

WAYS = {"plane": PLANE, "cones": CONES, "pyramids": PYRAMIDS}
EVERY_WAY = pytest.mark.parametrize("method", WAYS.values(), ids=WAYS.keys())


def strip(thickness: float, height: float, courses: int, overburden: float) -> tuple[RigidBodies, RigidContacts]:
    """A strip of wall between floors, pushed by its weight sideways; the floor above weighs so much of it, and stays
    level and in its place."""
    slab = [(thickness, 0.1)] if overburden else []
    blocks = stack([(thickness, height / courses)] * courses + slab)
    density = np.ones(blocks.count)
    if not overburden:
        return dry(blocks, [0], 0.7)
    density[-1] = overburden * height / 0.1
    bodies, contacts = dry(blocks, [0], 0.7, density=density)
    bodies.live[-1] = 0.0
    bodies.free[-1] = np.arange(6) == 2
    return bodies, contacts


def strip_by_hand(thickness: float, height: float, courses: int, overburden: float) -> float:
    """Three hinges: at the base, at a joint, and at the edge of the floor above, which is lifted there."""
    if not overburden:
        return thickness / height
    at = np.arange(1, courses) / courses
    return float((2 * thickness / height * ((1 + overburden) / at + overburden / (1 - at))).min())


@EVERY_WAY
@pytest.mark.parametrize(
    ("thickness", "height", "courses", "overburden", "known"),
    [(0.1, 2.0, 10, 0.5, 0.375), (0.11, 1.5, 20, 1.0, 0.85556), (0.1, 2.0, 10, 0.0, 0.05)],
)
def test_a_strip_between_floors_bulges_out_at_its_three_hinges(method, thickness, height, courses, overburden, known):
    by_hand = strip_by_hand(thickness, height, courses, overburden)
    assert by_hand == pytest.approx(known, abs=5e-6)
    solution = largest_factor(*strip(thickness, height, courses, overburden), method)
    assert solution.factor == pytest.approx(by_hand, rel=1e-6)
    assert solution.gap < 1e-6 and solution.unbalance < 1e-7


@EVERY_WAY
def test_wall_1_of_ferris_and_tin_loi(method):
    bodies, contacts = dry(wall(6, halves_below=True), [0], 0.65)
    assert len(bodies.centre) == 34, "33 blocks on the ground"
    exact = 0.64286
    factor = largest_factor(bodies, contacts, method).factor
    if method is PYRAMIDS:
        assert exact * np.cos(np.pi / 16) < factor < exact, "pyramids stand within the cones"
    else:
        assert factor == pytest.approx(exact, rel=1e-4)


@EVERY_WAY
def test_a_stack_of_blocks_leans_as_far_as_the_harmonic_series_and_no_farther(method):
    def share(of_the_limit: float) -> float:
        shifts = np.cumsum([of_the_limit / (2 * k) for k in range(10, 0, -1)])
        ends = np.concatenate([[0.0], shifts[:-1]])  # the lowest block on the ground is block 10 of the series
        blocks = stack([(1.0, 0.2)] * 11, np.concatenate([ends, [shifts[-1]]]))
        solution = standing(*dry(blocks, [0], 0.7), method)
        return solution.factor if solution.status == "solved" else 0.0

    assert share(0.9999) >= STANDS
    assert share(1.0001) < 1e-3


@EVERY_WAY
def test_oppenheims_arch_falls_at_its_tilt(method):
    bodies, contacts = dry(arch(1.0, np.radians(157.5), 7, 0.15, 0.3).blocks, [7, 8], 0.7)
    assert largest_factor(bodies, contacts, method).factor == pytest.approx(0.37361, abs=3e-6)


@pytest.mark.parametrize("method", [PLANE, CONES], ids=["plane", "cones"])
def test_the_least_thickness_of_a_semicircle_of_16_voussoirs(method):
    def stands(thickness: float) -> bool:
        blocks = arch(1.0, np.pi, 16, thickness, 0.3).blocks
        solution = standing(*dry(blocks, [16, 17], 0.7), method)
        return solution.status == "solved" and solution.factor >= STANDS

    low, high = 0.10, 0.12
    while high - low > 1e-6:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if stands(middle) else (middle, high)
    assert high == pytest.approx(0.10708, rel=1e-4)


def test_one_block_slides_or_topples_whichever_is_first():
    for friction, slender in ((0.3, 0.5), (0.7, 0.5), (0.7, 3.0)):
        solution = largest_factor(*dry(stack([(slender, 1.0)]), [0], friction))
        assert solution.factor == pytest.approx(min(friction, slender), rel=1e-9)


def test_strength_of_a_joint_holds_a_block_as_a_plastic_hinge_by_hand():
    """Tension f over the area A of a base of width b turns with the lever b/2: W h/2 = (W + f A) b/2."""
    bodies, contacts = dry(stack([(0.5, 1.0)]), [0], 5.0)
    weight, tension = 0.5 * 1.0 * 0.3, 0.2
    strong = replace(contacts, tension=tension * contacts.area, cohesion=10.0 * contacts.area)
    by_hand = (weight + tension * 0.5 * 0.3) * 0.5 / (weight * 1.0)
    for method in WAYS.values():
        assert largest_factor(bodies, strong, method).factor == pytest.approx(by_hand, rel=1e-7)


def test_cohesion_adds_to_friction_in_sliding():
    bodies, contacts = dry(stack([(2.0, 1.0)]), [0], 0.4)
    weight, cohesion = 2.0 * 0.3, 0.1
    strong = replace(contacts, cohesion=cohesion * contacts.area)
    for method in (PLANE, CONES):
        assert largest_factor(bodies, strong, method).factor == pytest.approx(0.4 + cohesion * 0.6 / weight, rel=1e-7)


@EVERY_WAY
def test_blocks_that_are_glued_move_as_one_and_glue_that_slides_bears_any_pull(method):
    """Three blocks, the upper joints solid, two beyond the edge of the lowest one: they topple together about it."""
    bodies, contacts = dry(stack([(0.5, 0.4)] * 3, [0.0, 0.3, 0.3]), [0], 5.0)
    none, solid = np.zeros(contacts.count), contacts.block_a > 0
    glued = replace(contacts, solid=solid, friction=np.where(solid, 0.0, 5.0))
    assert largest_factor(bodies, glued, method).factor == pytest.approx((0.5 - 0.45) / 0.6, rel=1e-6)
    sliding = replace(contacts, friction=none, tension=none + np.inf)
    up = replace(bodies, live=-bodies.dead)
    assert largest_factor(up, sliding, method).status == "unbounded"
    assert largest_factor(bodies, sliding, method).factor == pytest.approx(0.0, abs=1e-7)


@pytest.mark.parametrize("accuracy", [1e-3, 1e-5, 1e-7])
def test_the_gap_that_is_told_is_no_less_than_the_error_of_a_solve_that_ends_early(accuracy, monkeypatch):
    monkeypatch.setattr("masonry.statics.interior_point.ACCURACY", accuracy)
    bodies, contacts = dry(wall(12, halves_below=True), [0], 0.65, live=(0.3, 1.0, 0.0))
    solution = largest_factor(bodies, contacts, CONES)
    error = abs(solution.factor - 0.1 / (0.175 * 12))
    assert 1e-12 < error <= solution.gap * solution.factor <= accuracy
