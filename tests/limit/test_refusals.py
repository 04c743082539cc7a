"""What has no answer is said in one sentence; so are words that contradict each other."""

import pytest

import masonry
from masonry.errors import SceneError
from masonry.limit_analysis.analysis import LimitSettings, analyse
from tests.limit.one_block import DRIVE, SIDEWAYS, STRONG, block
from tests.scenes import load

REFUSED = {
    "cannot stand": (
        block('[limit]\npattern = "weight"\ndirection = "x"').replace('"0 m", "0 m", "0 m"', '"1.9 m", "0 m", "0 m"'),
        "cannot stand under its dead loads: nothing of them is balanced, and block 1 ('block')",
    ),
    "nothing grows": (block(""), "nothing in this scene grows"),
    "no weight": (
        block('[limit]\npattern = "tilt"\nabout = "y"').replace(
            '[gravity]\nz = "-10 m/s^2"',
            DRIVE,
        ),
        "limit.pattern: 'tilt' needs weight",
    ),
    "two grow": (
        block(
            DRIVE + '[[traction]]\non = "block.z+"\nstress = {z = "-1 kPa"}\nhistory = [["0 s", 0], ["1 s", 1]]\n'
        ).replace('displacement = "1 mm"', 'displacement = "1 mm"\nsteps = 10'),
        "drive and traction.0 vary",
    ),
    "what grows has a history": (
        block(
            '[limit]\npattern = "weight"\ndirection = "x"\n'
            '[[traction]]\non = "block.z+"\nstress = {z = "-1 kPa"}\nhistory = [["0 s", 0], ["1 s", 1]]\n'
        ),
        "traction.0 varies in time, so it is neither dead nor what [limit] names",
    ),
    "on what is held": (
        block('[limit]\npattern = "force"\non = "ground"\nforce = {x = "1 kN"}'),
        "nothing loads this: the force on 'ground' acts on no block that can move",
    ),
    "no limit": (
        block('[limit]\npattern = "force"\non = "block"\nforce = {z = "-1 kN"}'),
        "there is no limit: forces in the joints can balance every factor of the force on 'block'",
    ),
    "no direction": (block('[limit]\npattern = "weight"'), "limit.direction: missing; pattern = 'weight' needs it"),
    "a stray key": (
        block('[limit]\npattern = "weight"\ndirection = "x"\nabout = "y"'),
        "limit.about: belongs to pattern = 'tilt'; leave it out",
    ),
    "an unknown pattern": (block('[limit]\npattern = "wind"'), "'wind' is not allowed; allowed: weight, tilt"),
    "no force": (
        block('[limit]\npattern = "force"\non = "block"\nforce = {x = "0 N"}'),
        "limit.force: is 0 in all directions",
    ),
    "a force on a face": (
        block('[limit]\npattern = "force"\non = "block.z+"\nforce = {x = "1 N"}'),
        "a force acts on whole blocks",
    ),
    "a force beside its block": (
        block('[limit]\npattern = "force"\non = "block"\nforce = {x = "1 kN"}\nat = ["0.25 m", "0.15 m", "-0.5 m"]'),
        "limit.at = (0.25, 0.15, -0.5) m lies outside of 'block'; block 0 holds it: on = 'ground'",
    ),
    "a force beside all blocks": (
        block('[limit]\npattern = "force"\non = "block"\nforce = {x = "1 kN"}\nat = ["0.25 m", "0.15 m", "1.001 m"]'),
        "limit.at = (0.25, 0.15, 1.001) m lies outside of 'block', and in no other block",
    ),
    "a force that not all of its blocks hold": (
        block('[limit]\npattern = "force"\non = "blocks at z = 0 m"\nforce = {x = "1 kN"}\nat = [0, 0, "-0.1 m"]'),
        "lies outside of block 1 of 'blocks at z = 0 m', which bears a part of the force; block 0 holds it",
    ),
    "a traction on a block": (
        block('[limit]\npattern = "traction"\non = "block"\nstress = {x = "1 Pa"}'),
        "a traction acts on a face",
    ),
    "a tilt about the plumb line": (
        block('[limit]\npattern = "tilt"\nabout = "z"'),
        "limit.about: gravity acts along z alone",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_has_no_answer_is_said_in_one_sentence(name):
    text, expected = REFUSED[name]
    with pytest.raises(SceneError) as error:
        masonry.limit(load(text))
    assert expected in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("wishes", "expected"),
    [
        (LimitSettings(at=0.2), "add --safety"),
        (LimitSettings(points="corner"), "did you mean 'corners'"),
        (LimitSettings(sides=2), "it needs 3 or more"),
        (LimitSettings(crushing=1e6, sides=8), "--crushing needs cones"),
    ],
)
def test_words_that_contradict_each_other_are_refused(wishes, expected):
    with pytest.raises(SceneError, match=expected):
        analyse(masonry.load("arch", SIDEWAYS), wishes)


def test_crushing_needs_joints_without_tension():
    scene = load(block('[limit]\npattern = "weight"\ndirection = "x"', STRONG))
    with pytest.raises(SceneError, match="add strength=False"):
        masonry.limit(scene, crushing="1 MPa")
    assert masonry.limit(scene, crushing="1 MPa", strength=False).factor < 0.5


def test_friction_without_dilation_needs_cones():
    with pytest.raises(SceneError, match="dilation=False needs cones; leave out sides="):
        masonry.limit("wall-tilted", dilation=False, sides=16)
