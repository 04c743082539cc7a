"""The damping of a step: which one a scene asks for, and what the time step, the bodies and messages know of it.

The forces of all kinds stand in `resist` of masonry/kinematics/motion.py.
"""

from math import ceil, log, log10, pi, sqrt
from typing import NamedTuple, Protocol

import numpy as np

from masonry.kinematics.motion import Dragged, Guided

LITTLE = 0.1
"""xi of the local damping, eq. (3), that acts besides on all motion where the expected motion is not damped."""
PER_DECADE, BEYOND, ROUNDS = 1.5, 0.7, 6
"""Maxwell branches in a decade of frequencies, besides the first, and how far beyond the ends of their band the outer
ones are."""
FLAT_WITHIN = 0.04
"""Of the ratio, all over the band; where so many branches leave more, there is one more."""
DEAR = 2.0
"""From how many times shorter steps on the price of dashpots is told."""

Damping = float | Guided | Dragged | None


class DampingKeys(Protocol):
    """Damping keys of the table [solver] of a scene."""

    @property
    def damping(self) -> float: ...


class SwingKeys(Protocol):
    """Keys of the table [damping]."""

    @property
    def mass_rate(self) -> float: ...

    @property
    def stiffness_time(self) -> float: ...

    @property
    def flat(self) -> tuple[float, float, float] | None: ...

    @property
    def local(self) -> float | None: ...


class Swing(NamedTuple):
    """Damping once the dead loads have settled: a0 (1/s) of the mass, or xi of local damping; a1 (s) of the stiffness
    of contacts; Maxwell's branches beside them: stiffnesses (J,) over theirs, relaxation times (J,) s."""

    mass_rate: float = 0.0
    local: float = 0.0
    stiffness_time: float = 0.0
    stiffer: tuple[float, ...] = ()
    relaxation: tuple[float, ...] = ()

    @property
    def in_contacts(self) -> bool:
        """Whether contacts have dashpots."""
        return bool(self.stiffness_time or self.stiffer)

    @property
    def branch_count(self) -> int:
        """Of branches."""
        return len(self.stiffer) + bool(self.stiffness_time)

    def branches(self, dt: float) -> tuple[np.ndarray, np.ndarray]:
        """Keep (J,) and gain (J,) of patches/branches.py in steps of dt (s)."""
        stiffer, relaxation = np.array(self.stiffer), np.array(self.relaxation)
        keep = np.exp(-dt / relaxation)
        gain = -stiffer * relaxation / dt * np.expm1(-dt / relaxation)
        if not self.stiffness_time:
            return keep, gain
        return np.append(keep, 0.0), np.append(gain, self.stiffness_time / dt)

    def ratio_at(self, frequency: float) -> float:
        """The damping ratio of a swing whose frequency without damping is that (Hz), of rigid blocks whose contacts
        stay closed: from the root s of s^2 + a0 s + w^2 (1 + a1 s + sum of r s T / (1 + s T)) = 0 that swings."""
        omega = 2.0 * pi * frequency
        below = np.poly1d([1.0])
        for time in self.relaxation:
            below *= np.poly1d([time, 1.0])
        whole = np.poly1d([1.0, self.mass_rate + omega**2 * self.stiffness_time, omega**2]) * below
        for k, (share, time) in enumerate(zip(self.stiffer, self.relaxation, strict=True)):
            others = np.poly1d([share * time * omega**2, 0.0])
            for other in self.relaxation[:k] + self.relaxation[k + 1 :]:
                others *= np.poly1d([other, 1.0])
            whole += others
        swings = [root for root in whole.roots if root.imag > 0.0]
        local = log((1.0 + self.local) / (1.0 - self.local)) / (2.0 * pi)
        return local + max((-root.real / abs(root) for root in swings), default=1.0)

    def of_bodies(self, dt: float) -> Damping:
        """As a step of dt (s) takes it, None where nothing damps."""
        return Dragged(0.5 * self.mass_rate * dt) if self.mass_rate else self.local or None

    @property
    def words(self) -> str:
        """Description of the damping, as in `masonry check`."""
        words = [f"damping of the mass, {self.mass_rate:.4g} 1/s"] if self.mass_rate else []
        words += [damping_words(self.local)] if self.local else []
        words += [f"of the stiffness of closed contacts, {self.stiffness_time:.4g} s"] if self.stiffness_time else []
        words += [f"{len(self.stiffer)} Maxwell branches in closed contacts"] if self.stiffer else []
        return ", ".join(words) or damping_words(None)


