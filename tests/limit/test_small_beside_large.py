"""Small blocks beside large ones: each block is balanced by its own measure, or the answer says which one is not."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import masonry
from geometry.blocks import Blocks
from geometry.specimens.boxes import boxes
from masonry.errors import SceneError
from masonry.statics.balance import unbalanced
from masonry.statics.equilibrium import equilibrium
from masonry.statics.no_dilation import without_dilation
from masonry.statics.problem import RigidBodies, RigidContacts, Solution
from masonry.statics.safety import factor_of_safety
from masonry.statics.sizes import alike
from masonry.statics.solve import Method, largest_factor
from tests.limit.blocks import CONES, PLANE, PYRAMIDS, dry, stack, turned, wall
from tests.scenes import load

WEIGHT = 2e4
"""N/m3."""
CLEAN = 1e-6
"""Gap, and what is left on a block, above which an answer has a word of doubt."""


def pair(large, small, at) -> Blocks:
    """A fixed ground, block 0, a large block on it, and a small one on that."""
    length, depth, height = large
    rows = [
        ("ground", (-5 * length, 0.0, -length), (11 * length, depth, length)),
        ("large", (0.0, 0.0, 0.0), large),
        ("small", (*at, height), small),
    ]
    return boxes([(name, place, size, "units", k, (1, 1, 1)) for k, (name, place, size) in enumerate(rows)], 1.0).blocks


def any_pair(seed: int) -> tuple[RigidBodies, RigidContacts, float]:
    """A pair of some sizes, pushed by its weight sideways, and the factor by hand: the small one slides or tips, or all
    does, or both tip about the edge of the large one."""
    rng = np.random.default_rng([41, seed])
    ratio = 10 ** rng.uniform(0.0, 4.0)
    length = rng.uniform(2.0, 10.0)
    large = (length, rng.uniform(0.3, 1.0) * length, rng.uniform(0.5, 1.0) * length)
    width = length / ratio
    depth = large[1] if rng.random() < 0.4 else min(rng.uniform(0.5, 2.0) * width, large[1])
    small = (width, depth, rng.uniform(1.2, 5.0) * width)
    at = (rng.uniform(0.1, 0.8) * (length - width), rng.uniform() * (large[1] - depth))
    friction = rng.choice([0.15, 0.4, 0.7]) if rng.random() < 0.75 else 10 ** rng.uniform(1.0, 6.0)
    bodies, contacts = dry(pair(large, small, at), [0], friction, density=WEIGHT)
    weight = np.prod(large), np.prod(small)
    arm, lever = np.average([(length / 2, large[2] / 2), (at[0] + width / 2, large[2] + small[2] / 2)], 0, weight)
    return bodies, contacts, min(friction, small[0] / small[2], (length - arm) / lever)


def is_doubted(solution: Solution) -> bool:
    return solution.status != "solved" or max(solution.gap, solution.unbalance) > CLEAN


@pytest.mark.parametrize("seed", range(40))
def test_a_pair_of_any_two_sizes_falls_where_it_does_by_hand_or_is_doubted(seed):
    """In the plane where it is one, by cones, and by cones when all is turned by any angle."""
    bodies, contacts, by_hand = any_pair(seed)
    askew = turned(bodies, contacts, Rotation.random(random_state=seed).as_matrix())
    for problem, method in (((bodies, contacts), PLANE), ((bodies, contacts), CONES), (askew, CONES)):
        solution = largest_factor(*problem, method)
        assert is_doubted(solution) or solution.factor == pytest.approx(by_hand, rel=1e-5)
        assert not is_doubted(solution), "none of these needs a doubt"


SLENDER = {ratio: pair((4.0, 4.0, 2.0), (4 / ratio, 4 / ratio, 16 / ratio), (1.0, 1.0)) for ratio in (1e2, 1e4, 1e5)}
"""Small blocks that tip at 0.25."""
EVERY_RATIO = pytest.mark.parametrize("ratio", SLENDER)


@EVERY_RATIO
@pytest.mark.parametrize("method", [CONES, PYRAMIDS], ids=["cones", "pyramids"])
def test_a_push_on_the_small_block_alone_and_on_the_large_one_alone(ratio, method):
    bodies, contacts = dry(SLENDER[ratio], [0], 0.65, density=WEIGHT)
    weights = -bodies.dead[:, 2]
    for block, by_hand in ((2, 0.25 * weights[2]), (1, 0.65 * (weights[1] + weights[2]))):
        live = np.zeros_like(bodies.live)
        live[block, 0] = 1.0
        solution = largest_factor(replace(bodies, live=live), contacts, method)
        least = by_hand * (np.cos(np.pi / 16) if block == 1 and method is PYRAMIDS else 1.0)
        assert not is_doubted(solution) and least * (1 - 1e-5) < solution.factor < by_hand * (1 + 1e-5)


@EVERY_RATIO
def test_without_dilation_and_for_its_safety_the_small_block_counts_as_well(ratio):
    bodies, contacts = dry(SLENDER[ratio], [0], 0.65, density=WEIGHT)
    end = without_dilation(bodies, contacts, CONES)
    assert end.converged and end.solution.factor == pytest.approx(0.25, rel=1e-4)
    at_a_tenth = replace(bodies, dead=bodies.dead + 0.1 * bodies.live)
    assert factor_of_safety(at_a_tenth, contacts, CONES)[0] == pytest.approx(6.5, rel=1e-5)
    beyond = replace(bodies, dead=bodies.dead + 0.26 * bodies.live)
    with pytest.raises(SceneError, match="no amount of friction and cohesion makes it stand"):
        factor_of_safety(beyond, contacts, CONES)


@EVERY_RATIO
def test_a_large_block_on_four_pebbles_tips_about_them(ratio):
    """They bear all of it, and weigh nothing against it: 2 m over 4 m and a pebble."""
    size = 4.0 / ratio
    rows = [("ground", (-20.0, 0.0, -4.0), (44.0, 4.0, 4.0)), ("large", (0.0, 0.0, size), (4.0, 4.0, 8.0))]
    places = [(x, y, 0.0) for x in (0.0, 4.0 - size) for y in (0.0, 4.0 - size)]
    rows += [(f"pebble {k}", place, (size, size, size)) for k, place in enumerate(places)]
    blocks = boxes([(name, at, by, "units", k, (1, 1, 1)) for k, (name, at, by) in enumerate(rows)], 1.0).blocks
    solution = largest_factor(*dry(blocks, [0], 0.9, density=WEIGHT), CONES)
    assert not is_doubted(solution) and solution.factor == pytest.approx(2.0 / (4.0 + size), rel=1e-5)


@pytest.mark.parametrize(("friction", "drawn", "most"), [(0.7, 0.0, 0.0), (0.5, 0.0, 0.027), (0.7, 0.3, 0.047)])
def test_what_a_contact_bears_beyond_friction_or_draws_counts_as_what_is_left_on_its_block(friction, drawn, most):
    """A flat block pushed by 0.7 of its weight W, four corners bear it by 0.2325 and 0.2675 W, and 0.7 of these along
    them. At 0.5 that is 0.0535 W too much, of 2 W in all; or two draw by 0.0675 W, and bear 0.0945 W too much."""
    bodies, contacts = dry(stack([(2.0, 0.2)]), [0], friction)
    forces = equilibrium(bodies, contacts, alike(bodies, contacts))
    weight, arm = -bodies.dead[1, 2], np.sign(contacts.point - contacts.point.mean(axis=0))
    normal = weight * (0.25 + 0.0175 * arm[:, 0] + drawn * arm[:, 0] * arm[:, 1])
    shear = np.einsum("gki,i->gk", forces.tangent, (-0.7, 0.0, 0.0)) * normal[:, None]
    unit = forces.force
    unknown = np.concatenate([normal / unit, (shear / unit[:, None]).ravel(), [0.7]])
    left = unbalanced(bodies, forces, contacts, unknown)
    assert left[0] == 0.0 and left[1] == pytest.approx(most, abs=0.3 * most + 1e-12)


def test_a_solve_that_ends_too_early_is_told_by_its_block_or_refused(monkeypatch):
    """A solve that ends early is told by the block, whichever it is."""
    monkeypatch.setattr("masonry.statics.solve.TRIES", 1)
    bodies, contacts = dry(SLENDER[1e4], [0], 0.65, density=WEIGHT)
    solution = largest_factor(bodies, contacts, CONES)
    assert solution.factor > 0.6, "in one unit for all the small block floats"
    assert solution.unbalance > 0.01 and solution.worst == 2
    scene = load(SCENE)
    with pytest.raises(SceneError, match=r"no answer: block 2 \('small'\) at .* is balanced only to"):
        masonry.limit(scene)


SCENE = """
law = "friction"
kinematics = "rigid"
[specimen]
kind = "boxes"
section = "1 m^2"
contact_points = "vertex"
box = [
  {name = "ground", origin = ["-2 m", "0 m", "-0.5 m"], size = ["8 m", "2 m", "0.5 m"], unit = 0},
  {name = "large", origin = ["0 m", "0 m", "0 m"], size = ["2 m", "2 m", "2 m"], unit = 1},
  {name = "small", origin = ["1 m", "1 m", "2 m"], size = ["20 mm", "20 mm", "80 mm"], unit = 2},
]
[material.units]
density = "2000 kg/m^3"
[contact.unit_unit]
normal_stiffness = "30 GPa/m"
shear_stiffness = "12 GPa/m"
tan_friction_angle = 0.65
[[support]]
on = "ground"
fix = "all"
[gravity]
z = "-9.81 m/s^2"
[limit]
pattern = "tilt"
about = "y"
"""


@pytest.mark.parametrize("words", [{}, {"sides": 16}, {"dilation": False}])
@pytest.mark.parametrize("size", [20.0, 1.0])
def test_a_slender_block_of_millimetres_on_one_of_two_metres_tips_in_a_scene(size, words):
    small = f'["{size} mm", "{size} mm", "{4 * size} mm"]'
    result = masonry.limit(load(SCENE.replace('["20 mm", "20 mm", "80 mm"]', small)), **words)
    assert result.factor == pytest.approx(0.25, rel=1e-4)
    assert result.remarks == [], "nothing slides, and nothing is doubted"


@pytest.mark.parametrize("friction", [10.0, 1e3, 1e5, 1e6, 1e12])
@pytest.mark.parametrize("method", [PLANE, CONES], ids=["plane", "cones"])
def test_however_great_friction_is_a_wall_tips_where_it_does_with_10(friction, method):
    """A wall of six courses, 0.9525 over 0.5: it falls as one about its edge, 2 m by 1.05 m."""
    solution = largest_factor(*dry(wall(6, halves_below=True), [0], friction), method)
    assert not is_doubted(solution) and solution.factor == pytest.approx(2.0 / 1.05, rel=1e-6)


def test_friction_that_is_too_great_to_be_reckoned_with_has_a_word():
    result = masonry.limit(load(SCENE.replace("= 0.65", "= 1e6")))
    assert result.factor == pytest.approx(0.25, rel=1e-5)
    assert any("1e+06 is taken as 1000" in remark for remark in result.remarks)


def test_a_small_load_across_the_plane_of_large_ones_is_no_plane_problem():
    """Pushed along y by so little that against the weight of the large block it is nothing."""
    bodies, contacts = dry(pair((4.0, 4.0, 2.0), (1e-4, 4.0, 1e-4), (1.0, 0.0)), [0], 0.65, density=WEIGHT)
    across = bodies.dead.copy()
    across[2, 1] = 0.6 * -bodies.dead[2, 2]
    solution = largest_factor(replace(bodies, dead=across), contacts, Method())
    assert solution.factor == pytest.approx(np.sqrt(0.65**2 - 0.6**2), rel=1e-5), "it slides askew"
