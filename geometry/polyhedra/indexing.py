"""Index arrays for lists of different lengths, without Python loops."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np


def ranges(start: np.ndarray, count: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Owner i and index of every entry of the ranges start[i] .. start[i] + count[i] - 1, one after another."""
    owner = np.repeat(np.arange(len(count)), count)
    before = np.cumsum(count) - count
    return owner, np.arange(len(owner)) - before[owner] + np.asarray(start)[owner]


def following(start: np.ndarray) -> np.ndarray:
    """(c,) of the entries of rings, which begin at start (n + 1,): where the next one of the same ring is."""
    after = np.arange(1, int(start[-1]) + 1)
    after[start[1:] - 1] = start[:-1]
    return after


@dataclass(frozen=True)
class Lists:
    """Lists of whole numbers one after another: list i is entry[start[i]:start[i + 1]], start (n + 1,)."""

    start: np.ndarray
    entry: np.ndarray

    @classmethod
    def by_owner(cls, owner: np.ndarray, entry: np.ndarray, count: int) -> "Lists":
        """A list for each owner 0..count - 1, its entries (n,) in the order in which they stand."""
        order = np.argsort(owner, kind="stable")
        return cls(np.searchsorted(owner[order], np.arange(count + 1)), entry[order])

    @classmethod
    def of(cls, lists: Iterable[Iterable[int]]) -> "Lists":
        """The same lists."""
        plain = [list(entry) for entry in lists]
        start = np.cumsum([0, *(len(entry) for entry in plain)])
        return cls(start, np.array([i for entry in plain for i in entry], dtype=np.int64))

    @property
    def count(self) -> int:
        return len(self.start) - 1

    @property
    def lengths(self) -> np.ndarray:
        """(n,)"""
        return np.diff(self.start)

    def taken(self, which: np.ndarray) -> "Lists":
        """Some of the lists (m,), in that order."""
        length = self.lengths[which]
        return Lists(np.concatenate([[0], np.cumsum(length)]), self.entry[ranges(self.start[which], length)[1]])

    def followed_by(self, more: "Lists") -> "Lists":
        """These lists and then more."""
        return Lists(
            np.concatenate([self.start, self.start[-1] + more.start[1:]]), np.concatenate([self.entry, more.entry])
        )

    def one(self, i: int) -> list[int]:
        """The numbers of list i."""
        return self.entry[self.start[i] : self.start[i + 1]].tolist()

    def lists(self) -> list[list[int]]:
        """All of them, for loops in Python."""
        entry, start = self.entry.tolist(), self.start.tolist()
        return [entry[first:last] for first, last in zip(start, start[1:], strict=False)]
