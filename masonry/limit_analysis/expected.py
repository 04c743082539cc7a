"""Expected duration of a limit analysis, from its size, and a progress that is silent where it takes little."""

import time

from masonry.runtime.progress import Progress, duration
from masonry.runtime.shell import tell
from masonry.statics.problem import RigidContacts
from masonry.statics.solve import Method

POINTS, SECONDS, GROWTH = 28_881, 24.0, 2.0
"""A cone programme of a rubble core in space, measured on one processor, and the exponent of its growth with points."""
PYRAMIDS, GROWTH_OF_PYRAMIDS = (4_131, 33.0), 2.3
"""The same of the linear programme with pyramids of 16 sides."""
MEMORY = 10e3
"""Bytes that a contact point takes."""
LONG, SHORT = 10.0, 2.0
"""Seconds from which what it will take is said; and until which nothing is said of how far it is."""


def seconds_expected(points: int, sides: int) -> float:
    """Of one programme in space; regular bond takes a third or less."""
    if sides:
        return float(PYRAMIDS[1] * (points / PYRAMIDS[0]) ** GROWTH_OF_PYRAMIDS * sides / 16)
    return float(SECONDS * (points / POINTS) ** GROWTH)


def size_words(contacts: RigidContacts, method: Method, dilation: bool) -> str:
    """The size and what it takes, where it takes long; else nothing."""
    seconds = seconds_expected(contacts.count, method.sides)
    if seconds < LONG:
        return ""
    cones = f"friction pyramids of {method.sides} sides" if method.sides else "friction cones"
    words = (
        f"{contacts.count} contact points with {cones}: a programme of this size takes about {duration(seconds)} and "
        f"{max(MEMORY * contacts.count * 1e-9, 0.1):.1f} GB for rubble, a third for regular bond"
    )
    if not dilation:
        words += "; without dilation there are a hundred of them and more"
    elif method.sides:
        words += f"; without --linear about {duration(seconds_expected(contacts.count, 0))}"
    return words + "; fewer blocks take less, in proportion to the square"


class LimitProgress:
    """Tells on standard error what one limit analysis takes, and from some seconds on how far it is."""

    def __init__(self) -> None:
        self.progress = Progress(label="limit")
        self.begun = time.monotonic()
        self.iterations = self.programmes = 0

    def __enter__(self) -> "LimitProgress":
        return self

    def __exit__(self, *exception: object) -> None:
        self.progress.__exit__(*exception)

    def begin(self, words: str) -> None:
        """Say what it will take, before it begins."""
        if words:
            tell(f"limit  {words}")

    def tell(self, iterations: int, note: str) -> None:
        """One iteration more, the first one of a programme is 1; 0 where the solver counts none."""
        self.iterations += iterations > 0
        self.programmes += iterations == 1
        if time.monotonic() - self.begun >= SHORT:
            words = f"programme {self.programmes}, iteration {iterations}, {note}" if iterations else note
            self.progress.update(self.iterations if iterations else 0, words)
