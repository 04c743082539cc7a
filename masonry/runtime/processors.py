"""How many processors there are for this process, for which one its code is compiled, and how long they work."""

import os
import platform
import time
from dataclasses import dataclass

from geometry.operating_system import SYSTEM

AUTO = "auto"
"""As many threads as a scene is worth, in place of their number."""


@dataclass(frozen=True)
class Seconds:
    """That a piece of work took: by the clock on the wall, and of processor, by this process with all its threads."""

    wall: float = 0.0
    processor: float = 0.0

    @classmethod
    def now(cls) -> "Seconds":
        """Readings of both clocks: the difference of two readings is the time between them."""
        return cls(time.perf_counter(), time.process_time())

    def __add__(self, other: "Seconds") -> "Seconds":
        return Seconds(self.wall + other.wall, self.processor + other.processor)

    def __sub__(self, other: "Seconds") -> "Seconds":
        return Seconds(self.wall - other.wall, self.processor - other.processor)


def processors() -> int:
    """How many this process may use."""
    return SYSTEM.processors()


def free_processors() -> int:
    """How many of these other programs have left idle in the last minute, as far as the system tells; this one was at
    work itself."""
    return max(0, processors() - int(SYSTEM.busy_processors()))


def compiled_for() -> str:
    """The processor that Numba compiles for: its kind as LLVM knows it, which has other instructions than others and so
    other last bits. NUMBA_CPU_NAME and NUMBA_CPU_FEATURES make it another one than this."""
    from llvmlite import binding

    wishes = [os.environ.get(key) for key in ("NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES")]
    return " ".join(filter(None, (platform.machine(), wishes[0] or binding.get_host_cpu_name(), wishes[1])))
