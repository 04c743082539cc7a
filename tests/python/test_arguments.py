"""What is wrong with an argument is said in one SceneError, as on the command line; a scene stays as it is."""

import copy
import os
import pickle
import re

import numpy as np
import pytest

import masonry
from masonry.errors import SceneError
from masonry.scene import to_toml

NO_PATHS = [None, 5, b"couplet", [], {}, True]


def refused(call, *told):
    with pytest.raises(SceneError) as caught:
        call()
    assert all(word in str(caught.value) for word in told) and "\n" not in str(caught.value)


@pytest.mark.parametrize("scene", NO_PATHS)
@pytest.mark.parametrize(
    "call", [masonry.load, masonry.run, masonry.check, masonry.limit, masonry.sensitivity, masonry.converge]
)
def test_what_is_no_scene_is_refused_by_all(call, scene):
    refused(lambda: call(scene), "is no scene", "name of a packaged one")


@pytest.mark.parametrize("folder", [path for path in NO_PATHS if path != []])
def test_what_is_no_folder_of_results_is_refused(folder):
    refused(lambda: masonry.load_result(folder), "folder = ")


@pytest.mark.parametrize("keys", [None, 5, [5], {5: 1}, [("law", "linear")], b"law=linear"])
def test_keys_that_are_no_texts_are_refused(keys):
    refused(lambda: masonry.load("couplet", keys), "dotted keys")
    if keys is not None:
        refused(lambda: masonry.load("couplet").with_(keys))


@pytest.mark.parametrize("threads", [None, "2", 0, -1, 1.5, True, 10_000, [1], np.nan])
def test_a_number_of_threads_is_one_that_the_command_line_takes(threads):
    refused(lambda: masonry.run("couplet", threads=threads), "threads = ", "from 1 to ")


@pytest.mark.parametrize("progress", ["yes", 1, 0, [print]])
def test_progress_is_a_function_or_a_wish(progress):
    refused(lambda: masonry.run("couplet", progress=progress), "progress = ", "a function")


@pytest.mark.parametrize(
    "words",
    [
        *({"at": value} for value in (None, "0.1", np.nan, np.inf, 1e300, [0.1], True)),
        *({"crushing": value} for value in ("5", "5 m", -1, 0, [5e6], np.nan, np.inf, 1e16, True)),
        *({"sides": value} for value in (None, "8", 2, -3, 8.0, 1e9, True)),
        *({"points": value} for value in (None, 5, "corner", [])),
        *({key: value} for key in ("dilation", "strength", "safety") for value in (None, "no", 0, 1)),
    ],
    ids=str,
)
def test_a_limit_analysis_says_which_of_its_words_is_wrong(words):
    refused(lambda: masonry.limit("arch-tilted", **words), next(iter(words)) if "sides" not in words else "sides")


def test_numbers_of_numpy_are_numbers():
    factor = masonry.limit("arch-tilted").factor
    assert masonry.limit("arch-tilted", at=np.float64(0.0), sides=np.int64(0), dilation=np.bool_(True)).factor == factor


@pytest.mark.parametrize(
    "words", [{"only": 5}, {"only": [5]}, {"only": None}, {"workers": "2"}, {"workers": -1}, {"out": 5}, {"quick": 1}]
)
def test_a_sensitivity_says_which_of_its_words_is_wrong(words):
    refused(lambda: masonry.sensitivity("couplet", **words), f"{next(iter(words))} = ")


@pytest.mark.parametrize("words", [{"of": 5}, {"cost": "2"}, {"cost": 0.5}, {"workers": -1}, {"out": 5}, {"tell": 1}])
def test_a_convergence_says_which_of_its_words_is_wrong(words):
    refused(lambda: masonry.converge("couplet", **words), f"{next(iter(words))} = ")


def test_kinds_of_variants_may_stand_in_one_text_as_on_the_command_line():
    refused(lambda: masonry.sensitivity("couplet", only="pace,cars"), "only=cars: no such kind")


