"""The examples in the docstrings of what `masonry` offers run, and print what they say."""

import doctest
import inspect

import pytest

import masonry

FUNCTIONS = sorted(name for name, _ in inspect.getmembers(masonry, inspect.isfunction) if not name.startswith("_"))


def test_these_are_the_functions_that_a_user_has():
    assert FUNCTIONS == [
        "check",
        "contact",
        "converge",
        "export",
        "import_blocks",
        "law",
        "limit",
        "load",
        "load_result",
        "modes",
        "new",
        "record",
        "report",
        "resume",
        "run",
        "scenes",
        "sensitivity",
        "sweep",
        "verify",
        "view",
        "write_blocks",
    ]


def test_classes_that_a_user_meets_are_there_and_nothing_else_is_listed():
    listed = dir(masonry)
    assert set(listed) == {*FUNCTIONS, *masonry.CLASSES, "__version__"} == {*masonry.__all__, "__version__"}
    assert all(getattr(masonry, name).__name__ == name for name in masonry.CLASSES)
    with pytest.raises(masonry.SceneError, match="no scene 'nowhere'"):
        masonry.load("nowhere")
    with pytest.raises(AttributeError, match="has no attribute 'Senec'"):
        getattr(masonry, "Senec")  # noqa: B009


@pytest.mark.parametrize("name", ["masonry", *FUNCTIONS])
def test_the_example_of_a_docstring_prints_what_it_says(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = (masonry if name == "masonry" else getattr(masonry, name)).__doc__
    example = doctest.DocTestParser().get_doctest(text, {"masonry": masonry}, name, masonry.__file__, 0)
    assert example.examples
    failures: list[str] = []
    doctest.DocTestRunner(verbose=False).run(example, out=failures.append)
    assert not failures, "".join(failures)
