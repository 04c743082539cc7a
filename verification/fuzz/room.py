"""The place where bad input is tried: a folder for each input, and beside it all that a process may write elsewhere.

HOME and TMPDIR are folders of the room that must stay empty; caches (compiled code, fonts) are kept apart.
"""

import os
import shutil
import stat
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
CHANGES = {
    "os.remove": 1,
    "os.rename": 2,
    "os.mkdir": 1,
    "os.rmdir": 1,
    "os.symlink": 2,
    "os.link": 2,
    "os.truncate": 1,
    "os.chmod": 1,
    "os.chown": 1,
    "shutil.rmtree": 1,
    "shutil.move": 2,
}
"""Events of Python's audit hook that change files, and how many paths each has."""
FORBIDDEN = ("pickle.find_class", "os.system", "socket.connect", "webbrowser.open", "os.exec", "os.posix_spawn")
"""Events that no input may lead to."""


@dataclass
class Room:
    """root holds `home` and `tmp`, which must stay empty, and the folders of inputs; `allowed` may be written to."""

    root: Path
    allowed: tuple[Path, ...]
    folder: Path | None = None

    def __post_init__(self) -> None:
        self.seen: list[str] = []
        for name in ("home", "tmp"):
            (self.root / name).mkdir(parents=True, exist_ok=True)

    def watch(self, event: str, words: tuple[Any, ...]) -> None:
        """An audit hook: notes what is written outside the folder of the input, and what must never happen."""
        if self.folder is None:
            return
        if event in FORBIDDEN and not _by_numba():
            self.seen.append(f"{event} {words[:2]!r:.200}")
        elif event == "open" and isinstance(words[2], int) and words[2] & WRITING:
            as_it_is = isinstance(words[0], int) or words[2] & os.O_NOFOLLOW
            self._note(event, words[0] if as_it_is else os.path.realpath(words[0]))
        elif event in CHANGES:
            for path in words[: CHANGES[event]]:
                self._note(event, path)

    def _note(self, event: str, path: Any) -> None:
        if isinstance(path, int):
            return
        try:
            place = Path(os.path.abspath(os.fsdecode(path)))
        except (TypeError, ValueError):
            return
        assert self.folder is not None
        fine = (self.folder, self.root / "tmp", Path("/dev/null"), *self.allowed)
        if not any(place.is_relative_to(top) for top in fine):
            self.seen.append(f"{event} {place}")

    def enter(self, name: str) -> Path:
        """A new empty folder, which becomes the working folder."""
        folder = self.root / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        os.chdir(folder)
        self.seen.clear()
        return folder

    def leave(self, folder: Path, keep: bool) -> None:
        os.chdir(self.root)
        if not keep:
            shutil.rmtree(folder, ignore_errors=True)
        for name in ("home", "tmp"):
            for left in (self.root / name).iterdir():
                shutil.rmtree(left) if left.is_dir() and not left.is_symlink() else left.unlink()

    def left_over(self) -> list[str]:
        """What stands where nothing may stand."""
        return [f"left over: {name}/{left.name}" for name in ("home", "tmp") for left in (self.root / name).iterdir()]


def made(root: Path) -> Room:
    """A room for this process, which it cannot leave: HOME and TMPDIR are in it, caches where they are shared."""
    from masonry.jit.compiler import cache_root

    caches = cache_root()
    fonts = Path(os.environ.get("MPLCONFIGDIR") or caches / "matplotlib")
    fonts.mkdir(parents=True, exist_ok=True)
    room = Room(root, (caches, fonts))
    os.environ |= {
        "HOME": str(root / "home"),
        "TMPDIR": str(root / "tmp"),
        "MASONRY_CACHE": str(caches),
        "MPLCONFIGDIR": str(fonts),
    }
    tempfile.tempdir = str(root / "tmp")
    sys.addaudithook(room.watch)
    return room


def _by_numba() -> bool:
    """Whether Numba is at work, which keeps what it compiled as pickles in a cache of its own."""
    frame = sys._getframe(2)
    while frame is not None:
        if "/numba/" in frame.f_code.co_filename:
            return True
        frame = frame.f_back  # type: ignore[assignment]
    return False


def listing(folder: Path) -> dict[str, tuple[int, ...]]:
    """Every name below a folder with its kind, and the size and time of what is a file."""
    found: dict[str, tuple[int, ...]] = {}
    for top, folders, files in os.walk(folder):
        for name in (*folders, *files):
            state = os.lstat(os.path.join(top, name))
            one = (state.st_mode, state.st_size, state.st_mtime_ns)
            found[os.path.relpath(os.path.join(top, name), folder)] = one if stat.S_ISREG(state.st_mode) else one[:1]
    return found


def differences(
    before: dict[str, tuple[int, ...]], after: dict[str, tuple[int, ...]], writes: tuple[str, ...]
) -> list[str]:
    """Names that came, went or changed, other than those that may."""
    changed = {name for name in before | after if before.get(name) != after.get(name)}
    fine = [name for name in changed if any(name == top or name.startswith(f"{top}/") for top in writes)]
    return sorted(changed.difference(fine))
