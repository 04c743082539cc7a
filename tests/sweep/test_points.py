"""The points of a sweep: every combination of a grid, the rows of a list, each stratum of a Latin hypercube once."""

import numpy as np
import pytest

from masonry.errors import SceneError
from masonry.scene import load, to_toml
from masonry.sweeps.planned_runs import plan
from masonry.sweeps.points import points
from masonry.sweeps.read import read
from tests.sweep.samples import text

STRENGTH, COHESION = "contact.unit_unit.tensile_strength", "contact.unit_unit.cohesion"
ENERGY, FRICTION = "contact.unit_unit.fracture_energy_mode_1", "contact.unit_unit.tan_friction_angle"

WAVE = "waves.toml"
WAVE_SCENE = """
base = "couplet"
confinement = "0 MPa"
kinematics = "affine"
drive.steps = 100
solver.masses = "real"
[[quiet]]
on = "top plate.z+"
[quiet.wave]
record = "pushed.csv"
unit = "mm/s"
quantity = "velocity"
x = "2"
"""


@pytest.fixture
def sweep(tmp_path):
    def write(body, **more):
        path = tmp_path / "sweep.toml"
        path.write_text(text(body, **more), encoding="utf-8")
        return read(path)

    return write


def values(planned, *keys):
    return [tuple(run.values[key] for key in keys) for run in planned]


def test_a_grid_has_every_combination_and_the_last_axis_varies_first(sweep):
    runs = plan(sweep('[grid]\nlaw = ["linear", "brittle"]\nconfinement = ["0.1 MPa", "0.2 MPa"]'))
    expected = [(law, p) for law in ("linear", "brittle") for p in ("0.1 MPa", "0.2 MPa")]
    assert values(runs, "law", "confinement") == expected
    assert len({run.job.key() for run in runs}) == 4


def test_rows_of_a_list_set_keys_together_and_are_crossed_with_the_grid(sweep):
    rows = "".join(f'[[list]]\n"{STRENGTH}" = "{f} MPa"\n"{COHESION}" = "{2 * f} MPa"\n' for f in (0.2, 0.3))
    runs = plan(sweep(f'{rows}[grid]\nconfinement = ["0.1 MPa", "0.2 MPa", "0.3 MPa"]'))
    assert len(runs) == 6
    assert {v for v in values(runs, STRENGTH, COHESION)} == {("0.2 MPa", "0.4 MPa"), ("0.3 MPa", "0.6 MPa")}


def test_a_factor_multiplies_the_value_of_the_scene_and_keeps_its_unit(sweep):
    runs = plan(sweep(f'[grid]\n"{ENERGY}" = {{times = [0.5, 1, 2]}}\n"{FRICTION}" = [{{times = 2}}]'))
    assert [float(v.removesuffix(" N/m")) for (v,) in values(runs, ENERGY)] == pytest.approx([2.9, 5.8, 11.6])
    assert values(runs, FRICTION) == [(2.02,)] * 3
    assert [run.times for run in runs] == [{ENERGY: f, FRICTION: 2.0} for f in (0.5, 1.0, 2.0)]


def test_stiffnesses_and_unit_weights_have_one_unit_and_both_can_vary(sweep):
    stiffness, density = "contact.unit_unit.normal_stiffness", "material.units.density"
    spans = f'"{stiffness}" = {{from = "100 GPa/m", to = "200 GPa/m"}}\n'
    spans += f'"{density}" = {{from = "17 kN/m^3", to = "19 kN/m^3"}}\n'
    runs = plan(sweep(f"[latin_hypercube]\nsamples = 3\nseed = 1\n{spans}"))
    assert all(text.endswith(" Pa/m") for text, _ in values(runs, stiffness, density))
    runs = plan(sweep(f'[grid]\n"{stiffness}" = {{times = [0.5, 2]}}'))
    assert len(runs) == 2


def test_a_key_can_follow_another_key_of_the_same_run(sweep):
    runs = plan(sweep(f'"{COHESION}" = {{times = 1.5, of = "{STRENGTH}"}}\n[grid]\n"{STRENGTH}" = {{times = [1, 2]}}'))
    assert [float(v.removesuffix(" Pa")) for (v,) in values(runs, COHESION)] == pytest.approx([0.87e6, 1.74e6])


HYPERCUBE = f"""[latin_hypercube]
samples = 20
seed = 5
"{STRENGTH}" = {{from = "0.2 MPa", to = "400 kPa"}}
"{ENERGY}" = {{from = "1 N/m", to = "100 N/m", scale = "log"}}
"{FRICTION}" = {{times = {{from = 0.5, to = 1.5}}}}
"solver.damping" = {{values = [0.1, 0.2]}}
"""


