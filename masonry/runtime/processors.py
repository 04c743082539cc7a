"""How many processors there are for this process, and for which one its code is compiled."""

import os
import platform


def processors() -> int:
    """How many this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def compiled_for() -> str:
    """The processor that Numba compiles for: its kind as LLVM knows it, which has other instructions than others and so
    other last bits. NUMBA_CPU_NAME and NUMBA_CPU_FEATURES make it another one than this."""
    from llvmlite import binding

    wishes = [os.environ.get(key) for key in ("NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES")]
    return " ".join(filter(None, (platform.machine(), wishes[0] or binding.get_host_cpu_name(), wishes[1])))
