"""The example that the type checker reads also runs, and the package says that it has types."""

from importlib.resources import files

import pytest

from tests.python.typed_use import use


def test_the_typed_example_runs(tmp_path):
    assert use(tmp_path) == pytest.approx(1.375e6, rel=1e-3)
    assert (tmp_path / "curve.png").is_file()


@pytest.mark.parametrize("package", ["masonry", "geometry"])
def test_type_checkers_are_told_that_there_are_types(package):
    assert (files(package) / "py.typed").is_file()
