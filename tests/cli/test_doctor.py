"""The doctor says what is there and what is missing, how to get it, and whether this machine computes right."""

import importlib
import re
from importlib import metadata

import pytest

from masonry.cli import doctor, installed
from masonry.cli.doctor import diagnose
from masonry.cli.main import main
from masonry.runtime.processors import Seconds
from verification import self_test
from verification.case import Case, Check, Findings, Tolerance


def test_a_machine_that_has_everything_is_fine(capsys):
    assert main(["doctor", "--quick"]) == 0
    said = capsys.readouterr().out
    for word in ("python", "masonry", "numba", "numpy", "gmsh", "h5py", "processors", "threading layer", "disk"):
        assert word in said
    assert f"pydantic {metadata.version('pydantic')}" in " ".join(said.split())
    assert said.endswith("all fine\n") and "self-test" not in said


def test_a_system_on_which_it_was_never_tried_is_told_and_is_no_problem(monkeypatch):
    assert installed.system()[1].startswith("Linux ") and "tried" not in installed.system()[1]
    monkeypatch.setattr(installed.platform, "system", lambda: "Windows")
    good, words = installed.system()
    assert good and words.startswith("Windows ") and words.endswith("; this program was tried on Linux only")


def test_a_missing_library_is_named_with_the_packages_that_bring_it(monkeypatch, capsys):
    load = importlib.import_module

    def without_glu(name):
        if name == "gmsh":
            raise OSError("libGLU.so.1: cannot open shared object file: No such file or directory")
        return load(name)

    monkeypatch.setattr(installed.importlib, "import_module", without_glu)
    assert main(["doctor"]) == 1
    said = capsys.readouterr().out
    assert "libGLU.so.1" in said and "libglu1-mesa" in said
    assert "not run until the problems above are solved" in said and "OK" not in said


def test_a_missing_package_is_a_problem_and_a_missing_optional_one_is_not(monkeypatch):
    version = metadata.version

    def without(*missing):
        def known(name):
            if name in missing:
                raise metadata.PackageNotFoundError(name)
            return version(name)

        return known

    monkeypatch.setattr(installed.metadata, "version", without("meshio"))
    good, words = installed.others(optional=False)
    assert not good and words.startswith("meshio not installed") and "pip install" in words
    monkeypatch.setattr(installed.metadata, "version", without("pandas"))
    assert installed.others(optional=False)[0]
    good, words = installed.others(optional=True)
    assert good and "not installed: pandas (in the clone of masonry-dem: pip install '.[notebook]')" in words


def test_a_cache_that_cannot_be_written_to_is_a_problem(monkeypatch, tmp_path):
    (tmp_path / "a").touch()
    monkeypatch.setenv("MASONRY_CACHE", str(tmp_path / "a" / "b"))
    good, words = installed.cached_code()
    assert not good and "MASONRY_CACHE" in words


def test_the_self_test_holds_its_numbers_against_closed_forms_and_times_a_step(monkeypatch):
    monkeypatch.setattr(self_test, "CASES", self_test.CASES[:1])
    said: list[str] = []
    assert doctor.self_tested(said.append)
    assert said[1].startswith("tension-exponential") and "numbers against closed forms" in said[1]
    match = re.search(r"takes ([\d.]+) ns .* by hand ([\d.]+) ns: ([\d.]+) of it", " ".join(" ".join(said).split()))
    assert match, said
    assert "`masonry check` foretells times" in " ".join(said[-1].split())
    ours, by_hand, ratio = map(float, match.groups())
    assert ratio == pytest.approx(ours / by_hand, abs=0.03)


def test_a_self_test_that_finds_a_wrong_number_fails_and_says_which(monkeypatch, capsys):
    wrong = Check("peak", "Pa", 1.01, 1.0, Tolerance(1e-3, 1e-4, "the step that misses the peak"))
    case = Case("couplet", "A8", "Couplet", area="Contact laws", run=lambda: Findings([wrong]))
    monkeypatch.setattr(self_test, "CASES", (case,))
    assert not diagnose(say=print)
    said = capsys.readouterr().out
    assert "FAILED: couplet: peak is 1.01 Pa, but the closed form gives 1 Pa" in " ".join(said.split())
    assert said.endswith("some things are missing or wrong, see above\n")
    assert main(["doctor"]) == 1


def test_the_steps_of_usual_scenes_are_made_beforehand(monkeypatch, capsys):
    models = []
    monkeypatch.setattr("masonry.timeloop.compiling.prepare", lambda model, *words: models.append(model) or Seconds())
    assert main(["doctor", "--warm"]) == 0
    said = capsys.readouterr().out.splitlines()
    assert len(models) == len(said) == len(doctor.USUAL) and "couplet of tets" in said[-1]
    kinds = {kind for model in models for kind, members in model.layout.members.items() if len(members)}
    assert kinds == {"rigid", "affine", "tets"}