CHANGES = {
    "a key": lambda scene: setattr(scene, "law", "linear"),
    "a key of a table": lambda scene: setattr(scene.contact["unit_unit"], "cohesion", 1.0),
    "a key of the drive": lambda scene: setattr(scene.drive, "steps", 5),
    "a new key": lambda scene: setattr(scene, "remark", "x"),
    "a key that goes": lambda scene: delattr(scene, "law"),
    "a table": lambda scene: scene.contact.update(unit_unit=None),
    "a table by name": lambda scene: scene.material.__setitem__("units", None),
    "a table that goes": lambda scene: scene.material.pop("units"),
    "an assumption": lambda scene: scene.assumptions.setdefault("law", "x"),
    "kinematics": lambda scene: scene.kinematics.__setitem__("default", "affine"),
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_scene_cannot_be_changed_by_assignment_and_says_what_to_do_instead(change):
    scene = masonry.load("couplet")
    before = to_toml(scene)
    refused(lambda: CHANGES[change](scene), "cannot be changed", "scene.with_(")
    assert to_toml(scene) == before


def test_a_scene_is_copied_kept_and_sent_to_other_processes_as_ever():
    scene = masonry.load("couplet", {"kinematics": "affine"})
    for other in (copy.deepcopy(scene), copy.copy(scene), pickle.loads(pickle.dumps(scene)), scene.model_copy()):
        assert to_toml(other) == to_toml(scene) and other == scene
        refused(lambda other=other: other.contact.clear(), "cannot be changed")


def test_a_path_may_be_any_path(tmp_path):
    (tmp_path / "scene.toml").write_text('base = "couplet"\n')

    class Place(os.PathLike):
        def __fspath__(self):
            return str(tmp_path / "scene.toml")

    assert masonry.load(Place()).law == masonry.load("couplet").law


def test_numbers_and_truth_values_of_numpy_are_plain_ones():
    tied = masonry.load("wall-tied", {"bar.0.compression": np.bool_(True), "bar.0.repeat": np.int64(2)})
    assert tied.bar[0].compression is True and tied.bar[0].repeat == 2
    assert masonry.load({"base": "couplet", "solver": {"damping": np.float64(0.5)}}).solver.damping == 0.5


def test_a_folder_of_a_limit_analysis_is_called_so(tmp_path):
    (tmp_path / "limit.json").write_text("{}")
    refused(lambda: masonry.load_result(tmp_path), "holds a limit analysis", "no run")
    refused(lambda: masonry.report(tmp_path, tmp_path / "page.html"), "holds a limit analysis")


def test_a_sensitivity_of_axles_that_no_run_bears_is_refused_before_it_runs(tmp_path):
    refused(lambda: masonry.sensitivity("bridge-single-span", tmp_path / "out"), "limit.accuracy: missing")
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: masonry.limit("arch-tilted", crushing="5 MPa", sides=12), "crushing= needs cones"),
        (lambda: masonry.limit("arch-tilted", at=1.5), "at= is the load factor of safety=True; add safety=True"),
        (lambda: masonry.limit("arch-tilted", dilation=False, sides=12), "dilation=False needs cones; leave out"),
    ],
)
def test_errors_name_arguments_and_not_options_of_a_command(call, words):
    with pytest.raises(masonry.SceneError, match=re.escape(words)) as raised:
        call()
    assert "--" not in str(raised.value)


def test_answers_are_tables_in_a_notebook(tmp_path):
    arch, modes = masonry.limit("arch-tilted"), masonry.modes("arch", 2)
    assert f"{arch.factor:.6g}" in arch._repr_html_() and f"{modes.frequencies[1]:.6g} Hz" in modes._repr_html_()
    arch.plot(tmp_path / "thrust.svg")
    arch.picture(tmp_path / "mechanism.svg", view="iso")
    modes.picture(tmp_path / "modes.svg")
    assert all(path.stat().st_size > 1000 for path in tmp_path.iterdir()) and len(list(tmp_path.iterdir())) == 3
