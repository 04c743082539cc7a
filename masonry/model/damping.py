"""The damping of a step: which one a scene asks for, and what the time step, the bodies and messages know of it.

The forces of all kinds stand in `resist` of masonry/kinematics/motion.py.
"""

from typing import NamedTuple, Protocol

from masonry.kinematics.motion import Dragged, Guided

LITTLE = 0.1
"""xi of the local damping, eq. (3), that acts besides on all motion where the expected motion is not damped."""

Damping = float | Guided | Dragged | None


class DampingKeys(Protocol):
    """What the table [solver] of a scene says of damping."""

    @property
    def damping(self) -> float: ...


class SwingKeys(Protocol):
    """What the table [damping] says."""

    @property
    def mass_rate(self) -> float: ...

    @property
    def local(self) -> float | None: ...


class Swing(NamedTuple):
    """What damps once the dead loads have settled: a0 (1/s) of the mass, or xi of local damping."""

    mass_rate: float = 0.0
    local: float = 0.0

    def of_bodies(self, dt: float) -> Damping:
        """As a step of dt (s) takes it, None where nothing damps."""
        return Dragged(0.5 * self.mass_rate * dt) if self.mass_rate else self.local or None

    @property
    def words(self) -> str:
        """What `masonry check` says of it."""
        if self.mass_rate:
            return f"damping of the mass, {self.mass_rate:.4g} 1/s"
        return damping_words(self.local)


class Phases(NamedTuple):
    """The damping of bodies while dead loads settle, and from then on."""

    settling: Damping
    swinging: Damping


def damping_of(keys: DampingKeys, drive_expects: bool) -> Damping:
    """What acts in a run; where a drive (to an accuracy) expects what moves next, viscosity damps the rest."""
    return Guided(0.0, LITTLE) if drive_expects else keys.damping


def swing_of(keys: SwingKeys | None) -> Swing:
    """What acts once the dead loads have settled; without a table nothing does."""
    return Swing() if keys is None else Swing(keys.mass_rate, keys.local or 0.0)


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
    """What `masonry check` says of it."""
    if isinstance(damping, Guided):
        return f"viscous damping of the unexpected motion, local damping {damping.xi:g}"
    return f"local damping {damping:g}" if damping else "no damping"
