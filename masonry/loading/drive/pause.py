"""A drive that waits: where a crack is sudden, and at the end of its path."""

from masonry.loading.drive.adaptive_settings import AdaptiveSettings
from masonry.model.model import Model
from masonry.monitors.events import SuddenCracks
from masonry.runtime.state_file import Remembering


class DrivePause(Remembering):
    """The drive is held until the specimen rests, so that the row behind it is an equilibrium. What moves meanwhile is
    not the drive's: it belongs to a sudden crack.

    increments  for which it has been held; 0 while it moves     calm  of those, the last ones at rest
    step        of the last look                                 ended  whether the path is made, and all waits for rest
    """

    REMEMBERED = ("increments", "calm", "step", "ended")

    def __init__(self, model: Model, settings: AdaptiveSettings) -> None:
        self.settings, self.cracks = settings, SuddenCracks(model)
        self.increments = self.calm = self.step = 0
        self.ended = False

    def at_end(self) -> bool:
        """The path is made: whether the drive is still held until the specimen rests."""
        if not self.ended:
            self.ended, self.increments, self.calm = True, 1, 0
        return self.increments > 0

    def look(self, at_rest: bool) -> bool:
        """The drive is held: whether it goes on, as the specimen has come to rest, or does not."""
        self.cracks.sudden(self.step)
        self.calm = self.calm + 1 if at_rest else 0
        self.increments += 1
        if self.calm < self.settings.rest.looks and self.increments <= self.settings.longest_hold:
            return False
        self.increments = 0
        self.cracks.calm(self.step)
        return True

    def follow(self, follows: bool, waits: bool) -> None:
        """The drive moves: whether the specimen follows it, or moves by itself. Then the drive `waits`, unless its path
        is made anyway."""
        if follows:
            self.cracks.calm(self.step)
        else:
            self.cracks.sudden(self.step)
            self.increments, self.calm = int(waits), 0

    def parts(self) -> dict[str, SuddenCracks]:
        """The sudden cracks."""
        return {"cracks": self.cracks}
