"""What a message about a scene advises is carried out, each way on its own: the scene is taken then, and not refused
for another reason that follows from the advice."""

import re

import pytest

from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from masonry.scene import Scene
from masonry.scene import load as packaged
from tests.limit.one_block import DRIVE, STRONG, block
from tests.scenes import load

REAL = '[solver]\nmasses = "real"\nduration = "1 s"\n'
SIDEWAYS = '[limit]\npattern = "weight"\ndirection = "x"\n'
GROWS = SIDEWAYS + "accuracy = 0.01\n"
TOP = '[[gauge]]\nname = "top"\nat = "block.z+"\ndirection = "x"\n'
SINE = {"x": "0.1 g * sin(2 pi t / 1 s)", "duration": "2 s"}
SHAKES = '[ground]\nx = "0.1 g * sin(2 pi t / 1 s)"\nduration = "2 s"\n'
LARGE = {"displacements": "large"}
TILT = {"about": "y", "angle": "10 deg"}
RISES = [["0 s", 0], ["1 s", 1]]
PUSH = {"on": "block.z+", "stress": {"z": "-1 kPa"}}
MOVES = [{"on": "block", "velocity": ["1 m/s", "0 m/s", "0 m/s"]}]
DRIVEN = {"on": "block", "direction": "x", "displacement": "1 mm"}
ALONE = "the load of .limit. grows alone.*; leave this out, or limit.accuracy"
DAMPED = "balanced by damped motion with scaled masses; leave it out"
GLUED = {"contact.unit_unit.law": "brittle", "contact.unit_unit.tensile_strength": "1 kPa"}
CONTACT = "contact.unit_unit."


def one(more: str = "", law: str = 'law = "friction"') -> Scene:
    """The block on ground."""
    return load(block(more, law))


def large(more: str = "") -> Scene:
    return one(more).with_(LARGE)


def dropped(*keys: str) -> dict[str, None]:
    """These keys are left out."""
    return dict.fromkeys(keys)