class Phases(NamedTuple):
    """The damping of bodies while dead loads settle, and from then on."""

    settling: Damping
    swinging: Damping


def damping_of(keys: DampingKeys, drive_expects: bool) -> Damping:
    """Damping of a run; where a drive (to an accuracy) expects the next motion, viscosity damps the rest."""
    return Guided(0.0, LITTLE) if drive_expects else keys.damping


def swing_of(keys: SwingKeys | None) -> Swing:
    """Damping once the dead loads have settled; none without a table."""
    if keys is None:
        return Swing()
    stiffer, relaxation = ((), ()) if keys.flat is None else flat_branches(*keys.flat)
    return Swing(keys.mass_rate, keys.local or 0.0, keys.stiffness_time, stiffer, relaxation)


def flat_branches(ratio: float, low: float, high: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Stiffnesses over the contacts' and relaxation times (s) of Maxwell's branches that damp by a ratio between two
    frequencies (Hz): the least squares of all, scaled until the largest and the least there are as far from it. Up to
    5 % over three decades they are flat within FLAT_WITHIN; 10 % are so over a decade, within 13 % over three."""
    count = 1 + max(ceil(PER_DECADE * log10(high / low) - 0.25), 0)
    fits = []
    for more in (count, count + 1):
        swing, off = _flat_swing(ratio, low, high, more)
        fits.append((off, swing))
        if off <= FLAT_WITHIN:
            break
    _, best = min(fits)
    return best.stiffer, best.relaxation


def _flat_swing(ratio: float, low: float, high: float, count: int) -> tuple[Swing, float]:
    """So many branches, and by what share of the ratio they are off at most within the band."""
    frequencies = np.geomspace(low * BEYOND, high / BEYOND, count) if count > 1 else np.array([sqrt(low * high)])
    relaxation = 1.0 / (2.0 * pi * frequencies)
    band = np.geomspace(low, high, 8 * count + 1)
    x = band[:, None] / frequencies
    lost, borne = x / (1.0 + x**2), x**2 / (1.0 + x**2)
    wanted, swing = ratio, Swing()
    for _ in range(ROUNDS):  # the ratio of a swing is that of the moduli but for terms of second order
        stiffer = np.linalg.lstsq(lost - 2.0 * wanted * borne, np.full(len(band), 2.0 * wanted), rcond=None)[0]
        swing = Swing(stiffer=tuple(stiffer.tolist()), relaxation=tuple(relaxation.tolist()))
        ratios = [swing.ratio_at(frequency) for frequency in band]
        wanted *= ratio / sqrt(min(ratios) * max(ratios))
    return swing, max(abs(one / ratio - 1.0) for one in ratios)


def damping_in_steps(damping: Damping, dt: float) -> Damping:
    """The same as a step of dt (s) takes it, None where nothing damps: what is given for a second becomes a share."""
    return damping or None


def local_damping(damping: Damping) -> float:
    """By up to what share a dof answers with more than its force, which bounds the time step: xi of eq. (3)."""
    if isinstance(damping, Dragged):
        return 0.0
    return damping.xi if isinstance(damping, Guided) else damping or 0.0


def expects_motion(damping: Damping) -> bool:
    """Whether bodies need room for the motion that is expected of them."""
    return isinstance(damping, Guided)


def damping_words(damping: Damping) -> str:
    """Description of the damping, as in `masonry check`."""
    if isinstance(damping, Guided):
        return f"viscous damping of the unexpected motion, local damping {damping.xi:g}"
    return f"local damping {damping:g}" if damping else "no damping"


def price_of_dashpots(shorter: float) -> str:
    """Remark of `masonry check` where dashpots in proportion to stiffness make the steps so many times shorter."""
    if shorter < DEAR:
        return ""
    return (
        f"; dashpots in proportion to stiffness make it {shorter:.3g} times shorter, which damping.maxwell, in place of"
        " damping.stiffness or damping.rayleigh, hardly does"
    )
