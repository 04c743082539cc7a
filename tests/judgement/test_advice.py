"""What doubts advise is carried out, on a scene that may raise them: it is never refused, and the doubt goes where a
check tells."""

import re
from functools import cache
from pathlib import Path

import pytest

from masonry.cli.main import main
from masonry.errors import SceneError, Stopped
from masonry.judgement.catalogue import criteria
from masonry.laboratory import laboratory
from masonry.scene import Scene
from masonry.scene import load as packaged
from masonry.scene.schema import INVENTED
from tests.judgement.test_table_of_doubts import OF_BLOCKS
from tests.limit.one_block import DRIVE, STRONG, block
from tests.scenes import load

REAL = '[solver]\nmasses = "real"\nduration = "1 s"\n'
SIDEWAYS = '[limit]\npattern = "weight"\ndirection = "x"\n'
LED = SIDEWAYS + 'accuracy = 0.01\ncontrol = "top"\nuntil = "5 mm"\n'
LED += '[[gauge]]\nname = "top"\nat = "block.z+"\ndirection = "x"\n'
SHAKES = '[ground]\nx = "0.1 g * sin(2 pi t / 1 s)"\nduration = "2 s"\n'
RECORD = "[" + ", ".join(f'["{0.1 * k:g} s", "{2 * (k % 2)} mm"]' for k in range(9)) + "]"
LARGE = {"displacements": "large"}
DRY = {"law": "friction", "normal_stiffness": "30 GPa/m", "shear_stiffness": "12 GPa/m", "tan_friction_angle": 0.7}
TETS = {"kinematics": "tets", "material.units.young_modulus": "10 GPa", "material.units.poisson_ratio": 0.2}
TETS |= {"specimen.mesh_size": "200 mm"}


def one(more: str = "", law: str = 'law = "friction"', **changes) -> Scene:
    """The block on ground, with keys set anew."""
    return load(block(more, law)).with_({key.replace("__", "."): value for key, value in changes.items()})


def large(more: str = "", **changes) -> Scene:
    return one(more, displacements="large", **changes)


def meshed(more: str = "", **changes) -> Scene:
    return one(more).with_(TETS | {key.replace("__", "."): value for key, value in changes.items()})


POINTED = {
    "specimen.points_per_edge": 2,
    "specimen.points_per_face": 4,
    "specimen.contact_spacing": "100 mm",
}
"""Each way in which a scene may say how many contact points it has."""
MORE_POINTS = [({key: value}, {"specimen.points_per_edge": 12}) for key, value in POINTED.items()]


