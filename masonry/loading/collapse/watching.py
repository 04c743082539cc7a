"""Whether a specimen that is watched falls, or is on its way to a rest.

Local damping drags what drifts: a slow fall and a slow way to a rest both creep, and look alike. So what has not come
to rest for a while is let go: damping is little, and all swings about the drift are braked. What falls then
accelerates, and what is on its way to a rest gets there. Where the drift turns round it was a swing, and is dragged
again.
"""

from math import exp

import numpy as np

from masonry.loading.collapse.growing_settings import GrowingSettings
from masonry.loading.moves.drift import Drift
from masonry.loading.moves.moved import Arrays, moved_since
from masonry.model.model import Model
from masonry.runtime.state_file import Remembering, State


class FallWatch(Remembering):
    """The travel since the last rest, look by look, averaged over windows: swings average out.

    window   looks by which patience is measured     usual  m, the most that brought it to rest so far
    looked   looks at this trial     dragged  those since it was begun, or since its drift turned round
    drift    of what is let go; None as long as it is dragged
    """

    REMEMBERED = ("window", "usual", "looked", "dragged", "travels", "means")

    def __init__(self, model: Model, settings: GrowingSettings) -> None:
        self.model, self.settings, self.damping = model, settings, model.damping
        self.window, self.usual = settings.window, 0.0
        self.looked = self.dragged = 0
        self.travels: list[float] = []
        self.means: list[float] = []
        self.drift: Drift | None = None

    def begin(self, window: int, usual: float) -> None:
        """A new trial."""
        self.window, self.usual, self.looked = window, usual, 0
        self.drag()

    def drag(self) -> None:
        """Damping is as usual."""
        self.drift, self.dragged, self.model.damping = None, 0, self.damping

    def let_go(self, rested: Arrays) -> None:
        """Damping is little from here on; what the specimen did since a rest is taken for its drift at first."""
        self.drift = Drift(moved_since(self.model, rested), exp(-1.0 / self.settings.memory))
        self.drift.look(self.model)
        self.travels, self.means = [], []
        self.little()

    def little(self) -> None:
        """Damping of what is let go."""
        assert isinstance(self.damping, float)
        self.model.damping = min(self.damping, self.settings.little)

    def falls(
        self, before: list[np.ndarray], rested: Arrays, travelled: float, alone: np.ndarray | None = None
    ) -> bool:
        """Take in a look at a specimen that does not rest yet, and say whether it falls: whether it accelerates, so far
        (m) from where it rested. before: velocities a step earlier; alone: (B,) blocks that move while the sum over all
        rests: each drifts by itself, and has fallen when it is far enough (moves/travels.py)"""
        self.looked += 1
        if self.drift is None:
            self.dragged += 1
            if self.dragged > self.settings.patient * self.window:
                self.let_go(rested)
            return False
        if self.brake(before, alone) <= 0.0:
            self.drag()
            return False
        return alone is None and self.accelerates(travelled) and travelled > self.settings.usual * self.usual

    def brake(self, before: list[np.ndarray], alone: np.ndarray | None = None) -> float:
        """Brake all swings of what is let go; how fast it drifts, below 0 where it has turned round."""
        if self.drift is None:
            return 0.0
        self.drift.look(self.model)
        return self.drift.brake(self.model, before, self.settings.left, alone)

    def accelerates(self, travelled: float) -> bool:
        """Whether the last third of the averages since it was let go has taken it further than the second."""
        self.travels.append(travelled)
        if len(self.travels) < max(self.window // 2, self.settings.window):
            return False
        self.means, self.travels = [*self.means, float(np.mean(self.travels))], []
        third, odd = divmod(len(self.means), 3)
        if odd or len(self.means) < self.settings.gathers:
            return False
        first, second, last = (self.means[k * third - 1] for k in (1, 2, 3))
        return last - second >= self.settings.faster * (second - first)

    @property
    def too_long(self) -> bool:
        """Whether it has been watched for so long that it counts as one that does not rest."""
        return self.looked >= self.settings.patience * self.window

    def state(self) -> State:
        """All that it goes by."""
        return {**super().state(), "drift": None if self.drift is None else self.drift.state()}

    def restore(self, state: State) -> None:
        """Go on from there."""
        super().restore(state)
        if state["drift"] is not None:
            self.drift = Drift(**state["drift"])
            self.little()
