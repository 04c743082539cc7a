"""What bars bore, and which of them yielded."""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.results.records.bar_record import BarRecord, WithBars


def bars_at_work(assembly: Assembly) -> WithBars:
    """At any step of a run, from its model at the end."""
    if (bars := assembly.model.bars) is None:
        return WithBars()
    most, least = int(np.argmax(bars.peak)), int(np.argmin(bars.trough))
    return WithBars(
        BarRecord(
            count=len(bars.length),
            largest_force_n=float(bars.peak[most]),
            largest_of=most,
            least_force_n=float(bars.trough[least]),
            least_of=least,
            yielded=int((bars.plastic_work > 0.0).sum()),
            longest_plastic_m=float(np.abs(bars.plastic).max()),
            plastic_m=bars.plastic.tolist(),
        )
    )
