"""A checkpoint that is torn, or of something else, is never gone on from: the one before it is, or one message says."""

from random import Random

import numpy as np
import pytest

from masonry.runtime.state_file import Damaged, read, write
from tests.faults.compare import differences
from tests.faults.samples import half_done, resume


def tear(path) -> None:
    """What a disk may leave of a file when the power fails."""
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def test_a_torn_checkpoint_gives_way_to_the_one_before_it(alone, tmp_path, monkeypatch, capsys):
    kept = half_done(tmp_path / "out", monkeypatch)
    tear(kept.states()[0][1])
    assert resume(tmp_path / "out") == 0
    said = capsys.readouterr().err
    assert "is damaged" in said and "the one before it is used" in said and said.count("\n") == 1
    assert differences(alone, tmp_path / "out") == []


def test_two_torn_checkpoints_are_left_as_they_are_and_say_how_to_begin_anew(tmp_path, monkeypatch, capsys):
    kept = half_done(tmp_path / "out", monkeypatch)
    for _, path in kept.states():
        tear(path)
    assert resume(tmp_path / "out") == 2
    assert f"masonry run {kept.scene}" in capsys.readouterr().err
    assert len(kept.states()) == 2 and kept.scene.is_file()


@pytest.mark.parametrize(
    ("what", "change"),
    [
        ("its scene", lambda kept: kept.scene.write_text(kept.scene.read_text().replace("2000", "2001"))),
        ("the program", lambda kept: other_origin(kept, "the program", "masonry 0.0.9, sources 12")),
        ("the packages", lambda kept: other_origin(kept, "the packages", "numpy 1.0")),
    ],
)
def test_a_checkpoint_of_something_else_is_refused_and_kept(what, change, tmp_path, monkeypatch, capsys):
    kept = half_done(tmp_path / "out", monkeypatch)
    change(kept)
    assert resume(tmp_path / "out") == 2
    said = capsys.readouterr().err
    assert f"started with another state of {what} (" in said and said.count("\n") == 1
    assert len(kept.states()) == 2


def other_origin(kept, what: str, value: str) -> None:
    for _, path in kept.states():
        state = read(path)
        state["origin"][what] = value
        write(path, state)


@pytest.mark.parametrize("key", ["origin", "model", "arrays", "run"])
def test_a_checkpoint_that_lacks_something_counts_as_damaged(key, alone, tmp_path, monkeypatch, capsys):
    kept = half_done(tmp_path / "out", monkeypatch)
    newest = kept.states()[0][1]
    state = read(newest)
    write(newest, {**state, key: None})
    assert resume(tmp_path / "out") == 0
    assert f"is damaged (it has no '{key}'); the one before it is used" in capsys.readouterr().err
    assert differences(alone, tmp_path / "out") == []


def test_a_checkpoint_of_another_processor_is_gone_on_from_and_the_log_says_so(alone, tmp_path, monkeypatch, capsys):
    other_origin(half_done(tmp_path / "out", monkeypatch), "the processor", "another one")
    assert resume(tmp_path / "out") == 0
    assert "another processor" in capsys.readouterr().err
    assert "another processor" in (tmp_path / "out" / "run.log").read_text()
    assert differences(alone, tmp_path / "out") == []


@pytest.mark.parametrize("content", ["{", "[]", '{"threads": "many", "checkpoint_every": -1}', '{"threads": 100000}'])
def test_what_run_json_says_wrongly_does_no_harm(content, alone, tmp_path, monkeypatch):
    kept = half_done(tmp_path / "out", monkeypatch)
    (kept.folder / "run.json").write_text(content)
    assert resume(tmp_path / "out") == 0
    assert differences(alone, tmp_path / "out") == []


STATE = {
    "number": 7,
    "infinite": float("-inf"),
    "of numpy": np.float64(0.1),
    "words": ["a", None, True],
    "arrays": {"rows": np.arange(600.0).reshape(3, 200), "none": np.zeros((0, 3)), "codes": np.arange(5, dtype="u4")},
}


def test_a_tree_comes_back_as_it_was_types_and_bits(tmp_path):
    write(tmp_path / "x.npz", STATE)
    back = read(tmp_path / "x.npz")
    assert repr(back) == repr(STATE) and type(back["of numpy"]) is np.float64
    for name, array in STATE["arrays"].items():
        assert back["arrays"][name].tobytes() == array.tobytes() and back["arrays"][name].dtype == array.dtype


def test_a_wrong_byte_anywhere_is_found_or_changes_nothing(tmp_path):
    write(tmp_path / "x.npz", STATE)
    good, draw, refusals = (tmp_path / "x.npz").read_bytes(), Random(1), 0
    for _ in range(400):
        bad = bytearray(good)
        bad[draw.randrange(len(bad))] ^= 1 << draw.randrange(8)
        (tmp_path / "y.npz").write_bytes(bad)
        try:
            assert repr(read(tmp_path / "y.npz")) == repr(STATE)
        except Damaged:
            refusals += 1
    assert refusals > 200


def test_a_pickle_is_never_loaded(tmp_path):
    np.savez(tmp_path / "x.npz", tree=np.array([print], dtype=object), sum=np.zeros(1))
    with pytest.raises(Damaged, match="allow_pickle=False"):
        read(tmp_path / "x.npz")
    with pytest.raises(TypeError):
        write(tmp_path / "y.npz", {"a": np.array([print], dtype=object)})
