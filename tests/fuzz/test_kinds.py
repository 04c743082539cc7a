"""Bad input of every kind: one message, and nothing else. `--inputs 10000` tries so many, others each time."""

import contextlib
import os
import tempfile
from importlib import import_module
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings

from masonry.jit.cache_folder import cache_root
from masonry.quantity import parse
from masonry.runtime.processes import Lost
from masonry.runtime.shell import OK
from tests.fuzz.attempt import KINDS, Attempt
from tests.fuzz.forked import Forked
from tests.fuzz.odd import FORGED, SECRET
from tests.fuzz.room import HANG, Room

for module in ("geometry", "limits", "materials", "runs", "scenes"):
    import_module(f"tests.fuzz.kinds.{module}")
SMALL = {"BLOCKS": 100, "CONTACT_POINTS": 5000, "TETS": 5000}
LARGE = {"BLOCKS": 300, "CONTACT_POINTS": 20_000, "TETS": 20_000}
"""Sizes that scenes may have here, in a campaign larger ones, in place of those of the program: none takes long."""
START = 5
"""Seconds of processor time that a reader has for a small file."""


@pytest.fixture
def room(tmp_path, monkeypatch, capfd, campaign):
    """A room that leaves this process as it was."""
    caches = cache_root()
    fonts = Path(os.environ.get("MPLCONFIGDIR") or caches / "matplotlib")
    fonts.mkdir(parents=True, exist_ok=True)
    (tmp_path / "tmp").mkdir()
    places = {
        "HOME": tmp_path / "home",
        "TMPDIR": tmp_path / "tmp",
        "MASONRY_CACHE": caches.parent,
        "MPLCONFIGDIR": fonts,
    }
    for name, place in places.items():
        monkeypatch.setenv(name, str(place))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "tmp"))
    monkeypatch.setattr("sys.dont_write_bytecode", True)
    for name, most in (LARGE if campaign else SMALL).items():
        monkeypatch.setattr(f"masonry.assembly.size_limits.{name}", most)
    monkeypatch.setattr("masonry.sweeps.engine.work", _no_runs)
    monkeypatch.setattr("geometry.files.sandbox.begin", Forked)
    monkeypatch.setattr("geometry.files.sandbox.START", START)
    parse("1 furlong", "length", "")  # loads what knows the units, and pickles of its own
    with contextlib.chdir(tmp_path):
        yield Room(tmp_path, (caches, fonts), capfd)


@pytest.fixture
def campaign(request) -> int | None:
    """How many inputs over all kinds, where they were asked for."""
    return request.config.getoption("--inputs", None)


def _no_runs(act, tasks, workers, limit):
    """A sweep whose runs are not done already ends with a row that says so."""
    yield from ((number, Lost("no runs here", 0.0)) for number in range(len(tasks)))


@pytest.mark.parametrize("name", sorted(KINDS))
def test_bad_input_ends_in_one_message(name, room, campaign):
    kind = KINDS[name]
    part = kind.share / sum(other.share for other in KINDS.values())

    def ends_well(attempt):
        faults = room.tried(attempt)
        assert not faults, "\n".join(faults)

    ends_well.__name__ = name.replace("-", "_")  # Hypothesis keeps by it what failed
    quick = {} if campaign else {"database": None}
    settings(
        max_examples=max(1, round(campaign * part)) if campaign else kind.few,
        derandomize=not campaign,
        deadline=None,
        print_blob=True,
        suppress_health_check=list(HealthCheck),
        **quick,
    )(given(kind.inputs)(ends_well))()


def test_twenty_one_kinds_are_known():
    assert len(KINDS) == 21


@pytest.mark.parametrize(
    ("act", "words"),
    [
        (lambda words: (_ for _ in ()).throw(ValueError("no")), "traceback"),
        (lambda words: __import__("time").sleep(1), "hangs"),
        (lambda words: Path("elsewhere").write_text("x") and OK, "outside: elsewhere"),
        (lambda words: Path("../elsewhere").write_text("x") and OK, "open /"),
        (lambda words: (Path(tempfile.tempdir) / "left").write_text("x") and OK, "left over: tmp/left"),
        (lambda words: __import__("subprocess").Popen(["sleep", "1"]) and OK, "left running"),
        (lambda words: os.system("true"), "os.system"),
        (lambda words: __import__("warnings").warn("x", stacklevel=2) or OK, "a warning"),
        (lambda words: print("\ud800"), "traceback"),
        (lambda words: print("\x1b[2J") or OK, "control characters"),
        (lambda words: print("x" * 5000, file=__import__("sys").stderr) or OK, "a message of"),
        (lambda words: print(FORGED) or OK, "a line of its own"),
        (lambda words: print(SECRET[:25]) or OK, "repeated"),
        (lambda words: 2, "no message"),
        (lambda words: 1, "exit code"),
        (lambda words: len(bytearray(b"x" * (200 << 20))) * OK, "memory"),
    ],
)
def test_a_clumsy_program_is_found_out(act, words, room, monkeypatch):
    monkeypatch.setattr("masonry.cli.main.main", act)
    monkeypatch.setattr("tests.fuzz.room.MEMORY", 0 if words == "memory" else 1 << 40)
    monkeypatch.setattr("tests.fuzz.room.HANG", 0.1 if words == "hangs" else HANG)
    faults = room.tried(Attempt(["list"]))
    assert any(words in fault for fault in faults), faults
