"""Is the time step of a shaken run short beside the swings that earthquakes bring about? Steps of dt make a swing of
the angular frequency w too fast by a share of (w dt)^2/24. A wall has blocks on stiff joints, and so steps that are a
thousand times shorter than that; one block on a soft joint has not, and at resonance a shift of 1 % counts.

Asked in large displacement. A run in small displacement measures how fast it swings (`coarse_swings`).
"""

from math import pi

from masonry.assembly.assemble import Assembly
from masonry.judgement.doubt import TIME_STEP, Doubt

FASTEST = 25.0
"""Hz, up to which earthquakes shake."""
LIMIT = 0.01


def doubts(assembly: Assembly) -> list[Doubt]:
    """One at most."""
    share = (2.0 * pi * FASTEST * assembly.model.dt) ** 2 / 24.0
    if not (assembly.scene.ground and assembly.scene.is_large) or share <= LIMIT:
        return []
    sentence = f"steps of {assembly.model.dt:.3g} s make a swing of {FASTEST:g} Hz too fast by {100.0 * share:.2g} %"
    return [Doubt("coarse_shaking", share, LIMIT, sentence, "lower solver.step_fraction", TIME_STEP)]
