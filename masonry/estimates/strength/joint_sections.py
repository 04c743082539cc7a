"""Strength of a joint in bending, as a section: by its few contact points, and by a stress spread over its area.

A section stays plane: it opens by e = e0 + turn * place. Each of its fibres has the stress of the law's envelope at its
opening, elastic where it closes. The section bears the largest moment of all turns at which its normal force balances.
"""

from typing import Any, NamedTuple

import numpy as np

from geometry.joints.faces.strips import Section
from masonry.laws.compression_cap import strength_left
from masonry.laws.law_dispatch import tension_intact
from masonry.laws.state import JointProperties

PLACES, CURVE = 48, 200
"""Even openings at each turn, and points of the envelope."""
TURNS, NEARER, FEWEST = 800, 400, 8
"""Turns over fibres that are looked at, so that all sections take the same time: over all that may count, then beside
the one that bears most; and the fewest of each, where there are many fibres."""
ELASTIC = 0.1
"""Of the turn at which a section without a normal force tears first: from where turns are looked at."""
LEFT, PRESSED = 0.01, 0.1
"""Share of the strength left at the edge, and of the depth that is pressed, from which on a section that turns further
bears no more."""
JUST = 1e-9
"""Of an opening: what is just before it."""
OVER = 300.0
"""Times the closing at which a section has its strength: its edge has closed by as much when it bears next to all that
it can."""
PULLED = 1e-6
"""Of the tensile strength: a mean tension above which the line of action of a normal force stays where it is."""


class Envelope(NamedTuple):
    """A law under monotonic opening and closing: opening (E,) m, below 0 closing, and stress (E,) Pa; stiffness Pa/m.

    limit    m, the opening at which it tears; 0 without tension
    end      m, the opening at which next to nothing is left, or the last that is known
    crushes  m, the closings at which it begins to crush and has its strength; infinite where it does not
    """

    opening: np.ndarray
    stress: np.ndarray
    stiffness: float
    limit: float
    end: float
    crushes: tuple[float, float]


def envelope(parameters: Any, joint: JointProperties, farthest: float) -> Envelope:
    """Of a law with numbers of one contact, up to an opening (m)."""
    strong, stiffness = float(joint.tensile_strength or 0.0), float(joint.normal_stiffness)
    limit = strong / stiffness
    opening, stress, end = np.zeros(1), np.zeros(1), 0.0
    if strong > 0.0:
        beyond = limit + np.geomspace(1e-6 * limit, max(farthest, 2.0 * limit), CURVE)
        with np.errstate(all="ignore"):
            left = np.array([float(tension_intact(parameters, joint, e)) for e in beyond])
        opening, stress = np.concatenate([[0.0, limit], beyond]), strong * np.concatenate([[0.0, 1.0], left])
        gone = np.flatnonzero(left <= LEFT)
        end = float(beyond[gone[0]] if len(gone) else beyond[-1])
    if joint.compressive_strength is None:
        return Envelope(opening, stress, stiffness, limit, end, (np.inf, np.inf))
    closing, pressure = _crushing(joint)
    crushes = float(closing[0]), float(closing[np.argmax(pressure)])
    closes, presses = -closing[::-1], -pressure[::-1]
    return Envelope(
        np.concatenate([closes, opening]), np.concatenate([presses, stress]), stiffness, limit, end, crushes
    )


def _crushing(joint: JointProperties) -> tuple[np.ndarray, np.ndarray]:
    """Closing (E,) m and pressure (E,) Pa of a law that crushes, from where it begins on."""
    strong, stiffness = float(joint.compressive_strength or 0.0), float(joint.normal_stiffness)
    path = max(strong / stiffness, float(joint.closing_at_peak or 0.0))
    plastic = np.concatenate([[0.0], np.geomspace(1e-3, 1e3, CURVE) * path])
    pressure = np.array([float(strength_left(joint, h)) for h in plastic])
    return plastic + pressure / stiffness, pressure


def plane(section: Section, law: Envelope, opening: float, turn: float) -> float:
    """N m: the moment of a section that is open by so much in its middle (m) and turned (rad), as if for the first
    time."""
    e = opening + turn * section.place
    return float(_stress(law, e) @ (section.area * section.place))


def _stress(law: Envelope, opening: np.ndarray) -> np.ndarray:
    stress = np.interp(opening, law.opening, law.stress)
    return np.where(opening < 0.0, law.stiffness * opening, stress) if np.isinf(law.crushes[0]) else stress


