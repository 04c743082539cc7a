"""How many processes run tests side by side: as many as there are processors, and as memory has room for."""

from pathlib import Path

from geometry.operating_system import SYSTEM

EACH = 3 * 2**30
"""Bytes that a process of the tests takes at most: 2.9 GB where it compiles all that its tests need."""


def workers() -> int:
    """For this machine, or the container that this runs in."""
    return fitting(SYSTEM.processors(), free_memory(Path("/")))


def fitting(processors: int, free: float) -> int:
    """One for each processor and for each EACH bytes that are free, one at least."""
    return max(1, int(min(processors, free / EACH)))


def free_memory(root: Path) -> float:
    """Bytes that may still be taken, by the kernel and by the limit of the container; infinite where neither says."""
    free = [_available(root / "proc" / "meminfo"), *(_left(root, *names) for names in LIMITS)]
    return min(free)


LIMITS = (
    ("sys/fs/cgroup/memory.max", "sys/fs/cgroup/memory.current"),
    ("sys/fs/cgroup/memory/memory.limit_in_bytes", "sys/fs/cgroup/memory/memory.usage_in_bytes"),
)
"""Limit and use of a container, in version 2 of control groups and in version 1."""


def _available(file: Path) -> float:
    lines = [line.split() for line in _text(file).splitlines() if line.startswith("MemAvailable:")]
    return 1024.0 * float(lines[0][1]) if lines else float("inf")


def _left(root: Path, limit: str, used: str) -> float:
    most, taken = _text(root / limit).strip(), _text(root / used).strip()
    return float(most) - float(taken) if most.isdigit() and taken.isdigit() else float("inf")


def _text(file: Path) -> str:
    try:
        return file.read_text(encoding="ascii")
    except (OSError, ValueError):
        return ""
