"""How far from rest the specimen is after the settling, and at the end."""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.results.summary import Rest, Restless
from masonry.timeloop.recording import Outcome


def rest(assembly: Assembly, outcome: Outcome) -> Rest:
    """Of all blocks together, and of the one that is farthest from rest, on its own scales; nothing where nothing need
    be at rest."""
    observed, loads = outcome.observed, assembly.recording.surroundings.loads
    settles = bool(loads) and (not assembly.scene.is_large or assembly.plan.settle > 0)
    return Rest(
        unbalanced_after_settling=float(observed["unbalanced"][-1]) if settles else None,
        kinetic_after_settling=float(observed["still_moving"][-1]) if settles else None,
        unrest_after_settling=_after_settling(assembly, outcome) if settles else None,
        moving_at_end=_at_end(assembly, outcome),
        swing_too_wide=_too_wide(observed.get("swing_in_a_step")),
    )


def _after_settling(assembly: Assembly, outcome: Outcome) -> Restless | None:
    """The most of any block, and the one that is farthest from rest; None where the sums over all are far from it."""
    unbalanced, kinetic, block = (
        float(outcome.observed[name][-1]) for name in ("of_a_block", "energy_of_a_block", "block")
    )
    if unbalanced < 0.0:
        return None
    return Restless(int(block), _place(assembly, int(block)), unbalanced, kinetic)


def _at_end(assembly: Assembly, outcome: Outcome) -> Restless | None:
    """The block that moves most."""
    moving = outcome.found.get("moving_at_end")
    return None if moving is None else Restless(moving[0], _place(assembly, moving[0]), kinetic=moving[1])


def _too_wide(in_a_step: np.ndarray | None) -> float | None:
    """Share by which swings come out too wide that go so far in a step, (w dt)^2: a velocity that is given counts for
    the middle of a step."""
    return None if in_a_step is None else float(in_a_step[-1]) / 8.0


def _place(assembly: Assembly, block: int) -> list[float]:
    """m, where a block was made."""
    return list(assembly.model.layout.centroid[block].tolist())
