"""How much memory a process took at most since it was last asked, and which processes it has left behind."""

import os
from contextlib import suppress
from pathlib import Path

STATUS, CLEAR = Path("/proc/self/status"), Path("/proc/self/clear_refs")


def forget_peak() -> None:
    """Count from here on, where the system can."""
    with suppress(OSError):
        CLEAR.write_text("5", encoding="ascii")


def peak() -> int:
    """Bytes of real memory, at most; 0 where the system does not say."""
    with suppress(OSError):
        for line in STATUS.read_text(encoding="ascii", errors="replace").splitlines():
            if line.startswith("VmHWM:"):
                return int(line.split()[1]) * 1024
    return 0


def children() -> set[int]:
    """Numbers of the processes that this one has begun and that have not gone."""
    found: set[int] = set()
    with suppress(OSError):
        for task in Path("/proc/self/task").iterdir():
            found |= {int(word) for word in (task / "children").read_text(encoding="ascii").split()}
    return found - {os.getpid()}
