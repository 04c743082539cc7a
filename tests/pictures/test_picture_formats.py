"""Pictures as PDF and SVG: the same bytes for the same figure, marked as ours, and one message for another format."""

import pytest

from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.runtime.named_file import is_marked
from tests.results.sample import sample

HEADS = {"png": b"\x89PNG", "pdf": b"%PDF-", "svg": b"<?xml"}


@pytest.mark.parametrize("form", HEADS)
def test_pictures_are_written_in_each_format_without_dates_and_with_our_mark(tmp_path, form):
    paths = [sample().save_pictures(tmp_path / name, form) for name in ("one", "two")]
    assert sorted(paths[0]) == [f"cracks.{form}", f"curve.{form}"]
    for name in paths[0]:
        first, second = (path[name].read_bytes() for path in paths)
        assert first == second and first.startswith(HEADS[form])
        assert b"Date" not in first.replace(b"/Dates", b"") and is_marked(paths[0][name])


def test_commands_take_a_format_and_pictures_a_suffix(tmp_path, capsys):
    sample().save(tmp_path / "run")
    assert main(["plot", str(tmp_path / "run"), "--format", "svg"]) == 0
    assert capsys.readouterr().out.split("\n")[0] == f"curve          {tmp_path / 'run' / 'curve.svg'}"
    assert main(["picture", str(tmp_path / "run"), "--format", "pdf"]) == 0
    assert (tmp_path / "run" / "peak-front.pdf").read_bytes().startswith(HEADS["pdf"])
    assert main(["picture", str(tmp_path / "run"), "--out", str(tmp_path / "wall.svg")]) == 0
    assert main(["picture", str(tmp_path / "run"), "--out", str(tmp_path / "wall.svg")]) == 0, "ours is replaced"
    (tmp_path / "mine.pdf").write_bytes(b"%PDF-")
    assert main(["picture", str(tmp_path / "run"), "--out", str(tmp_path / "mine.pdf")]) == 2
    assert sample().plot(tmp_path / "curve.pdf") is not None and (tmp_path / "curve.pdf").is_file()


@pytest.mark.parametrize("command", ["plot DIR", "picture DIR", "limit couplet", "modes couplet", "spectrum DIR"])
def test_a_wrong_format_is_told_in_one_message_with_the_nearest(tmp_path, capsys, command):
    assert main([*command.replace("DIR", str(tmp_path)).split(), "--format", "pfd"]) == 2
    complaint = capsys.readouterr().err
    assert "--format: 'pfd'; known here: pdf, png, svg; did you mean 'pdf'?" in complaint
    assert complaint.count("\n") == 1
    with pytest.raises(SceneError, match=r"a picture is a .png, .pdf or .svg file; nearest: 'curve.svg'"):
        sample().plot(tmp_path / "curve.svgz")
