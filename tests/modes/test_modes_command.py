"""The command `masonry modes`: what it prints, what it writes, how it ends."""

import json

import pytest

from masonry.cli.main import main


def test_the_command_prints_and_writes_modes(tmp_path, capsys):
    out = tmp_path / "here"
    assert main(["modes", "arch", "--set", "specimen.points_per_edge=2", "--modes", "3", "--out", str(out)]) == 0
    words = capsys.readouterr().out
    assert "60.847 Hz" in words and "a0 = " in words and "modes.json" in words and "mode 1 by about 66 %" in words
    content = json.loads((out / "modes.json").read_text())
    assert [mode["frequency_hz"] for mode in content["modes"]] == pytest.approx([60.847, 72.738, 145.939], rel=1e-5)
    assert len(content["modes"][0]["displacement"]) == content["blocks"] == 17
    assert content["rayleigh"]["between_modes"] == [1, 3]
    assert (out / "modes.png").read_bytes()[:4] == b"\x89PNG"
    assert main(["modes", "arch", "--out", str(out)]) == 2, "results are there already"
    assert main(["modes", "arch", "--out", str(out), "--overwrite", "--view", "front", "--pressed"]) == 0
    assert "friction holds there" in capsys.readouterr().out


def test_the_command_hands_out_json_alone(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["modes", "couplet", "--json", "--ratio", "0.02", "--between", "1", "2"]) == 0
    content = json.loads(capsys.readouterr().out)
    assert content["rayleigh"]["ratio"] == 0.02 and not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["--modes", "0"], "allowed: 1 to 200"),
        (["--ratio", "1.5"], "allowed: above 0 and below 1"),
        (["--between", "3", "1"], "the lower one first"),
        (["--between", "1", "9"], "two of the 6 modes"),
        (["--set", "gravity.z=0 m/s^2", "--pressed"], "nothing presses the joints"),
    ],
)
def test_what_makes_no_sense_is_said_in_a_line(capsys, words, reason):
    assert main(["modes", "arch", *words]) == 2
    assert reason in capsys.readouterr().err
