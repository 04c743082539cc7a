"""Sudden cracks: moments in which a specimen moves by itself, as more energy is set free than the cracks take up."""

from typing import Any, NamedTuple

import numpy as np

from masonry.configuration.configuration import configuration_of
from masonry.model.model import Model
from masonry.runtime.state_file import State

PARTED = 0.02
"""Of the most that was stored: what a specimen that came apart is taken to store, as its pieces still move."""


class Event(NamedTuple):
    """One sudden crack: its first and last step, the energy (J) that damping took between them, and the contact that
    dissipated most (-1: none did)."""

    first: int
    last: int
    released: float
    contact: int


class SuddenCracks:
    """The sudden cracks of a run, and the one that goes on, if one does.

    densities, damped  what contacts, of `_densities`, and damping (J) had taken when the specimen followed its drive
    """

    def __init__(self, model: Model) -> None:
        self.model, self.crushing = model, configuration_of(model).crushing
        self.events: list[Event] = []
        self.going_on = False
        self.calm(0)

    def calm(self, step: int) -> None:
        """The specimen follows its drive after this step."""
        self.going_on, self.step = False, step
        self.densities, self.damped = self._densities(), self._damped()

    def sudden(self, step: int) -> None:
        """It has moved by itself since the last look; a crack that goes on is one with what came before."""
        if self.going_on:
            self.events.pop()
        grown = self._energies(self._densities()) - self._energies(self.densities)
        contact = int(np.argmax(grown)) if grown.max(initial=0.0) > 0.0 else -1
        self.events.append(Event(self.step, step, self._damped() - self.damped, contact))
        self.going_on = True

    def anything_dissipated(self) -> bool:
        """Whether any contact has dissipated energy so far."""
        return bool(self.densities.any())

    def _densities(self) -> np.ndarray:
        """(C, 3) J/m2 that each contact has dissipated, or (C, 4) with crushing: a copy."""
        dissipated = self.model.state.dissipated
        return np.zeros((0, 3)) if dissipated is None else self.crushing.densities(dissipated)

    def _energies(self, densities: np.ndarray) -> np.ndarray:
        """(C,) J."""
        return np.asarray(self.model.joints.area[: len(densities)] * sum(densities.T))

    def _damped(self) -> float:
        """J that damping has taken from all bodies."""
        return -sum(float(body.work[:, 1].sum()) for body in self.model.bodies if body is not None)

    def state(self) -> State:
        """All of it."""
        events = np.array(self.events, dtype=float).reshape(-1, 4)
        return {
            "events": events,
            "going_on": self.going_on,
            "step": self.step,
            "densities": self.densities,
            "damped": self.damped,
        }

    def restore(self, state: State) -> None:
        """Go on from there."""
        self.events = [Event(int(a), int(b), c, int(d)) for a, b, c, d in state["events"].tolist()]
        self.going_on, self.step = state["going_on"], state["step"]
        self.densities, self.damped = state["densities"], state["damped"]


def table(model: Model, events: list[Event], rows: dict[str, np.ndarray], least: float) -> list[dict[str, Any]]:
    """For the summary: the sudden cracks that released more than `least` (J), in the order in which they came."""
    last = len(rows["step"]) - 1
    return [
        {
            "displacement_m": float(rows["displacement"][min(int(np.searchsorted(rows["step"], event.last)), last)]),
            "released_j": event.released,
            "first_step": event.first,
            "last_step": event.last,
            "place": model.contact(event.contact) if event.contact >= 0 else "",
        }
        for event in events
        if event.released > least
    ]