HINTS = {
    "limits of small displacement": (
        large, {"solver.slip_limit": 0.2}, "leave it out", [dropped("solver.slip_limit")]),
    "a tilt about the weight": (
        one, {"limit": {"pattern": "tilt", "about": "z"}}, "turning it changes nothing", [{"limit.about": "y"}]),
    "a drive that is not there": (
        one, {"limit": {"pattern": "drive"}}, r"needs a table \[drive\]", [{"drive": DRIVEN}]),
    "a drive beside a load that grows": (
        GROWS, {"drive": DRIVEN}, ALONE, [dropped("drive"), {"limit.accuracy": None}]),
    "a traction that varies beside it": (
        GROWS, {"traction": [PUSH | {"history": RISES}]}, ALONE, [{"traction": [PUSH]}, {"limit.accuracy": None}]),
    "a weight that tilts beside it": (
        GROWS, {"gravity.tilt": TILT | {"steps": 1000}}, ALONE, [dropped("gravity.tilt"), {"limit.accuracy": None}]),
    "shaken ground beside it": (
        GROWS, {"ground": SINE}, ALONE,
        [dropped("ground"), {"limit.accuracy": None, "solver.masses": "real"}]),
    "a motion beside it": (GROWS, {"motion": MOVES}, DAMPED, [dropped("motion")]),
    "damping of real masses beside it": (GROWS, {"damping": {"mass": "1 s^-1"}}, DAMPED, [dropped("damping")]),
    "real masses beside it": (GROWS, {"solver.masses": "real"}, DAMPED, [dropped("solver.masses")]),
    "a duration beside it": (GROWS, {"solver.duration": "1 s"}, DAMPED, [dropped("solver.duration")]),
    "rest beside it": (
        lambda: large(GROWS), {"solver.until": "rest"}, DAMPED, [dropped("solver.until")]),
    "no damping beside it": (GROWS, {"solver.damping": 0.0}, DAMPED, [dropped("solver.damping")]),
    "samples in time beside it": (GROWS, {"solver.sampling": "9 Hz"}, DAMPED, [dropped("solver.sampling")]),
    "a velocity beside it": (
        GROWS + TOP, {"gauge.0.quantity": "velocity"}, DAMPED, [{"gauge.0.quantity": "displacement"}]),
    "a history of it": (
        SIDEWAYS, {"limit.history": [1, -1]}, r"accuracy = '1 %', and a table \[\[gauge\]\]",
        [{"limit.accuracy": "1 %", "gauge": [{"name": "top", "at": "block.z+", "direction": "x"}]}]),
    "where it ends": (SIDEWAYS, {"limit.up_to": 3}, "needs accuracy = '1 %'", [{"limit.accuracy": "1 %"}]),
    "a gauge that it leads": (
        GROWS + TOP, {"limit.control": "top"}, "until = '80 mm'", [{"limit.until": "80 mm"}]),
    "a restitution in small displacement": (
        one, {CONTACT + "restitution": 0.1}, r"'?displacements = .large.*; \[damping\] serves both, with real masses",
        [LARGE, {CONTACT + "restitution": None, "damping": {"mass": "1 s^-1"}, "solver.masses": "real"}]),
    "rest in small displacement": (
        one, {"solver.until": "rest"}, "'real' and a duration such as '10 s'",
        [LARGE | {"solver.masses": "real", "solver.duration": "10 s"}, dropped("solver.until")]),
    "rest without an end": (
        large, {"solver.until": "rest"}, "the latest end, such as '10 s', and solver.masses = 'real'",
        [{"solver.duration": "10 s", "solver.masses": "real"}]),
    "points of patches": (one, {"specimen.patch_points": "spread"}, "needs displacements", [LARGE]),
    "contacts of any groups": (
        one, {"contact.default": {"law": "friction", "normal_stiffness": "1 GPa/m", "shear_stiffness": "1 GPa/m",
                                  "tan_friction_angle": 0.5}}, "needs displacements",
        [LARGE, dropped("contact.default")]),
    "rows and samples": (
        REAL, {"solver.sampling": "9 Hz", "solver.rows": 100}, "keep one of them",
        [dropped("solver.rows"), dropped("solver.sampling")]),
    "a motion of scaled masses": (
        one, {"motion": MOVES}, "solver.masses = 'real', and a solver.duration such as '2 s'",
        [{"solver.masses": "real", "solver.duration": "2 s"}]),
    "a motion of scaled masses beside a drive": (
        one, {"motion": MOVES, "drive": DRIVEN | {"rate": "1 mm/s"}}, "needs solver.masses = 'real': scaled",
        [{"solver.masses": "real"}]),
    "scaled masses on shaken ground": (
        SHAKES, {"solver.masses": "scaled"}, "say 'real', or leave it out",
        [{"solver.masses": "real"}, dropped("solver.masses")]),
    "ground that a scene of scaled masses gets": (one, {"ground": SINE}, "say 'real'", [{"solver.masses": "real"}]),
    "a drive to an accuracy on shaken ground": (
        SHAKES, {"drive": DRIVEN}, "give drive.rate, or a history with times",
        [{"drive": DRIVEN | {"rate": "1 mm/s"}},
         {"drive": {"on": "block", "direction": "x", "history": [["0 s", "0 mm"], ["1 s", "1 mm"]]}}]),
    "a drive on supports that move": (
        SHAKES, {"ground.as": "base", "drive": DRIVEN | {"rate": "1 mm/s"}}, "take ground.as = 'inertia'",
        [{"ground.as": "inertia"}]),
    "damping of a drive": (
        '[solver]\nmasses = "real"\n', {"damping": {"mass": "1 s^-1"}, "drive": DRIVEN | {"rate": "1 mm/s"}},
        r"give a \[ground\] instead", [{"drive": None, "ground": SINE}]),
    "damping of supports that move": (
        SHAKES, {"ground.as": "base", "damping": {"mass": "1 s^-1"}}, "ground.as = 'inertia' only",
        [{"ground.as": "inertia"}]),
    "few steps for layers": (one, {"gravity.layers": 10, "settle": {"steps": 10}}, "give 200 or more",
                             [{"settle": {"steps": 200}}]),
    "a weight that varies beside an accuracy": (
        DRIVE, {"gravity.history": RISES}, "give drive.steps or drive.rate",
        [{"drive.steps": 5000}, {"drive.rate": "1 mm/s"}]),
    "a tilt in steps beside a drive": (
        DRIVE, {"drive.steps": 4000, "gravity.tilt": TILT | {"steps": 1000}}, "give a duration in its place",
        [{"gravity.tilt": TILT | {"duration": "1 s"}}]),
    "a tilt by nothing": (
        one, {"gravity.tilt": TILT | {"angle": "0 deg", "steps": 10}}, "leave the table out, or give an angle",
        [dropped("gravity.tilt"), {"gravity.tilt": TILT | {"steps": 10}}]),
    "a key of a cap": (
        one, {CONTACT + "closing_at_peak": "1 mm"}, 'goes with crushing = "cap"$',
        [{CONTACT + "crushing": "cap", CONTACT + "compressive_strength": "5 MPa",
          CONTACT + "fracture_energy_compression": "5 N/mm"}]),
    "a cap without its numbers": (
        one, {CONTACT + "crushing": "cap"},
        "which needs compressive_strength and fracture_energy_compression and closing_at_peak",
        [{CONTACT + "compressive_strength": "5 MPa", CONTACT + "fracture_energy_compression": "5 N/mm",
          CONTACT + "closing_at_peak": "1 mm"}]),
    "a key of a cap beside a cut-off": (
        one, {CONTACT + "crushing": "cut-off", CONTACT + "compressive_strength": "5 MPa",
              CONTACT + "closing_at_peak": "1 mm"}, "leave it out", [dropped(CONTACT + "closing_at_peak")]),
    "a seed alone": (
        one, {"scatter": {"seed": 3}}, r"name a group: \[scatter.unit_unit\]",
        [GLUED | {CONTACT + "cohesion": "1 kPa", "scatter": {"seed": 3, "unit_unit": {"cohesion": 0.2}}}]),
    "a key of the whole scene": (
        lambda: one("", STRONG), {"cohesion": "9 kPa"}, "did you mean 'contact.unit_unit.cohesion'",
        [dropped("cohesion") | {CONTACT + "cohesion": "9 kPa"}]),
    "a specimen that is misspelt": (one, {"specimen.kind": "boxs"}, "did you mean 'boxes'", [dropped("specimen.kind")]),
    "ground by a misspelt support": (
        SHAKES, {"ground.on": "grund", "ground.as": "base"}, "did you mean 'ground'", [{"ground.on": "ground"}]),
    "a support by a misspelt set": (
        one, {"support.0.on": "grond"}, "did you mean 'ground'.*'block.z.'",
        [{"support.0.on": "ground"}, {"support.0.on": "block.z+"}]),
    "a support in no plane": (
        one, {"support.0.on": "z = 0.3 m"}, "z = -1000 mm, z = 0 mm, z = 1000 mm",
        [{"support.0.on": "z = -1000 mm"}, {"support.0.on": "z = 1000 mm"}]),
    "a traction on a set": (
        one, {"traction": [PUSH | {"on": "block"}]}, "for example 'block.z.'", [{"traction": [PUSH]}]),
    "a motion of a face": (
        REAL, {"motion": [MOVES[0] | {"on": "block.z+"}]}, "name a set, without a face", [{"motion": MOVES}]),
    "a bar that is slack and pretensioned": (
        lambda: packaged("wall-tied"), {"bar.0.slack": "1 mm", "bar.0.pretension": "1 kN"}, "keep one of",
        [dropped("bar.0.slack"), dropped("bar.0.pretension")]),
}  # fmt: skip
"""A scene, or what it has besides the block; keys set wrong; the words of the message; each way out of it."""