@cache
def cures() -> dict[str, list[tuple[Scene, list[dict]]]]:
    """By the name of a doubt: scenes that may raise it, and what its advice comes to, each on its own."""
    return {
        "dissipation": [(one(DRIVE), [{"solver.step_fraction": 0.3}])],
        "mode_2_energy": [(one(DRIVE, STRONG), [{"solver.step_fraction": 0.3}])],
        "energy_numbers": [(one(DRIVE), [{"contact.unit_unit.shear_stiffness": "12 GPa/m"}])],
        "redetection": [(large(SIDEWAYS), [{"contact.unit_unit.normal_stiffness": "300 GPa/m"}])],
        "overlap": [(one(SIDEWAYS), [{"contact.unit_unit.normal_stiffness": "300 GPa/m"}])],
        "compression": [
            (one(DRIVE, law + 'compressive_strength = "5 MPa"\n', **more), [
                {"contact.unit_unit.crushing": "cut-off"},
                {"contact.unit_unit.crushing": "cap", "contact.unit_unit.fracture_energy_compression": "5 N/mm",
                 "contact.unit_unit.closing_at_peak": "1 mm"},
            ])
            for law in (STRONG, 'law = "friction"\n') for more in ({}, LARGE)
        ],  # fmt: skip
        "not_quasi_static": [
            (one(DRIVE, drive__accuracy=0.02), [{"drive.accuracy": 0.005}]),
            (one(DRIVE, drive__rate="1 mm/s"), [{"drive.accuracy": 0.005}, {"drive.rate": "0.1 mm/s"}]),
        ],
        "still_rising": [
            (one(DRIVE), [{"drive.displacement": "9 mm"}]),
            (one(DRIVE.replace('displacement = "1 mm"', 'history = ["1 mm", "2 mm"]')),
             [{"drive.displacement": "9 mm"}]),
        ],
        "peak_between_steps": [
            (one(DRIVE, drive__accuracy=0.02), [{"drive.steps": 90000}]),
            (one(DRIVE, drive__steps=4000), [{"drive.steps": 90000}, {"drive.accuracy": 0.01}]),
        ],
        "local_damping": [(one('[solver]\nmasses = "real"\nduration = "1 s"\n'), [{"solver.damping": 0}])],
        **{
            name: [(one("[settle]\nsteps = 10\n"), [{"settle.steps": 4000}, {"settle": None}]),
                   (one(), [{"settle.steps": 9000}])]
            for name in ("unbalanced_after_settling", "kinetic_after_settling", "unbalanced_block", "kinetic_block")
        },
        "one_history": [(packaged("block-shaken"), [{"ground.made.seed": 2}, {"ground.peak": "0.2 g"}])],
        "still_moves": [(packaged("column-pulse"), [{"solver.duration": "30 s"}])],
        "coarse_swings": [(one('[solver]\nmasses = "real"\nduration = "1 s"\n'), [{"solver.step_fraction": 0.1}])],
        "nothing_fell": [(one(SIDEWAYS, limit__accuracy=0.01), [{"limit.up_to": 9}])],
        **{
            name: [
                (one(SIDEWAYS, limit__accuracy=0.01), [LARGE]),
                (one(SIDEWAYS, limit__accuracy=0.01, solver__rotation_limit=0.1, solver__slip_limit=0.5), [LARGE]),
                (packaged("wall-tied", {"limit.accuracy": 0.01}), [LARGE]),
                (packaged("shear-wall"), [LARGE]),
            ]
            for name in ("sway", "falls_by_turning", "came_loose", "meeting", "later_rest")
        },
        "branch_end": [
            (one(LED), [{"limit.until": "-5 mm"}, LARGE]),
        ],
        "branch_rises": [(one(LED), [{"limit.control": None, "limit.until": None}])],
        "time_step": [(one('[solver]\nmasses = "real"\nduration = "1 s"\ntime_step = "1 ms"\n'),
                       [{"solver.time_step": "1 us"}, {"solver.time_step": "gershgorin"}])],
        "locking": [(meshed(material__units__poisson_ratio=0.45), [{"kinematics": "affine"}])],
        "mesh_inertia": [(meshed(REAL, displacements="large", specimen__mesh_size="1 m"),
                          [{"specimen.mesh_size": "100 mm"}]),
                         (meshed(REAL, displacements="large", specimen__mesh="fan"),
                          [{"specimen.mesh": "gmsh", "specimen.mesh_size": "100 mm"}])],
        "sharp_edge": [(meshed(displacements="large"), [{"kinematics": "affine"}, {"kinematics": "rigid"}])],
        "tough_joint": [
            (one("", STRONG, contact__unit_unit__tensile_strength="1 Pa"),
             [{f"contact.unit_unit.{key}": value} for key, value in
              {"fracture_energy_mode_1": "1e-3 N/m", "tensile_strength": "0 Pa"}.items()]),
        ],
        "no_dilation": [
            (one("", 'law = "friction"\ndilation_angle = "10 deg"\n'),
             [{f"contact.unit_unit.{key}": value for key, value in {
                 "law": "brittle", "tensile_strength": "0 Pa", "cohesion": "0 Pa",
                 "dilation_cutoff": "1 mm"}.items()}]),
        ],
        "dilation_lost": [(large("", contact__unit_unit__law="brittle", contact__unit_unit__tensile_strength="0 Pa",
                                 contact__unit_unit__cohesion="0 Pa", contact__unit_unit__dilation_angle="10 deg",
                                 contact__unit_unit__dilation_cutoff="1 m"),
                           [{"contact.unit_unit.dilation_cutoff": "0.01 mm"}])],
        "endless_dilation": [(one(DRIVE, STRONG, contact__unit_unit__dilation_angle="10 deg"),
                              [{"contact.unit_unit.dilation_cutoff": "0.1 mm"},
                               {"contact.unit_unit.fracture_energy_mode_2": "1 N/m"}])],
        "value": [(one(material__units__density="2e6 kg/m^3"), [{"material.units.density": "2000 kg/m^3"}])],
        "shaken_drive": [
            (one(f'[drive]\non = "block"\ndirection = "x"\nhistory = {RECORD}\n[solver]\nmasses = "real"\n'),
             [{"drive.history": "1 mm * (1 - cos(2 pi t / 2 s))", "drive.duration": "2 s"},
              {"drive": None, "ground.x": "0.1 g * sin(2 pi t / 1 s)", "ground.duration": "1 s"}]),
        ],
        "load_left_out": [
            (one(SIDEWAYS), [{"limit.accuracy": 0.01}, {"limit.accuracy": "none"}]),
            (one(SIDEWAYS + '[solver]\nmasses = "real"\nduration = "1 s"\n'),
             [{"limit.accuracy": 0.01, "solver.masses": "scaled", "solver.duration": None},
              {"limit.accuracy": "none"}]),
            (packaged("bridge", {"limit.accuracy": None}),
             [{"limit.accuracy": "1 %", "vehicle.position": "1.3 m"}, {"limit.accuracy": "none"}]),
        ],
        "placeholders": [(one(assumptions={"contact.unit_unit": INVENTED}),
                          [{"assumptions": {}}])],
        "rocking": [(one(specimen__contact_points="gauss", specimen__points_per_edge=2),
                     [{"specimen.contact_points": "vertex"}]),
                (one("", 'law = "friction"\ncompressive_strength = "1 MPa"\ncrushing = "cut-off"\n',
                     specimen__contact_points="gauss", specimen__points_per_edge=2),
                 [{"specimen.points_per_edge": 6}])],
        "closed_joints": [
            (packaged("arch-own-weight"), [{"specimen.points_per_edge": 12}, {"specimen.contact_points": "gauss"}]),
            *((one().with_(given), [cure]) for given, cure in MORE_POINTS),
            (meshed(), [{"specimen.mesh_size": "50 mm"}]),
            (large(), [{"specimen.patch_points": "spread"}, {"specimen.patch_points": "corners"}]),
        ],
        "turned_beds": [(large(specimen__points_per_edge=3),
                         [{"specimen.patch_points": "spread"}, {"specimen.patch_points": "corners"}])],
        "few_points": [
            *((one(DRIVE, STRONG).with_(given), [cure]) for given, cure in MORE_POINTS),
            (meshed(DRIVE), [{"specimen.mesh_size": "50 mm"}]),
        ],
        "coarse_mesh": [(meshed(DRIVE), [{"specimen.mesh_size": "50 mm"}]),
                        (meshed(DRIVE, specimen__mesh="fan"),
                         [{"specimen.mesh": "gmsh", "specimen.mesh_size": "50 mm"}])],
        **{
            name: [
                (one(DRIVE, 'law = "friction"\ncompressive_strength = "1 MPa"\ncrushing = "cut-off"\n').with_(given),
                 [{"specimen.points_per_edge": 10}])
                for given in ({}, *({key: value} for key, value in POINTED.items()))
            ] + [(large(DRIVE, contact__unit_unit__compressive_strength="1 MPa", contact__unit_unit__crushing="cut-off",
                        specimen__patch_points_per_edge=2), [{"specimen.patch_points_per_edge": 10}])]
            for name in ("crushed_toes", "crushing_energy")
        },
        "hinges": [
            (one(DRIVE, STRONG, specimen__points_per_edge=1, specimen__contact_points="gauss"),
             [{"specimen.points_per_edge": 4}]),
            (one(DRIVE, STRONG, specimen__points_per_face=1, specimen__contact_points="gauss"),
             [{"specimen.points_per_face": 16}]),
            (one(DRIVE, STRONG, specimen__contact_spacing="1 m", specimen__contact_points="gauss"),
             [{"specimen.contact_spacing": "75 mm"}]),
        ],
        **{
            name: [(large(solver__masses="real", solver__until="rest", solver__duration="2 s"),
                    [{"solver.duration": "9 s"}, {"contact.unit_unit.normal_dashpot": 0.5}])]
            for name in ("unrest", "unrest_of_block")
        },
        "squeezed_blocks": [(large().with_(TETS | {"kinematics": "affine", "specimen.mesh_size": None}),
                             [{"material.units.young_modulus": "90 GPa"}, {"kinematics": "rigid"}])],
        "stretched_blocks": [(large().with_(TETS), [{"solver.step_fraction": 0.3}])],
        "left_floor": [(packaged("block-shaken"), [{"floor.size": ["60 m", "40 m"]}])],
        "hard_impacts": [(large(SHAKES),
                          [{f"contact.unit_unit.{key}": 0.3} for key in ("restitution", "normal_dashpot")])],
        "coarse_shaking": [(large(SHAKES, contact__unit_unit__normal_stiffness="1 MPa/m",
                                contact__unit_unit__shear_stiffness="1 MPa/m"), [{"solver.step_fraction": 0.1}])],
        "odd_record": [(packaged("block-shaken"), [{"ground.peak": "0.3 g"}])],
        "uncaught_fall": [(large(SHAKES), [{"floor": {}, "contact.default": DRY},
                                           {"floor": {}, "contact.floor_units": DRY}])],
    }  # fmt: skip


