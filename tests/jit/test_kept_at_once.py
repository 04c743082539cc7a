"""Processes that keep what they compiled of one function at the same moment."""

import pytest

from geometry.jit_cache import CheckedFiles


@pytest.mark.parametrize("late", ["index", "data"])
def test_none_is_served_the_code_of_another_one_that_was_kept_at_once(late, tmp_path, monkeypatch):
    """Both see an empty index, and one writes its index or its data once the other has written both."""
    one, other = (CheckedFiles(str(tmp_path), "function", "stamp") for _ in range(2))
    for cache in (one, other):
        monkeypatch.setattr(cache, "_load_index", dict)
    write = getattr(one, f"_save_{late}")
    monkeypatch.setattr(one, f"_save_{late}", lambda *what: (other.save("b", "code of b"), write(*what)))
    one.save("a", "code of a")
    served = {key: CheckedFiles(str(tmp_path), "function", "stamp").load(key) for key in "ab"}
    assert all(code in (None, f"code of {key}") for key, code in served.items())
    assert any(served.values())
