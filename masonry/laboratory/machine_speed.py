"""How fast this machine is, as a ratio: `masonry doctor` times the step and keeps it, else a quick kernel is timed.

All costs of `cost.py` were measured on one machine, whose ratio is 1; one that takes twice as long has 2.
"""

from functools import cache

import numpy as np

from geometry.operating_system import SYSTEM
from masonry.timeloop.machine_record import read_record, write_record

MACHINE = {"kernel": 2.16e-3, "point": 8.7}
"""Of that machine, an AMD EPYC with AVX-512: seconds of processor of the kernel, and nanoseconds that a step of the
doctor's wall takes per contact point."""
ROUNDS, SIZE = 7, 2048
SANE = (0.1, 30.0)
"""A ratio beyond these was not measured on a machine that does nothing else."""
RECORD, RATIO = "speed", "ratio"


def ratio() -> float:
    """Time of a step here over that on the machine of the costs: as the doctor found, else by the kernel."""
    value = read_record(RECORD).get(RATIO)
    value = kernel_seconds() / MACHINE["kernel"] if value is None else value
    return min(max(value, SANE[0]), SANE[1])


def keep(nanoseconds: float) -> None:
    """Record of the time of a step of the doctor's wall per contact point, for `ratio`."""
    write_record(RECORD, {RATIO: nanoseconds / MACHINE["point"]})


@cache
def kernel_seconds() -> float:
    """Of processor, for what a step and a row do: sums, roots and gathers of short arrays, and some Python; the
    shortest of some rounds, as others may use the processor as well. A process measures it once."""
    x, gather = np.linspace(0.0, 1.0, SIZE), (np.arange(SIZE) * 7) % SIZE
    rounds = []
    for _ in range(ROUNDS):
        begun = SYSTEM.short_seconds()
        for _ in range(150):
            y = np.sqrt(x * x + 1.0)[gather] - 0.5 * x
            np.bincount(gather, y, SIZE)
            sum(i * i for i in range(100))
        rounds.append(SYSTEM.short_seconds() - begun)
    return min(rounds)
