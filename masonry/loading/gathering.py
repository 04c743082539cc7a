"""Whether a specimen that is watched gathers way, or is on its way to a rest."""

import numpy as np

from masonry.loading.settings import GrowingSettings
from masonry.runtime.state import State, attributes, load_attributes

REMEMBERED = ("travels", "means")


class Gathering:
    """The travel since the last rest, look by look, averaged over windows: motion towards a rest decays, and swings
    average out."""

    def __init__(self, settings: GrowingSettings) -> None:
        self.settings = settings
        self.travels: list[float] = []
        self.means: list[float] = []

    def begin(self) -> None:
        """A new trial."""
        self.travels, self.means = [], []

    def goes_on(self, travelled: float, window: int) -> bool:
        """Take in a travel (m), and say whether the specimen moves on as fast as before. window: looks of a mean"""
        self.travels.append(travelled)
        if len(self.travels) < window:
            return False
        self.means, self.travels = [*self.means, float(np.mean(self.travels))], []
        third, odd = divmod(len(self.means), 3)
        if odd or len(self.means) < self.settings.gathers:
            return False
        first, second, last = (self.means[k * third - 1] for k in (1, 2, 3))
        return last - second >= max(second - first, self.settings.still_going * last)

    @property
    def too_long(self) -> bool:
        """Whether it has been watched for so long that it counts as one that does not rest."""
        return len(self.means) >= self.settings.patience

    def state(self) -> State:
        """All that it goes by."""
        return attributes(self, REMEMBERED)

    def restore(self, state: State) -> None:
        """Go on from there."""
        load_attributes(self, REMEMBERED, state)
