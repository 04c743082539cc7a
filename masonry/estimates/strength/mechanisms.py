"""What joints that bend in one mechanism bear together, by few contact points and by many.

Their turns keep the ratios that they have at the peak, and the load does the work of all their moments. Joints whose
turns differ do not bear most at the same time: what few points bear more in one of them, they may bear less in others.
"""

import numpy as np

from masonry.estimates.strength.joint_motions import Borne

LEAST, MOST, COARSE, FINE = 0.05, 1e5, 240, 24
"""Multiples of the turns at the peak between which the largest load lies, by few points or by many: a joint that is
about to lift off crushes at thousands of them; those that are looked at over all, and beside the best one."""


def borne_together(joints: list[Borne], points: list[tuple[np.ndarray, np.ndarray]]) -> np.ndarray:
    """(2,) the largest load by the points (n, 3) m, areas (n,) m2, of each joint over that by many, for each of the two
    shares of the work."""
    shares = np.array([one.shares for one in joints]).T
    at_peak = np.array([_moments(one, np.ones(1), own)[0] for one, own in zip(joints, points, strict=True)])
    none = [None] * len(joints)
    return np.array([
        _largest(joints, points, share / at_peak) / max(_largest(joints, none, share / at_peak), 1e-300)
        for share in shares
    ])  # fmt: skip


def bears_at_peak(one: Borne, own: tuple[np.ndarray, np.ndarray]) -> bool:
    """Whether a joint bends, and its points bear a moment at the turn that it has at the peak."""
    return one.at is not None and one.gave and bool(_moments(one, np.ones(1), own)[0] > 0.0)


def _largest(
    joints: list[Borne], points: list[tuple[np.ndarray, np.ndarray]] | list[None], weight: np.ndarray
) -> float:
    """The largest sum of moments times weights of all multiples of their turns."""

    def borne(times: np.ndarray) -> np.ndarray:
        each = [_moments(one, times, these) for one, these in zip(joints, points, strict=True)]
        return np.asarray(weight @ np.array(each))

    times = np.geomspace(LEAST, MOST, COARSE)
    all_ = borne(times)
    best = int(np.argmax(all_))
    beside = np.geomspace(times[max(best - 1, 0)], times[min(best + 1, COARSE - 1)], FINE)
    return float(max(all_[best], borne(beside).max()))


def _moments(one: Borne, times: np.ndarray, points: tuple[np.ndarray, np.ndarray] | None) -> np.ndarray:
    assert one.at is not None
    return one.at(times, points)
