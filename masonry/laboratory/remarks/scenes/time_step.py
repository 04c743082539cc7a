"""Is the time step below its proven bound? A run above it may be unstable; rounding is let through."""

from masonry.assembly.assemble import Assembly
from masonry.judgement.doubt import Doubt

ROUNDING = 1e-12


def doubts(assembly: Assembly) -> list[Doubt]:
    """One at most."""
    model = assembly.model
    if model.dt <= model.bound * (1 + ROUNDING):
        return []
    sentence = (
        f"the time step {model.dt:.3g} s is above the proven bound {model.bound:.3g} s, and the run may be unstable"
    )
    return [Doubt("time_step", model.dt, model.bound, sentence, "lower solver.time_step or solver.step_fraction")]
