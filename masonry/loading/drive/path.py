"""The path of a drive that is paced by its error, leg by leg."""

import numpy as np

from masonry.runtime.state_file import Remembering


class DrivePath(Remembering):
    """Where the drive goes: to its displacement, or from turn to turn (m, signed).

    begin, end, sign  of the leg that the drive is on; goal: its length, and `moved`, how much of it is made (m)
    """

    REMEMBERED = ("leg", "passed", "goal", "moved", "begin", "end", "sign")

    def __init__(self, places: tuple[float, ...]) -> None:
        self.places = places
        self.whole = float(np.abs(np.diff(places, prepend=0.0)).sum())
        self.leg, self.passed, self.goal, self.end = -1, 0.0, 0.0, 0.0
        self.turn()

    def turn(self) -> bool:
        """Set out for the next place; False where there is none."""
        if self.leg + 1 >= len(self.places):
            return False
        self.leg += 1
        self.passed += self.goal
        self.begin, self.end, self.moved = self.end, self.places[self.leg], 0.0
        self.goal, self.sign = abs(self.end - self.begin), -1.0 if self.end < self.begin else 1.0
        return True

    @property
    def left(self) -> float:
        """Of this leg, m."""
        return self.goal - self.moved

    @property
    def place(self) -> float:
        """Where the drive is, m, signed."""
        return self.begin + self.sign * self.moved

    @property
    def progress(self) -> float:
        """Share of the whole path."""
        return min((self.passed + self.moved) / self.whole, 1.0)
