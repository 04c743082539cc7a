"""Is a difference between groups more than chance? Their spread within and between, as in an analysis of variance."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Spread:
    """Groups of equal worth, such as the peaks of five seeds at each of three sizes of cells.

    mean          of all values            means    name of a group -> its mean
    within        standard deviation of a value round the mean of its own group
    between       standard deviation that the groups' true means have beyond what chance alone gives theirs
    chance        probability that groups without any difference come out this far apart or farther
    """

    mean: float
    means: dict[str, float]
    within: float
    between: float
    chance: float

    @property
    def reach(self) -> float:
        """Largest less smallest mean of a group, over the mean of all."""
        return (max(self.means.values()) - min(self.means.values())) / self.mean


def spread_of(groups: Mapping[str, Sequence[float]]) -> Spread:
    """One-way analysis of variance; groups may differ in number. Raises ValueError below two groups or two values."""
    from scipy.stats import f

    values = {name: np.asarray(v, dtype=float) for name, v in groups.items()}
    sizes = np.array([len(v) for v in values.values()])
    total, count = int(sizes.sum()), len(values)
    if count < 2 or sizes.min() < 1 or total <= count:
        raise ValueError("two groups or more, and in one of them two values or more, are needed")
    means = {name: float(v.mean()) for name, v in values.items()}
    whole = float(np.concatenate(list(values.values())).mean())
    inside = sum(float(((v - means[name]) ** 2).sum()) for name, v in values.items()) / (total - count)
    outside = sum(len(v) * (means[name] - whole) ** 2 for name, v in values.items()) / (count - 1)
    typical = (total - float((sizes**2).sum()) / total) / (count - 1)
    chance = float(f.sf(outside / inside, count - 1, total - count)) if inside > 0.0 else float(outside == 0.0)
    return Spread(whole, means, float(np.sqrt(inside)), float(np.sqrt(max(outside - inside, 0.0) / typical)), chance)