TOLD_BY_A_CHECK = {
    "time_step": "above the proven bound",
    "locking": "lock at a Poisson ratio",
    "mesh_inertia": "too much rotational inertia",
    "tough_joint": "keeps the joint together",
    "no_dilation": "does not dilate",
    "dilation_lost": "dilate no more",
    "endless_dilation": "dilation does not end",
    "value": "heavier than any matter",
    "shaken_drive": "too hard",
    "load_left_out": "a run leaves out the load of [limit]",
    "placeholders": "placeholders",
    "rocking": "outermost contact points",
    "hinges": "one row of contact points",
    "coarse_shaking": "too fast by",
}
"""By the name of a doubt: what a check says before, and no more once the advice is followed."""
OTHERS = {
    "energy_balance": "a fault of the program",
    "force_balance": "a fault of the program",
    "interrupted": "masonry resume",
    "sudden_cracks": "masonry sensitivity",
    "damping_before_fall": "masonry sensitivity",
    "branch_balance": "a column of the results",
    "blow": "the rows of the results",
    "noisy_record": "the record itself",
}
"""Advice that changes nothing of a scene."""


def advised() -> set[str]:
    """The names of doubts that have an advice."""
    names = {one.name for one in criteria() if one.advice}
    text = {name: Path(file.__file__).read_text() for name, file in OF_BLOCKS.items()}
    without = {name for name in text if re.search(rf'Doubt\("{name}", \w+, [^"]*, sentence\)\]', text[name])}
    return names | (text.keys() - without)


