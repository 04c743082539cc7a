"""The doctor says what is there and what is missing, and how to get it."""

import importlib

from masonry import doctor
from masonry.cli import main


def test_a_machine_that_has_everything_is_fine(capsys):
    assert main(["doctor"]) == 0
    said = capsys.readouterr().out
    for word in ("python", "masonry", "numba", "numpy", "gmsh", "h5py", "processors", "threading layer", "disk"):
        assert word in said
    assert said.endswith("all fine\n")


def test_a_missing_library_is_named_with_the_packages_that_bring_it(monkeypatch, capsys):
    load = importlib.import_module

    def without_glu(name):
        if name == "gmsh":
            raise OSError("libGLU.so.1: cannot open shared object file: No such file or directory")
        return load(name)

    monkeypatch.setattr(doctor.importlib, "import_module", without_glu)
    assert main(["doctor"]) == 1
    said = capsys.readouterr().out
    assert "libGLU.so.1" in said and "libglu1-mesa" in said


def test_a_cache_that_cannot_be_written_to_is_a_problem(monkeypatch, tmp_path):
    monkeypatch.setenv("MASONRY_CACHE", str(tmp_path / "a" / "b"))
    monkeypatch.setattr(doctor.os, "access", lambda path, mode: False)
    good, words = doctor._cache()
    assert not good and "MASONRY_CACHE" in words
