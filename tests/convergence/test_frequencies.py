"""Frequencies of modes, refined: beside closed forms of stacks and beams."""

from dataclasses import replace

import numpy as np
import pytest

import masonry
from masonry.cli.main import main
from masonry.scene import changed, load
from masonry.sweeps.convergence.convergence import converge
from masonry.sweeps.convergence.refinement.analyses import BESIDE, frequency_keys, pairs_of
from masonry.sweeps.run_store import frequency_key
from verification.references.swinging_stack import STACK, Stack, keys_of
from verification.scene_runs import load as load_case

THREE = replace(STACK, count=3)
AT_EDGES = {"specimen.contact_points": "vertex", "specimen.points_per_edge": 2}
WIDTH, DEPTH, HEIGHT, MODULUS, POISSON, DENSITY = 0.3, 0.2, 1.5, 5e9, 0.2, 2000.0
PIER = {
    "name": "pier",
    "kinematics": "tets",
    "specimen": {
        "kind": "boxes",
        "section": f"{WIDTH * DEPTH!r} m^2",
        "mesh_size": "0.1 m",
        "box": [
            {"name": "foot", "origin": ["-0.1 m", "0 m", "-0.2 m"], "size": ["0.5 m", "0.2 m", "0.2 m"], "unit": 0},
            {
                "name": "pier",
                "origin": ["0 m", "0 m", "0 m"],
                "size": [f"{WIDTH} m", f"{DEPTH} m", f"{HEIGHT} m"],
                "unit": 1,
            },
        ],
    },
    "material": {"units": {"density": f"{DENSITY} kg/m^3", "young_modulus": f"{MODULUS} Pa", "poisson_ratio": POISSON}},
    "contact": {"unit_unit": {"law": "elastic", "normal_stiffness": "1000 GPa/m", "shear_stiffness": "500 GPa/m"}},
    "gravity": {"z": "-9.81 m/s^2"},
    "support": [{"on": "foot", "fix": "all"}],
}


@pytest.fixture(scope="module")
def stack(tmp_path_factory):
    scene = load_case("stack", keys_of(THREE) | AT_EDGES)
    return converge(scene, tmp_path_factory.mktemp("stack") / "out", of=frequency_keys(6), workers=0)


def test_frequencies_of_joints_that_turn_too_stiffly_converge_to_the_closed_form(stack):
    """With two points along each edge a joint turns three times as stiffly as its area does."""
    second = stack.errors[1]
    assert second.value > 1.4 * THREE.sideways(1)[0]
    assert second.limit == pytest.approx(THREE.sideways(1)[0], rel=1e-6)
    assert abs(second.limit - THREE.sideways(1)[0]) <= second.half_width + 1e-6 < 1e-3 * second.value
    assert "frequency 2 [Hz]" in repr(stack) and "too high" in repr(stack)


def test_a_mode_is_told_again_by_its_shape_where_refinement_changes_the_order(stack):
    """Up and down it is as stiff with two points as with more, and comes third with two, fifth with more."""
    third = stack.errors[2]
    assert third.value == pytest.approx(THREE.up_and_down()[0], rel=1e-6)
    assert third.limit == pytest.approx(third.value, rel=1e-6)
    assert stack.errors[3].limit < 0.9 * third.limit


def test_a_frequency_has_neither_scatter_nor_verdict_and_its_runs_stay(stack):
    assert [trial.name for trial, _ in stack.runs][:2] == ["as it is", "points along x"]
    assert all(error.scatter == 0.0 for error in stack.errors)
    for _, row in stack.runs:
        folder = stack.folder / "runs" / row["key"]
        assert {path.name for path in folder.iterdir()} == {"modes.json", "shapes.npy", "scene.toml"}
        assert len(np.load(folder / "shapes.npy")) == 6 + BESIDE
    before, lines = (stack.folder / "convergence.csv").read_bytes(), []
    scene = load_case("stack", keys_of(THREE) | AT_EDGES)
    converge(scene, stack.folder, of=frequency_keys(6), workers=0, tell=lines.append, overwrite=True)
    assert (stack.folder / "convergence.csv").read_bytes() == before
    assert not any("OK" in line for line in lines)


def test_settings_are_chosen_for_a_frequency(stack):
    scene = load_case("stack", keys_of(THREE) | AT_EDGES)
    result = converge(scene, stack.folder, of=[frequency_key(2)], to="1 %", workers=0, overwrite=True)
    assert "its run is" not in result.chosen.words and result.chosen.error <= 0.01
    finer = masonry.modes(changed(scene, result.chosen.settings), 4)
    assert np.abs(finer.frequencies / THREE.sideways(1)[0] - 1.0).min() < 0.01


def test_the_bar_holds_the_frequencies_of_a_beam_of_tets(tmp_path):
    """A cantilever of Timoshenko, in its two planes: shear coefficient of Cowper, 1966, 10 (1 + nu) / (12 + 11 nu)."""
    result = converge(load(PIER), tmp_path / "out", of=frequency_keys(2), cost=30.0, workers=0)
    shear = MODULUS / (2.0 * (1.0 + POISSON)) * 10.0 * (1.0 + POISSON) / (12.0 + 11.0 * POISSON)
    slice_height = HEIGHT / 1000
    beams = [
        Stack(1000, side, other, slice_height, DENSITY, MODULUS / slice_height, shear / slice_height).beam(1)[0]
        for side, other in ((DEPTH, WIDTH), (WIDTH, DEPTH))
    ]
    for error, exact in zip(result.errors, beams, strict=True):
        assert error.value > 1.05 * exact
        assert abs(error.limit - exact) <= error.half_width < 0.15 * exact
    assert result.errors[0].parts.keys() == {"size of tets"}


def test_alike_shapes_are_paired_all_at_once():
    """A mode that two are alike to goes to the one, and the next best is left for the other."""
    base = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    assert pairs_of(base, np.array([[0.0, 0.0, 3.0], [0.1, -2.0, 0.0], [0.9, 0.3, 0.0]])) == {0: 2, 1: 1}
    assert pairs_of(base, np.array([[0.8, 0.6, 0.0], [0.7, 0.0, 0.1]])) == {0: 1, 1: 0}


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--of", "frequency"], "'frequency' is no frequency; allowed: modes.1.frequency_hz to modes.100"),
        (["--of", "modes.0.frequency_hz"], "allowed: modes.1.frequency_hz"),
        (["--of", "modes.1.frequency_hz,peak_stress_pa"], "leave one out"),
        (["--modes", "0"], "0 modes; allowed: 1 to 100"),
        (["--modes", "2", "--of", "peak_stress_pa"], "leave one of them out"),
    ],
)
def test_what_is_no_frequency_is_refused(words, says, capsys):
    assert main(["converge", "couplet", *words]) == 2
    assert says in capsys.readouterr().err


def test_the_command_lists_the_modes_it_would_refine(capsys):
    assert main(["converge", "couplet", "--modes", "2", "--list", "--set", "specimen.contact_points=vertex"]) == 0
    said = capsys.readouterr().out
    assert "points along y" in said and "pace" not in said and "scatter" not in said
