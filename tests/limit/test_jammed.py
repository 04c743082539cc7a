"""Blocks that stand only because they are jammed: found, and named; what stands by itself has no such word."""

import numpy as np
import pytest

import masonry
from geometry.blocks import Blocks
from geometry.polyhedra.construct import extrude
from geometry.structures.arch import arch
from masonry.errors import SceneError
from masonry.statics.jammed import jammed
from masonry.statics.safety import factor_of_safety
from tests.limit.blocks import dry, stack, turned
from tests.limit.one_block import block
from tests.scenes import load


def between_walls(lean: float, more: tuple[np.ndarray, ...] = ()) -> Blocks:
    """Two fixed walls, blocks 0 and 1, and a stone between them, 0.5 m wide at its middle and 0.4 m high.

    Its sides lean outwards by a tangent: above 0 it is a wedge, wider at the top. More loops stand beside them.
    """
    foot, head = 0.25 - 0.2 * lean, 0.25 + 0.2 * lean
    left = np.array([[-0.6, 0.0], [-foot, 0.0], [-head, 0.4], [-0.6, 0.4]])
    stone = np.array([[-foot, 0.0], [foot, 0.0], [head, 0.4], [-head, 0.4]])
    right = np.array([[foot, 0.0], [0.6, 0.0], [0.6, 0.4], [head, 0.4]])
    loops = [left, right, stone, *more]
    count = len(loops)
    return extrude(loops, np.zeros(count), np.full(count, 0.3), np.arange(count), ("units",))


@pytest.mark.parametrize(
    ("lean", "friction", "falls"),
    [(0.0, 0.6, True), (-0.1, 0.6, True), (0.1, 0.6, False), (0.1, 0.05, False)],
    ids=["parallel", "wider below", "wedge", "smooth wedge"],
)
def test_a_stone_between_two_walls_is_jammed_unless_it_is_a_wedge_that_its_weight_drives_in(lean, friction, falls):
    bodies, contacts = dry(between_walls(lean), [0, 1], friction)
    solution = jammed(bodies, contacts)
    assert (solution is not None) == falls
    if solution is not None:
        assert solution.factor < 0.5 and np.argmax(np.linalg.norm(solution.velocity[:, :3], axis=1)) == 2
    askew = turned(bodies, contacts, np.array([[0.6, 0.0, 0.8], [0.0, 1.0, 0.0], [-0.8, 0.0, 0.6]]))
    assert (jammed(*askew) is not None) == falls


def test_what_rests_on_something_is_not_jammed_though_it_touches_both_walls():
    floor = np.array([[-0.6, -0.2], [0.6, -0.2], [0.6, 0.0], [-0.6, 0.0]])
    assert jammed(*dry(between_walls(0.0, (floor,)), [0, 1, 3], 0.6)) is None


@pytest.mark.parametrize("name", ["arch", "slope"])
def test_what_needs_friction_but_no_pressing_is_not_jammed(name):
    problems = {
        "arch": dry(arch(1.0, np.radians(60.0), 7, 0.3, 0.3).blocks, [7, 8], 0.6),
        "slope": dry(stack([(2.0, 0.2)]), [0], 0.6, dead=(np.sin(0.4), 0.0, -np.cos(0.4))),
    }
    assert jammed(*problems[name]) is None


def test_before_it_stands_without_any_friction_none_is_tried():
    with pytest.raises(SceneError, match="stands only if it is jammed"):
        factor_of_safety(*dry(between_walls(0.0), [0, 1], 0.6))
    with pytest.raises(SceneError, match="stands without any friction"):
        factor_of_safety(*dry(between_walls(0.1), [0, 1], 0.6))
    slope = dry(stack([(2.0, 0.2)]), [0], 0.6, dead=(1e-6, 0.0, -1.0))
    with pytest.raises(SceneError, match="share of 0.0001 of its friction and cohesion is enough, but it does not"):
        factor_of_safety(*slope)


def test_a_jam_beside_what_gives_the_factor_has_a_word_in_both_questions():
    """The block tips at 0.5, and slides at a safety of 7 at a tenth; the stone beside it stands by pressing only."""
    jam = """  {name = "left", origin = ["2.1 m", "0 m", "-1 m"], size = ["0.2 m", "0.3 m", "2 m"], unit = 2},
  {name = "stone", origin = ["2.3 m", "0 m", "0.3 m"], size = ["0.5 m", "0.3 m", "0.4 m"], unit = 3},
  {name = "right", origin = ["2.8 m", "0 m", "-1 m"], size = ["0.2 m", "0.3 m", "2 m"], unit = 4},
]
[material"""
    held = "".join(f'[[support]]\non = "{name}"\nfix = "all"\n' for name in ("left", "right"))
    more = '[limit]\npattern = "force"\non = "block"\nforce = {x = "1 kN"}\n' + held
    alone = load(block(more.replace(held, "")))
    beside = load(block(more).replace("]\n[material", jam))
    for words in ({}, {"safety": True, "at": 0.3}):
        right, result = masonry.limit(alone, **words), masonry.limit(beside, **words)
        assert result.factor == pytest.approx(right.factor, rel=1e-5)
        assert not any("jammed" in remark for remark in right.remarks)
        assert any(remark.startswith("block 3 ('stone')") and "jammed" in remark for remark in result.remarks)
    pulled = load(block(more.replace('on = "block"\n', 'on = "stone"\n')).replace("]\n[material", jam))
    with pytest.raises(SceneError, match="there is no limit: .* by jamming, which a run decides"):
        masonry.limit(pulled)


def test_the_factor_of_safety_says_as_plain_limit_does_that_what_slides_does_not_rise():
    """A flat block on an incline, at a tilt of 0.5."""
    tilted = load(block('[limit]\npattern = "tilt"\nabout = "y"', size='["2 m", "0.3 m", "0.2 m"]'))
    word = "rise as they slide"
    for words in ({}, {"safety": True, "at": 0.5}):
        result = masonry.limit(tilted, **words)
        assert any(word in remark for remark in result.remarks)
    tall = load(block('[limit]\npattern = "tilt"\nabout = "y"').replace("= 0.7", "= 0.9"))
    assert not any(word in remark for remark in masonry.limit(tall).remarks), "it tips"


def test_what_is_assumed_comes_before_the_number_and_none_is_a_bound_where_strength_is_plastic():
    sideways = '[limit]\npattern = "weight"\ndirection = "x"'
    dry_one = masonry.limit(load(block(sideways)))
    rows = str(dry_one).splitlines()
    assert [row.split()[0] for row in rows[1:3]] == ["assumed", "load"] and "rigid blocks" in rows[1]
    glued = masonry.limit(masonry.load("shear-wall"))
    for result in (dry_one, glued):
        assert "lower bound" not in str(result)
        assert "dilate by their friction angle" in result.assumed
        assert result.as_data()["assumed"] == result.assumed
    assert "may fall earlier" in dry_one.bound
    assert "last however far a crack opens" in glued.assumed and glued.bound.startswith("no bound")
    bare = masonry.limit(masonry.load("shear-wall"), strength=False)
    assert "crack" not in bare.assumed and not bare.bound.startswith("no bound")
    assert (
        "angle" not in str(masonry.limit(load(block(sideways)), safety=True, at=0.2)).split("factor")[2].split("\n")[0]
    )