def test_each_stratum_of_each_axis_of_a_latin_hypercube_is_met_once(sweep):
    sample = points(sweep(HYPERCUBE))
    strength = [float(row[STRENGTH].removesuffix(" Pa")) for row in sample]
    energy = [float(row[ENERGY].removesuffix(" N/m")) for row in sample]
    friction = [row[FRICTION].factor for row in sample]
    for place in ((np.array(strength) - 2e5) / 2e5, np.log10(energy) / 2.0, np.array(friction) - 0.5):
        assert sorted(np.floor(20 * place).astype(int)) == list(range(20))
    assert sorted(row["solver.damping"] for row in sample) == [0.1] * 10 + [0.2] * 10
    assert abs(np.corrcoef(strength, energy)[0, 1]) < 0.9


def test_the_same_seed_gives_the_same_samples_and_another_one_others(sweep):
    once, again = points(sweep(HYPERCUBE)), points(sweep(HYPERCUBE))
    assert once == again
    assert once != points(sweep(HYPERCUBE.replace("seed = 5", "seed = 6")))


def test_whole_numbers_stay_whole_and_both_ends_are_met(sweep):
    sample = points(sweep('[latin_hypercube]\nsamples = 40\n"specimen.cells.total" = {from = 3, to = 6}'))
    counts = [sum(row["specimen.cells.total"] == n for row in sample) for n in (3, 4, 5, 6)]
    assert counts == [10, 10, 10, 10]


BAD = {
    '[grid]\n"contact.unit_unit.cohesoin" = ["1 MPa"]': "cohesoin: unknown key; did you mean 'cohesion'",
    '[grid]\n"contact.unit_unti.cohesion" = ["1 MPa"]': "no group 'unit_unti' in this scene.*did you mean 'unit_unit'",
    '[grid]\n"kinematics.unit" = ["affine"]': "no group 'unit' in this scene; .*did you mean 'units'",
    '[grid]\nconfinement = ["0.1 MPa", "0.1 m"]': "run 2 of 2: confinement: m is a length",
    "[grid]\nconfinement = '1 MPa'": "grid: confinement: must be a list of values",
    "[grid]": "nothing to vary",
    "": "nothing to vary",
    "[grip]\nlaw = ['linear']": "grip: unknown key; known here: .*did you mean 'grid'",
    '[grid]\n"drive.steps" = [1, 2]': "drive.steps is given in .settings. and in .grid.; once is enough",
    "[grid.contact.unit_unit]\ncohesion = ['1 MPa']": "dotted keys stand in quotes",
    '[[list]]\nlaw = {times = 2}\n': "law: times 2: law: 'exponential' is no number",
    '[[list]]\nconfinement = {times = 2, off = 3}\n': "write {times = 2}",
    '[[list]]\n"drive.rate" = {times = 2}\n': "drive.rate is not in the scene, nothing to multiply",
    '[latin_hypercube]\nconfinement = {from = "1 MPa", to = "2 MPa"}': "samples: must be a whole number from 1",
    '[latin_hypercube]\nsamples = 2\nconfinement = {from = "1 MPa", to = "2 m"}': "not of one kind",
    '[latin_hypercube]\nsamples = 2\nconfinement = {from = "2 MPa", to = "1 MPa"}': "from must be less than to",
    '[latin_hypercube]\nsamples = 2\nconfinement = {from = "0 MPa", to = "1 MPa", scale = "log"}': "and more than 0",
    '[latin_hypercube]\nsamples = 2\nconfinement = {from = "0 MPa", too = "1 MPa"}': "too: unknown key.*mean 'to'",
    '[latin_hypercube]\nsamples = 2\nconfinement = ["1 MPa"]': "confinement: write {from = ",
    "[latin_hypercube]\nsamples = 2": "no dotted key|nothing to vary",
}  # fmt: skip


@pytest.mark.parametrize("body", BAD)
def test_a_mistake_is_one_message_with_the_key_and_what_is_allowed(sweep, body):
    with pytest.raises(SceneError, match=BAD[body]) as error:
        plan(sweep(body))
    assert "\n" not in str(error.value) and "sweep.toml" in str(error.value)


def test_a_key_cannot_follow_one_that_follows_another_itself(sweep):
    chain = f'"{COHESION}" = {{times = 1.5, of = "{STRENGTH}"}}\n"{STRENGTH}" = {{times = 2, of = "{COHESION}"}}\n'
    with pytest.raises(SceneError, match="itself follows another key"):
        plan(sweep(f'{chain}[grid]\nconfinement = ["0.1 MPa"]'))


RANGES = [
    '{from = "1 MPa", to = "2 MPa"}',
    '{from = "1 MPa", to = "2 MPa", scale = "log"}',
    '{values = ["1 MPa", "2 MPa"]}',
    "{times = {from = 0.5, to = 2}}",
    "{times = {values = [0.5, 2]}}",
]
"""What the message about a range names."""


