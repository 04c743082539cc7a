"""The limit analysis of a dry scene depends neither on axes nor on numbers, be it one of the plane or of space."""

from functools import cache

import pytest

from masonry.limit_analysis.analysis import LimitSettings, analyse
from masonry.limit_analysis.limit_result import LimitResult
from tests.turned.comparing import ABOUT_BEDS, ABOUT_X, CYCLIC, MIRRORED, NUMBERED, OBLIQUE, TURNS
from verification.checks.turned import NoSuchScene, turned
from verification.scene_runs import load

PLAIN = LimitSettings()


@cache
def limit(name: str, turn: str = "", wishes: LimitSettings = PLAIN) -> LimitResult:
    scene = load(name)
    if not turn:
        return analyse(scene, wishes)
    with turned(scene, TURNS[turn]) as other:
        return analyse(other, wishes)


def require_the_same(one: LimitResult, other: LimitResult, accuracy: float = 1e-6) -> None:
    assert other.factor == pytest.approx(one.factor, rel=accuracy)
    assert other.remarks == one.remarks and other.bound == one.bound
    if one.least is not None:
        assert other.least == pytest.approx(one.least, rel=accuracy)


@pytest.mark.parametrize("turn", [ABOUT_X, ABOUT_BEDS, OBLIQUE, CYCLIC, MIRRORED, NUMBERED])
@pytest.mark.parametrize("name", ["arch-own-weight", "arch-tilted", "wall-tilted", "facade-tilted"])
def test_a_structure_bears_the_same_however_it_is_turned(name, turn):
    require_the_same(limit(name), limit(name, turn))


@pytest.mark.parametrize(
    ("name", "turn"),
    [
        ("column-pushed", ABOUT_X),
        ("column-pushed", CYCLIC),
        ("vault-spreading", ABOUT_X),
        ("vault-spreading", NUMBERED),
        ("wall-out-of-plane", ABOUT_BEDS),
        ("wall-out-of-plane", CYCLIC),
        ("triplet-dry", CYCLIC),
    ],
)
def test_so_does_what_a_drive_pushes(name, turn):
    require_the_same(limit(name), limit(name, turn))


def test_a_plane_problem_is_one_of_space_where_no_axis_lies_across_it():
    plane, space = limit("wall-tilted"), limit("wall-tilted", ABOUT_X)
    assert "in the plane across y" in plane.method and "cone programme" in space.method


@pytest.mark.parametrize("turn", [ABOUT_X, OBLIQUE, CYCLIC, NUMBERED])
def test_the_factor_of_safety_is_the_same(turn):
    wishes = LimitSettings(safety=True, at=0.3)
    assert limit("wall-tilted", "", wishes).factor > 1.5
    require_the_same(limit("wall-tilted", "", wishes), limit("wall-tilted", turn, wishes), 1e-5)


@pytest.mark.slow
@pytest.mark.parametrize("turn", [ABOUT_X, OBLIQUE, CYCLIC, NUMBERED])
def test_friction_without_dilation_comes_to_the_same(turn):
    one, other = (limit("wall-tilted", how, LimitSettings(dilation=False)) for how in ("", turn))
    assert other.factor == pytest.approx(one.factor, rel=2e-3), "it follows the forces step by step"


@pytest.mark.slow
@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("name", ["dome-own-weight", "wall-with-window", "wall-to-and-fro", "arch-spread"])
def test_a_larger_structure_bears_the_same_too(name, turn):
    try:
        other = limit(name, turn)
    except NoSuchScene as why:
        pytest.skip(str(why))
    require_the_same(limit(name), other)