def test_all_advice_is_tried():
    assert advised() == cures().keys() | OTHERS.keys()


@pytest.mark.parametrize("name", sorted(advised() - OTHERS.keys()))
def test_what_is_advised_is_accepted_and_what_a_check_told_is_told_no_more(name):
    words = TOLD_BY_A_CHECK.get(name, "")
    for scene, each in cures()[name]:
        assert any(words in line for line in laboratory.check(scene)["warnings"]) or not words
        for cure in each:
            after = laboratory.check(scene.with_(cure))["warnings"]
            assert not words or not any(words in line for line in after), cure


@pytest.mark.parametrize("scene", ["column-pushed", "wall-to-and-fro", "diagonal-compression"])
def test_a_sensitivity_of_what_cracks_suddenly_or_goes_to_and_fro_can_be_asked(scene, capsys):
    assert main(["sensitivity", scene, "--list"]) == 0 and capsys.readouterr().out


def test_what_turned_too_far_is_sent_where_it_may():
    falls = one(DRIVE.replace("1 mm", "90 mm"), drive__steps=20000)
    words = 'solver.rotation_limit=0.04. What falls needs displacements = "large"'
    with pytest.raises(Stopped, match=words):
        laboratory.run(falls)
    for cure in ({"solver.rotation_limit": 0.04}, LARGE):
        laboratory.check(falls.with_(cure))


def test_a_bad_advice_would_be_seen():
    with pytest.raises(SceneError):
        laboratory.check(one(DRIVE, STRONG).with_({"contact.unit_unit.crushing": "cap"}))
