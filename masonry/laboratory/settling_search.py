"""Where a scene does not say how long its dead loads settle: found before the run, and written into the scene."""

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

from masonry.assembly.assemble import Assembly
from masonry.assembly.schedule import FEWEST, plan_of
from masonry.configuration import model_state
from masonry.errors import Stopped
from masonry.rows.history import History
from masonry.rows.rest_criterion import SETTLED
from masonry.scene import Scene
from masonry.scene.tables.loads_and_supports import Settle
from masonry.timeloop.loop import Loop
from masonry.timeloop.run_outcome import Outcome

LONGEST = 128_000
"""Steps of the last trial."""
ROWS = 50
"""Looks at a trial."""

Progress = Callable[[int, int, str], None]


def settled(assembly: Assembly, threads: int, progress: Progress | None, is_to_end: Callable[[], bool]) -> Assembly:
    """The assembly of the scene with the number of steps that its dead loads need; its model is as before.

    They are tried alone in 2000, 4000, ... steps, of a step that is compiled. Raises Stopped where they do not come to
    rest, or move the specimen out of bounds in two trials on end; KeyboardInterrupt as soon as `is_to_end` says so.
    """
    model, steps, failure_before = assembly.model, FEWEST, ""
    fresh = model_state.state(model)
    model.damping = assembly.plan.settling_damping(model.damping)
    while True:
        failure, left = _trial(assembly, steps, threads, progress, is_to_end)
        model_state.restore(model, fresh)
        if not failure and left.all_rest:
            scene = with_settle(assembly.scene, steps)
            return replace(assembly, scene=scene, plan=plan_of(scene, model.dt))
        if failure and failure_before:
            raise Stopped(f"the dead loads move the specimen away: {failure}; {ADVICE}")
        if steps >= LONGEST:
            why = failure or left.text
            raise Stopped(f"the dead loads have not come to rest in {steps} steps: {why}; {ADVICE}")
        steps, failure_before = 2 * steps, failure


ADVICE = (
    "look at supports, strengths and solver.damping: can the specimen stand under them? To see how it moves, run it "
    f"with --set settle.steps={FEWEST}"
)


class Left(NamedTuple):
    """The most of the last looks at a trial: unbalanced force over the dead loads, and kinetic over stored energy; the
    same of one block, on its own scales; and the block (its number) that is farthest from rest."""

    unbalanced: float = 0.0
    still_moving: float = 0.0
    of_a_block: float = 0.0
    energy_of_a_block: float = 0.0
    block: float = 0.0

    @property
    def sum_rests(self) -> bool:
        return SETTLED.holds(self.unbalanced, self.still_moving)

    @property
    def all_rest(self) -> bool:
        """Whether all together are at rest, and each block."""
        return self.sum_rests and SETTLED.of_block.holds(self.of_a_block, self.energy_of_a_block)

    @property
    def text(self) -> str:
        """Unbalance and motion that are left, and how much may be."""
        if self.sum_rests:
            block = SETTLED.of_block
            return (
                f"of what block {self.block:.0f} bears {self.of_a_block:.2g} is still unbalanced (should be under "
                f"{block.force:g}), and its kinetic energy is {self.energy_of_a_block:.2g} of what it stores "
                f"(should be under {block.energy:g})"
            )
        return (
            f"{self.unbalanced:.2g} of them are still unbalanced (should be under {SETTLED.force:g}), and the kinetic "
            f"energy is {self.still_moving:.2g} of the stored (should be under {SETTLED.energy:g})"
        )


def with_settle(scene: Scene, steps: int) -> Scene:
    """The scene with a number of steps in which its dead loads settle."""
    return scene.model_copy(update={"settle": Settle(steps=steps)})


def _trial(
    assembly: Assembly, steps: int, threads: int, progress: Progress | None, is_to_end: Callable[[], bool]
) -> tuple[str, Left]:
    """The dead loads alone, in so many steps. Returns why they had to be ended, nothing where they came to their end;
    and what is left of the motion."""
    model, plan = assembly.model, plan_of(with_settle(assembly.scene, steps), assembly.model.dt)
    loading, recording = plan.settling().loading(model, ROWS), replace(assembly.recording, frames=1)
    loop = Loop(model, loading, steps, recording, threads, Outcome(History()))

    def look(now: int, whole: int, words: str) -> None:
        if is_to_end():
            raise KeyboardInterrupt
        if progress is not None:
            progress(0, 0, f"settling, trial of {steps} steps: {words}")

    try:
        loop.run(look, None)
    except Stopped as stop:
        return str(stop), Left()
    most = {name: max(loop.observed[name][-SETTLED.looks :]) for name in Left._fields}
    return "", Left(**most | {"block": loop.observed["block"][-1]})
