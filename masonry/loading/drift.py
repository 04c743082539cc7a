"""The steady motion of a specimen that is led, and viscous damping of all other motion.

Local damping, eq. (3), takes a share of the force on a dof that swings while it drifts, and the slower swing goes on: a
drag. Here the drift is told from the swing, and the swing alone is braked, orthogonally with regard to the masses, so
that what drifts steadily is not dragged.
"""

import numpy as np

from masonry.kinematics.turning import Turning
from masonry.loading.moved import Arrays, dofs
from masonry.model.model import Model
from masonry.monitors import energy
from masonry.runtime.state import State


class Drift:
    """How a specimen has moved of late, by kind of motion; older moves fade."""

    def __init__(self, moved: Arrays, fades: float, places: Arrays | None = None) -> None:
        """moved: the mechanism, which it goes by at first; fades: share of what was that a look leaves; places: dofs at
        the last look, None before the first"""
        self.moved, self.fades, self.places = moved, fades, places

    def look(self, model: Model) -> None:
        """Add the move since the last look."""
        now = {kind: place.copy() for kind, place in dofs(model).items()}
        if self.places is not None:
            self.moved = {
                kind: self.fades * motion + (now[kind] - self.places[kind]) for kind, motion in self.moved.items()
            }
        self.places = now

    def brake(self, model: Model, before: list[np.ndarray], left: float) -> float:
        """Leave a share of all velocities but those along the drift: an impulse, booked as a force of the damping in
        this step, so that the energy balance stays closed. Returns how many times `moved` it drifts in a second, a pace
        in which no swing is felt. before: energy.velocities a step earlier

        The mean of the velocities before and after the step counts: of the fastest swings, which turn round at each
        step, one of them alone would make the impulse feed them.
        """
        bodies = energy.present(model)
        earlier = [
            np.concatenate([old[:, :3], over_inertia(body, old[:, 3:])], axis=1) if isinstance(body, Turning) else old
            for (_, body), old in zip(bodies, before, strict=True)
        ]
        mean = [0.5 * (body.v + old) for (_, body), old in zip(bodies, earlier, strict=True)]
        ways = [self.moved[kind] for kind, _ in bodies]
        along = momenta(model, ways)
        inertia, momentum = (
            sum(float(np.sum(a * b)) for a, b in zip(along, moves, strict=True)) for moves in (ways, mean)
        )
        drifts = momentum / inertia
        lost = [(left - 1.0) * (v - drifts * motion) for v, motion in zip(mean, ways, strict=True)]
        for (_, body), change, blow, old in zip(bodies, lost, momenta(model, lost), earlier, strict=True):
            if isinstance(body, Turning):
                body.momentum[...] += blow[:, 3:]
            body.hold[...] += blow / model.dt
            work = 0.5 * blow * old
            if len(work) == len(body.work):
                body.work[:, 1] += work.sum(axis=1)
            else:
                body.work[0, 1] += work.sum()  # nodes of tets are not told apart by block
            body.v[...] += np.where(blow != 0.0, change, 0.0)
        return drifts

    def state(self) -> State:
        """What it is made anew from."""
        return {"moved": self.moved, "fades": self.fades, "places": self.places}


def momenta(model: Model, velocities: list[np.ndarray]) -> list[np.ndarray]:
    """By kind, mass times velocity of all that is free; without turns, of blocks that turn as far as they like and are
    held about some axes."""
    found = []
    for (kind, body), v in zip(energy.present(model), velocities, strict=True):
        one = model.masses[kind] * v
        if isinstance(body, Turning):
            free = np.all(body.dt_over_mass[:, 3:] > 0.0, axis=1, keepdims=True)
            q = principal(body)
            own = np.einsum("bij,bj->bi", q, body.inertia * np.einsum("bji,bj->bi", q, v[:, 3:]))
            one[:, 3:] = np.where(free, own, 0.0)
        found.append(one)
    return found


def over_inertia(body: Turning, momentum: np.ndarray) -> np.ndarray:
    """(B, 3) rad/s of angular momenta (B, 3), as the blocks stand now."""
    q = principal(body)
    return np.einsum("bij,bj->bi", q, np.einsum("bji,bj->bi", q, momentum) / body.inertia)


def principal(body: Turning) -> np.ndarray:
    """(B, 3, 3) principal axes as the blocks stand now, in columns."""
    return body.frame if body.axes is None else body.frame @ body.axes
