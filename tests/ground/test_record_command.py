"""`masonry record`: a record of the ground as CSV, which a scene reads again, and its picture."""

import numpy as np
import pytest

from masonry.cli.main import main
from masonry.ground.records.reading import read_record
from masonry.scene.tables.dynamics.made_record import MadeGround

KEYS = ["spectrum=clough-penzien", "peak=0.3 g", "duration=5 s", "shortest=0.1 s", "seed=4"]


def test_the_file_holds_the_record_of_the_scene_and_the_picture_is_beside_it(tmp_path, capsys):
    path = tmp_path / "mine.csv"
    assert main(["record", str(path), *KEYS, "--components", "2", "--plot"]) == 0
    assert (tmp_path / "mine.png").read_bytes()[:4] == b"\x89PNG"
    file = read_record(path)
    made = MadeGround.model_validate(dict(key.split("=") for key in KEYS[:-1]) | {"seed": 4})
    for word in ("first", "second"):
        record = made.record(word)
        assert np.array_equal(file.time(None), record.time)
        assert file.samples(word, "acceleration", None) == pytest.approx(record.acceleration, abs=1e-12)
    assert "peaks 0.3 g" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["a.csv", "spectrum=clough-penzien"], "ground.made.duration: missing"),
        (["a.csv", *KEYS, "pea=1"], "ground.made.pea: unknown key; did you mean 'peak'"),
        (["a.txt", *KEYS], "the record is a .csv file"),
        (["a.csv", "0.3"], "write KEY=VALUE"),
        (["a.csv", *KEYS, "--components", "4"], "1, 2 or 3"),
        (["a.csv", *KEYS, "--plot", "a.jpg"], "a picture is a .png, .pdf or .svg file"),
    ],
)
def test_wrong_words_are_one_message_and_nothing_is_written(tmp_path, monkeypatch, capsys, words, says):
    monkeypatch.chdir(tmp_path)
    assert main(["record", *words]) == 2
    assert says in capsys.readouterr().err
    assert not list(tmp_path.iterdir())