def refusal(scene: Scene, settings: dict, built: bool = True) -> str:
    """Why a scene is not taken with these keys; "" where it is."""
    try:
        made = scene.with_(settings)
        if built:
            assemble(made)
    except SceneError as error:
        return str(error)
    return ""


@pytest.mark.parametrize("name", HINTS)
def test_what_a_message_advises_is_taken(name):
    base, wrong, words, ways = HINTS[name]
    scene = one(base) if isinstance(base, str) else base()
    built = not (said := refusal(scene, wrong, built=False))
    with pytest.raises(SceneError, match=words):
        raise SceneError(said or refusal(scene, wrong))
    for way in ways:
        keys = {key: value for key, value in (wrong | way).items() if value is not None or key not in wrong}
        assert not refusal(scene, keys, built), way


@pytest.mark.parametrize("name", ["couplet", "prism-in-compression", "house-tilted"])
def test_the_face_that_a_message_gives_for_an_example_is_there_and_free(name):
    scene = packaged(name)
    said = refusal(scene, {"traction": [PUSH | {"on": "nope"}]})
    (face,) = re.findall(r"or a face of one, such as '(.*)'$", said)
    assert face.partition(".")[2] in ("z-", "x+") and not refusal(scene, {"traction": [PUSH | {"on": face}]})


def test_a_face_of_its_own_set_is_an_example_and_none_is_given_where_whole_blocks_are_meant():
    """The ground is covered in part from above, and free from below."""
    said = refusal(one(), {"traction": [PUSH | {"on": "ground"}]})
    assert said.endswith("a traction acts on a face, for example 'ground.z-'")
    said = refusal(one(REAL), {"motion": [MOVES[0] | {"on": "blok"}]})
    assert said.endswith("known here: block, ground, units; did you mean 'block'?")


def test_rows_are_taken_in_place_of_samples_and_the_other_way_round():
    """Also of a scene that was changed before, which has its rows in words."""
    scene = one(REAL).with_({"solver.damping": 0.5})
    sampled = scene.with_({"solver.sampling": "20 Hz"})
    assert sampled.solver.sampling == 20.0 and sampled.with_({"solver.rows": 50}).solver.rows == 50
