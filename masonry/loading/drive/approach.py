"""The approach of a drive to the first damage."""

import numpy as np

from masonry.configuration.energy import Seen
from masonry.loading.drive.utilisation import utilisation
from masonry.model.model import Model
from masonry.runtime.state_file import Remembering


class Approach(Remembering):
    """How near the contacts are to leaving their elastic answer.

    elastic  whether none has left it
    used     the largest share of its strength that a contact uses, at the last look
    rest     (C,) Pa, normal stress under the dead loads alone
    """

    REMEMBERED = ("elastic", "used", "rest")

    def __init__(self, model: Model) -> None:
        self.model = model
        self.elastic, self.used, self.rest = True, 0.0, np.zeros(len(model.group))

    def begin(self, seen: Seen) -> None:
        """The dead loads have settled."""
        self.rest = seen.sigma.copy()
        self.used = utilisation(self.model, seen, self.rest)

    def left(self, used: float, made: float, turns: bool) -> float:
        """m, about, to the first damage, behind an increment (m) after which the contacts use such a share: that grows
        with the path. Where the drive `turns` it falls before it grows: as fast, at most, as it fell."""
        if turns and used < self.used:
            self.used = used - (self.used - used)
        left = made * max(1.0 - used, 0.0) / max(used - self.used, 1e-9)
        self.used = used
        return left