@pytest.mark.parametrize(
    "wrong", ["{times = 2}", "{times = [1, 2]}", "{values = []}", '{values = ["1 MPa"], scale = "log"}']
)
def test_words_of_a_range_that_are_used_wrong_are_told_with_all_ranges_there_are(sweep, wrong):
    """And not as unknown keys, with themselves for the nearest."""
    begin = f'[latin_hypercube]\nsamples = 2\n"{COHESION}" = '
    with pytest.raises(SceneError, match="cohesion: write {from = .*scale = 'log'.*{values = .*{times = ") as error:
        plan(sweep(begin + wrong))
    assert "unknown" not in str(error.value)
    for one in RANGES:
        assert len(plan(sweep(begin + one))) == 2


def test_what_may_be_multiplied_in_place_of_a_key_that_is_not_there_are_numbers(sweep):
    """How a joint unloads is no number, nor is an exponent by confinement."""
    body = '[grid]\n"{}" = {{times = [0.5, 2]}}\n'
    with pytest.raises(SceneError, match="nothing to multiply; known here: [a-z_0-9, ]*stiffness") as error:
        plan(sweep(body.format("contact.unit_unit.friction")))
    words = str(error.value).partition("known here: ")[2].partition(";")[0].split(", ")
    assert len(words) > 9 and not {"unloading", "coupling", "exponent_shear"} & set(words)
    for word in words:
        assert len(plan(sweep(body.format(f"contact.unit_unit.{word}")))) == 2


def test_a_scene_in_place_of_a_sweep_is_told_and_the_sweep_that_names_it_is_taken(tmp_path):
    (tmp_path / "own.toml").write_text(to_toml(load("couplet")))
    with pytest.raises(SceneError, match="this is a scene, and no sweep; .* names it, scene = 'own.toml'"):
        read(tmp_path / "own.toml")
    (tmp_path / "sweep.toml").write_text('scene = "own.toml"\n[grid]\nlaw = ["linear", "brittle"]\n')
    assert len(plan(read(tmp_path / "sweep.toml"))) == 2


def test_a_key_that_follows_itself_is_a_multiple_of_its_own(sweep):
    """As a message about a misspelt `of` may lead to."""
    body = '[grid]\n"{0}" = {{times = [0.5, 2], of = "{1}"}}\n'
    with pytest.raises(SceneError, match="did you mean 'tan_friction_angle'"):
        plan(sweep(body.format(FRICTION, FRICTION.replace("friction", "frction"))))
    runs = plan(sweep(body.format(FRICTION, FRICTION)))
    assert values(runs, FRICTION) == [(0.505,), (2.02,)]


def test_a_key_can_follow_one_that_only_the_scene_gives(sweep):
    friction = "contact.unit_unit.tan_residual_friction_angle"
    (run,) = plan(sweep(f'[[list]]\n"{friction}" = {{times = 0.5, of = "{FRICTION}"}}'))
    assert run.values[friction] == pytest.approx(0.505)


@pytest.mark.parametrize("content", ["scene = couplet", "scene = 3", "", 'scene = "couplet"\n[list]\nlaw = "linear"'])
def test_a_file_that_is_no_sweep_is_refused_in_words(tmp_path, content):
    path = tmp_path / "sweep.toml"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(SceneError, match="sweep.toml"):
        read(path)


def test_a_scene_beside_the_sweep_file_is_found_from_anywhere(tmp_path, monkeypatch):
    (tmp_path / "mine.toml").write_text('base = "couplet"\nlaw = "brittle"', encoding="utf-8")
    path = tmp_path / "sweep.toml"
    path.write_text('scene = "mine.toml"\n[grid]\nconfinement = ["0.1 MPa"]', encoding="utf-8")
    monkeypatch.chdir("/")
    (run,) = plan(read(path))
    assert 'law = "brittle"' in run.job.resolved


def test_every_file_that_a_sweep_sets_is_looked_for_beside_its_file_from_anywhere(tmp_path, monkeypatch):
    (tmp_path / "pushed.csv").write_text("0,1\n1,2\n2,4\n", encoding="utf-8")
    (tmp_path / "wave.csv").write_text("0,0\n1,2\n2,0\n", encoding="utf-8")
    units = '"curve.measured_units" = ["mm", "kN"]\n'
    files = {"curve.measured": ("couplet", "pushed.csv", units), "quiet.0.wave.record": (WAVE, "wave.csv", "")}
    (tmp_path / "waves.toml").write_text(WAVE_SCENE, encoding="utf-8")
    monkeypatch.chdir("/")
    for key, (scene, file, settings) in files.items():
        path = tmp_path / "sweep.toml"
        path.write_text(f'scene = "{scene}"\n[settings]\n"law" = "elastic"\n{settings}[grid]\n"{key}" = ["{file}"]')
        (run,) = plan(read(path))
        assert f'"{tmp_path / file}"' in run.job.resolved and run.values[key] == file
