"""The end of the settling: other damping acts, and blocks start in motion, or under dead loads that act at once: they
are struck, and the work is booked."""

import numpy as np

from masonry.configuration.configuration import configuration_of
from masonry.configuration.parts.parts import parts_of
from masonry.model.model import Model
from masonry.patches.branches import NO_DASHPOTS


def phases(model: Model) -> tuple[bool, ...]:
    """The phases of a run by whether the dead loads have settled, the first one last, where their damping differs."""
    return (False,) if model.phases is None else (True, False)


def damp(model: Model, settled: bool) -> None:
    """Let act what damps before the end of the settling, or from then on."""
    if model.phases is None:
        return
    model.damping = model.phases.swinging if settled else model.phases.settling
    if model.dashpots is None:
        return
    model.acting = model.dashpots if settled else NO_DASHPOTS
    configuration_of(model).patches.let_fade(model, settled)


def begin_dashpots(model: Model) -> None:
    """The sides of contacts stand where they are as dashpots begin to act."""
    if model.dashpots is not None:
        sides, u = model.contacts.sides, model.contacts.u
        model.dashpots.before[...] = u[sides[:, 1]] - u[sides[:, 0]]


def begin(model: Model, load_factors: np.ndarray | None, loaded: bool) -> None:
    """Set off what starts in motion in a run without settling. Dead loads that act at once (`loaded`) give all that is
    free half a step of themselves, so that velocities are those in the middle of the first step.

    load_factors  (H,) of the loads that vary as the run begins; None without any
    """
    blows = {} if model.motion is None else {kind: blow.copy() for kind, blow in model.motion.items()}
    for part in parts_of(model):
        body, kind = part.body, part.name
        if not loaded or body.load is None:
            continue
        load = body.load.copy()
        for load_factor, varying in zip(() if load_factors is None else load_factors, model.varying, strict=True):
            load += 0.0 if varying[kind] is None else load_factor * varying[kind]
        blows[kind] = blows.get(kind, 0.0) + 0.5 * body.dt_over_mass * load
    _strike(model, blows, [part.body.v.copy() for part in parts_of(model)])


def set_off(model: Model, before: list[np.ndarray]) -> None:
    """Once the dead loads have settled: other damping, and the velocities with which blocks start.

    before  velocities one step earlier, in the order of the bodies that there are
    """
    damp(model, settled=True)
    begin_dashpots(model)
    _strike(model, model.motion or {}, before)


def _strike(model: Model, blows: dict[str, np.ndarray], before: list[np.ndarray]) -> None:
    for part, old in zip(parts_of(model), before, strict=True):
        if (blow := blows.get(part.name)) is not None:
            part.blow(blow, old)
