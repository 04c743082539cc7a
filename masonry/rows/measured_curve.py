"""A measured curve beside a computed one: envelopes of both, and how their peaks, stiffnesses and energies differ."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from masonry.rows.peak import only_rises

AT = 0.7
"""Of the peak: where the secant stiffness is taken, as usual for shear walls."""


class ForcePath(NamedTuple):
    """Path of a test: places (n,) m, and forces (n,) N, one after the other."""

    place: np.ndarray
    force: np.ndarray


@dataclass(frozen=True)
class CurveNumbers:
    """Of a curve: highest and lowest force (N) and where (m), secant stiffness (N/m) at a share `AT` of the highest,
    and the energy (J) that it took: the area under the curve, or within its loops."""

    peak: float
    at_peak: float
    lowest: float
    at_lowest: float
    stiffness: float | None
    energy: float


def envelope(path: ForcePath, side: float = 1.0) -> ForcePath:
    """The points at which a path is farther out on a side (1 or -1) than ever before, and where it set out: of cycles
    the first one at each place."""
    out = side * path.place
    before = np.concatenate([[-np.inf], np.maximum.accumulate(out)[:-1]])
    first = out > before
    return ForcePath(path.place[first], path.force[first])


def numbers_of(path: ForcePath, upto: float | None = None) -> CurveNumbers:
    """Upto  m: how far a curve that goes one way is looked at; None: the energy of the whole path, cycles included"""
    front, back = envelope(path), envelope(path, -1.0)
    if upto is not None:
        front = cut(front, upto)
    top, low = int(np.argmax(front.force)), int(np.argmin(back.force))
    whole = path if upto is None else front
    return CurveNumbers(
        peak=float(front.force[top]),
        at_peak=float(front.place[top]),
        lowest=float(back.force[low]),
        at_lowest=float(back.place[low]),
        stiffness=_secant(front, top),
        energy=float(np.sum(0.5 * (whole.force[1:] + whole.force[:-1]) * np.diff(whole.place))),
    )


def cut(path: ForcePath, upto: float) -> ForcePath:
    """An envelope as far as a place (m)."""
    near = path.place < upto
    return ForcePath(np.append(path.place[near], upto), np.append(path.force[near], np.interp(upto, *path)))


def cycles(path: ForcePath) -> bool:
    """Whether it turns back: it goes below where it set out, or comes back by more than half of its way."""
    way = path.place - path.place[0]
    back = np.maximum.accumulate(way) - way
    return not only_rises(path.place) and float(back.max()) > 0.5 * float(np.abs(way).max())


def farthest_apart(one: ForcePath, other: ForcePath) -> float:
    """N: how far two envelopes are apart at most, as far as both reach."""
    upto = min(one.place[-1], other.place[-1])
    places = np.union1d(*(path.place[path.place <= upto] for path in (one, other)))
    return float(np.abs(np.interp(places, *one) - np.interp(places, *other)).max())


def _secant(front: ForcePath, top: int) -> float | None:
    """N/m, from the start of an envelope to where it first bears a share of its peak."""
    rise = front.force[: top + 1] - front.force[0]
    if rise[-1] <= 0.0:
        return None
    k = int(np.argmax(rise >= AT * rise[-1]))
    place = np.interp(AT * rise[-1], rise[k - 1 : k + 1], front.place[k - 1 : k + 1])
    return float(AT * rise[-1] / (place - front.place[0])) if place > front.place[0] else None