def strength(section: Section, law: Envelope, force: float, moment: float, farthest: float) -> float:
    """N m: the largest moment that a section bears, up to a turn (rad), while it carries a normal force (N).

    A pressure stays as it is while the moment grows. A tension grows with the moment, on the same line of action. What
    crushes is turned as far as it takes; what has no tension and does not crush, and is turned without end, turns about
    its edge.
    """
    first, last = _looked_at(section, law, force, farthest)
    if _is_dry(law):
        return float(_dry(section, law, force, np.array([last]))[0])
    arm = _line_of_action(section, law, force, moment)
    fibres = len(section.place)
    turns = np.geomspace(first, last, max(TURNS // fibres, FEWEST))
    borne = _borne(section, law, force, arm, turns)
    most = int(np.argmax(borne))
    beside = turns[max(most - 1, 0)], turns[min(most + 1, len(turns) - 1)]
    turns = np.geomspace(*beside, max(NEARER // fibres, FEWEST))
    return float(max(borne[most], _borne(section, law, force, arm, turns).max()))


def moments(
    section: Section, law: Envelope, force: float, moment: float, farthest: float, turns: np.ndarray
) -> np.ndarray:
    """(T,) N m: what the same section bears at turns (T,) rad; beyond those that `strength` looks at, what it bears at
    the last of them."""
    last = _looked_at(section, law, force, farthest)[1]
    if _is_dry(law):
        return _dry(section, law, force, np.minimum(turns, last) if np.isfinite(last) else np.full(len(turns), last))
    arm = _line_of_action(section, law, force, moment)
    return _borne(section, law, force, arm, np.minimum(turns, last))


def _looked_at(section: Section, law: Envelope, force: float, farthest: float) -> tuple[float, float]:
    """rad: the turns between which the largest moment lies; infinite where a section turns about its edge."""
    presses = max(-force, 0.0) / (law.stiffness * float(section.area.sum()))
    if _is_dry(law):
        return farthest, farthest
    first = ELASTIC * (law.limit or presses) / section.depth
    last = max(farthest, 2.0 * first / ELASTIC)
    if law.limit > 0.0:
        opens = min(float(section.place.max()), 0.5 * section.depth)  # how far from the middle the edge lies that tears
        useless = max(law.end / opens, 2.0 * presses / PRESSED**2 / section.depth)
        last = max(min(farthest, useless), 2.0 * first / ELASTIC)
    if np.isfinite(law.crushes[1]):
        last = max(last, OVER * law.crushes[1] / section.depth)
    return first, last


def _is_dry(law: Envelope) -> bool:
    """Whether it neither pulls nor crushes."""
    return law.limit == 0.0 and bool(np.isinf(law.crushes[1]))


def _dry(section: Section, law: Envelope, force: float, turns: np.ndarray) -> np.ndarray:
    """(T,) N m: the moments that a section without tension bears under a normal force (N) at turns (T,) rad.

    It bears on the fibres beside its edge, which close as far as they lie from where it opens; on the edge itself where
    a turn has no end, or nothing presses.
    """
    place, area = section.place, section.area
    edge = np.full(len(turns), force * float(place.min()))
    turned = np.isfinite(turns) & (force < 0.0)
    if not turned.any():
        return edge
    order = np.argsort(place)
    place, area = place[order], area[order]
    sums = np.cumsum(area), np.cumsum(area * place), np.cumsum(area * place**2)
    closing = place * sums[0] - sums[1]  # m3, of the fibres below each one where the section opens there, over the turn
    strain = law.stiffness * turns[turned]
    last = np.searchsorted(closing, -force / strain, side="right") - 1
    total, first, second = (column[last] for column in sums)
    opens = (-force / strain + first) / total
    edge[turned] = strain * (second - opens * first)
    return edge


def _line_of_action(section: Section, law: Envelope, force: float, moment: float) -> float:
    """m: the arm of a tension, which grows with its moment; 0 of a pressure, which stays as it is."""
    least = PULLED * law.limit * law.stiffness * float(section.area.sum())
    return moment / force if force > least and moment > 0.0 else 0.0


def _borne(section: Section, law: Envelope, force: float, arm: float, turns: np.ndarray) -> np.ndarray:
    """(T,) N m: the moments that a section bears at turns (T,) rad, with a normal force (N); a tension with an arm (m)
    stays on its line of action."""
    pulled = arm > 0.0
    closed = min(force, 0.0) / (law.stiffness * float(section.area.sum()))
    low, high = np.full(len(turns), closed - 1e-6 * law.limit), law.limit - turns * section.place.min()
    if np.isfinite(law.crushes[0]):
        low = np.minimum(low, -law.crushes[1]) - turns * section.place.max()
    if pulled:
        low -= turns * np.abs(section.place).max()
    even = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, PLACES)
    before = law.limit * (1.0 - JUST) - turns[:, None] * section.place  # just before each fibre tears
    kinks = [even, before]
    if np.isfinite(law.crushes[0]):
        kinks += [-closing - turns[:, None] * section.place for closing in sorted(set(law.crushes))]
    e0 = np.sort(np.concatenate(kinks, axis=1), axis=1)
    e = e0[:, :, None] + turns[:, None, None] * section.place
    stress = _stress(law, e)
    normal, bending = stress @ section.area, stress @ (section.area * section.place)
    off = bending - arm * normal if pulled else force - normal
    passes = off[:, :-1] * off[:, 1:] <= 0.0
    share = off[:, :-1] / np.where(off[:, :-1] == off[:, 1:], 1.0, off[:, :-1] - off[:, 1:])
    borne = bending[:, :-1] + share * np.diff(bending, axis=1)
    return np.asarray(np.where(passes, borne, 0.0).max(axis=1))
