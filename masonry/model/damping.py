"""The damping of a step: which one a scene asks for, and what the time step, the bodies and messages know of it.

The forces of all kinds stand in `resist` of masonry/kinematics/motion.py.
"""

from typing import Protocol

from masonry.kinematics.motion import Guided

LITTLE = 0.1
"""xi of the local damping, eq. (3), that acts besides on all motion where the expected motion is not damped."""

Damping = float | Guided | None


class DampingKeys(Protocol):
    """What the table [solver] of a scene says of damping."""

    @property
    def damping(self) -> float: ...


def damping_of(keys: DampingKeys, drive_expects: bool) -> Damping:
    """What acts in a run; where a drive (to an accuracy) expects what moves next, viscosity damps the rest."""
    return Guided(0.0, LITTLE) if drive_expects else keys.damping


def damping_in_steps(damping: Damping, dt: float) -> Damping:
    """The same as a step of dt (s) takes it, None where nothing damps: what is given for a second becomes a share."""
    return damping or None


def local_damping(damping: Damping) -> float:
    """By up to what share a dof answers with more than its force, which bounds the time step: xi of eq. (3)."""
    return damping.xi if isinstance(damping, Guided) else damping or 0.0


def expects_motion(damping: Damping) -> bool:
    """Whether bodies need room for the motion that is expected of them."""
    return isinstance(damping, Guided)


def damping_words(damping: Damping) -> str:
    """What `masonry check` says of it."""
    if isinstance(damping, Guided):
        return f"viscous damping of the unexpected motion, local damping {damping.xi:g}"
    return f"local damping {damping:g}" if damping else "no damping"
