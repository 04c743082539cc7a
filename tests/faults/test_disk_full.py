"""A full disk: what was written before stays whole, the exit code is not 0, and room is all it takes to go on."""

import errno
import resource

import pytest

from masonry.timeloop import checkpoint
from masonry.timeloop.checkpoint import Checkpoints
from tests.faults.compare import differences
from tests.faults.process import Process
from tests.faults.samples import ALWAYS, LONG, disk, half_done, remount, resume, run

FULL = "No space left on device"


def test_on_a_full_disk_the_last_checkpoint_stays_whole_and_the_run_goes_on_when_there_is_room(alone, tmp_path, capsys):
    with disk(tmp_path / "disk", "100k") as small:
        out = small / "out"
        assert run(out) == 2
        said = capsys.readouterr().err.splitlines()
        assert f"no checkpoint could be written: {FULL}" in said[0] and "the run goes on" in said[0]
        assert f"cannot write results to '{out}': {FULL}" in said[1] and f"masonry resume {out}" in said[1]
        assert len(said) == 2, "each thing is said once"
        state, wrong = Checkpoints(out).newest()
        assert state is not None and not wrong
        assert {path.name for path in out.iterdir()} == {"checkpoint"}
        assert resume(out) == 2 and Checkpoints(out).newest()[0] is not None
        remount(small, "size=10m")
        assert resume(out) == 0
        assert differences(alone, out) == []


def small_files_only() -> None:
    """Files of this process may have 60 kB."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (60_000, 60_000))


def test_where_files_may_not_grow_the_last_checkpoint_stays_whole(tmp_path):
    words = ["run", "couplet", *LONG, "--out", "out", "--quiet", "--checkpoint-every", "0.02 s"]
    process = Process(words, tmp_path, small_files_only)
    assert process.end() == 2
    kept = Checkpoints(tmp_path / "out")
    assert kept.newest()[0] is not None and not kept.newest()[1]
    assert "File too large" in process.said and "masonry resume out" in process.said
    assert "Traceback" not in process.said


@pytest.mark.parametrize("at", ["write", "fsync", "rename"])
def test_whatever_fails_as_a_checkpoint_is_written_the_one_before_stays(at, tmp_path, monkeypatch, capsys):
    kept = half_done(tmp_path / "out", monkeypatch)
    before = {path.name: path.read_bytes() for _, path in kept.states()}
    full = OSError(errno.ENOSPC, FULL)

    def fails(*_):
        raise full

    state, _ = kept.newest()
    with monkeypatch.context() as patched:
        if at == "write":
            patched.setattr(checkpoint, "write", fails)
        else:
            patched.setattr({"fsync": "os.fsync", "rename": "os.replace"}[at], fails)
        with pytest.raises(OSError):
            kept.write(state)
    assert {path.name: path.read_bytes() for path in kept.folder.glob("*.npz")} == before
    assert not list(kept.folder.glob(".*"))


def test_results_that_cannot_be_written_leave_the_checkpoint(alone, tmp_path, monkeypatch, capsys):
    from masonry.laboratory.result import Result

    half_done(tmp_path / "out", monkeypatch)
    with monkeypatch.context() as patched:

        def save(*_):
            raise OSError(errno.ENOSPC, FULL)

        patched.setattr(Result, "save", save)
        assert resume(tmp_path / "out", *ALWAYS) == 2
    assert f"masonry resume {tmp_path / 'out'}" in capsys.readouterr().err
    assert resume(tmp_path / "out") == 0
    assert differences(alone, tmp_path / "out") == []
