"""The command `masonry limit`: what it prints, what it writes, how it ends."""

import json

import pytest

from masonry.cli.main import main


def test_the_command_prints_and_writes_what_was_found(tmp_path, capsys):
    out = tmp_path / "found"
    assert main(["limit", "arch-tilted", "--out", str(out)]) == 0
    said = capsys.readouterr().out
    assert "0.373612" in said and "duality gap" in said and "limit.json" in said
    content = json.loads((out / "limit.json").read_text())
    assert content["factor"] == pytest.approx(0.37361, abs=3e-6)
    assert content["duality_gap"] < 1e-6
    assert len(content["mechanism"]["velocity"]) == content["blocks"] == 10
    assert content["mechanism"]["moving_blocks"] == list(range(7))
    assert all((out / name).read_bytes()[:4] == b"\x89PNG" for name in ("mechanism.png", "thrust.png"))
    assert main(["limit", "arch-tilted", "--out", str(out)]) == 2, "results are there already"
    assert main(["limit", "arch-tilted", "--out", str(out), "--overwrite", "--view", "iso"]) == 0


def test_the_command_hands_out_json_alone_and_no_bound_is_marked(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["limit", "arch-tilted", "--no-dilation", "--json"]) == 0
    content = json.loads(capsys.readouterr().out)
    assert content["bound"].startswith("no bound") and content["with_dilation"] == pytest.approx(0.37361, abs=3e-6)
    assert not list(tmp_path.iterdir())


def test_the_command_ends_with_2_and_one_line_for_what_has_no_answer(capsys):
    assert main(["limit", "arch"]) == 2
    assert capsys.readouterr().err.count("\n") == 1
