"""Counts what is done of many and says how much time is left, from the time that the others took."""

import time
from collections.abc import Callable, Iterable

from masonry.runtime.progress import duration

Tell = Callable[[str], None]


class Tally:
    """One line for each that ends: `[ 3/12] couplet   OK     1.2 s   about 10 s left`."""

    def __init__(self, names: Iterable[str], tell: Tell | None) -> None:
        names = list(names)
        self.total, self.tell = len(names), tell
        self.margin = max(map(len, names), default=0)
        self.count = 0
        self.begun = time.perf_counter()

    def ended(self, name: str, status: str, seconds: float) -> None:
        """One more is done."""
        self.count += 1
        if self.tell is None:
            return
        left = self.total - self.count
        passed = time.perf_counter() - self.begun
        rest = f"about {duration(passed / self.count * left)} left" if left else f"{duration(passed)} in all"
        self.tell(
            f"[{self.count:>{len(str(self.total))}}/{self.total}] {name:<{self.margin}}  {status:<9} "
            f"{duration(seconds):>11}   {rest}"
        )
