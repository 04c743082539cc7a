"""A plan that no scene asks for: whoever adds one writes its plan and its loading, and nobody else asks which it is."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.configuration.chunk import Chunk
from masonry.estimates.inspection import Inspection
from masonry.laboratory.cost import expected
from masonry.laboratory.summary.run_summary import summarise
from masonry.loading.loading import Expected, Loading
from masonry.loading.plan import PacedPlan
from masonry.loading.varying_loads import SharedLoads
from masonry.rows.columns import FACTOR
from masonry.timeloop import timeloop
from tests.loading.test_growing import block

LOOK, RISE, STAY = 50, 10, 60
"""Steps between two looks; looks in which a stage rises and stays."""


@dataclass(frozen=True)
class Staged(PacedPlan):
    """Factors, one after the other."""

    factors: tuple[float, ...]
    varies = 1

    def expected(self, model, rows, axis) -> Expected:
        looks = (RISE + STAY) * len(self.factors)
        return Expected(self.settle + LOOK * looks, looks)

    def loading(self, model, rows, gauges=()) -> Loading:
        return StagedLoading(model, self, rows)


class StagedLoading(Loading):
    """Stage by stage."""

    REMEMBERED = ("looks", "factor")

    def __init__(self, model, plan, rows) -> None:
        self.settling, self.plan, self.loads = plan.settling().loading(model, rows), plan, SharedLoads(model)
        self.looks, self.factor = 0, 0.0

    def next(self) -> Chunk | None:
        if (settling := self.settling.next()) is not None:
            return settling
        stage, look = divmod(self.looks, RISE + STAY)
        if stage == len(self.plan.factors):
            return None
        before, after = (0.0, *self.plan.factors)[stage : stage + 2]
        factor = before + min((look + 1) / RISE, 1.0) * (after - before)
        varying = self.loads.pass_over(np.array([self.factor]), np.array([factor]), LOOK)
        self.looks, self.factor = self.looks + 1, factor
        return Chunk(self.plan.dead_load[-1] + varying, np.zeros(LOOK + 1), True)

    def load_factors(self):
        return np.array([self.factor])

    def columns(self):
        return {FACTOR: self.factor}

    def progress(self):
        return self.looks, (RISE + STAY) * len(self.plan.factors)

    def parts(self):
        return {"settling": self.settling}


@pytest.fixture(scope="module")
def assembly():
    """A block that slides under 0.4 of its weight."""
    built = assemble(block(0.1, 0.05, 0.4, 'pattern = "weight"\ndirection = "x"', settle__steps=2000))
    return replace(built, plan=Staged(built.plan.dead_load, factors=(0.1, 0.3)))


def test_a_load_is_raised_stage_by_stage_and_all_that_is_said_of_a_run_is_said_of_this_one(assembly):
    outcome = timeloop.run(assembly.model, assembly.plan, assembly.recording)
    summary = summarise(assembly, outcome)
    assert outcome.steps == expected(assembly).steps and not outcome.stopped
    assert outcome.history.rows[FACTOR][-1] == 0.3
    assert summary.control == {} and summary.collapse_load is None
    assert Inspection(assembly, outcome).peak == len(outcome.history.frames) - 1
    reaction = outcome.standing["end"].reactions.sum(axis=0)
    assert abs(reaction[0]) == pytest.approx(0.3 * abs(reaction[2]), rel=1e-3)


def test_what_it_remembers_goes_on_as_it_would(assembly):
    one, other = (assembly.plan.loading(assembly.model, 10) for _ in range(2))
    for _ in range(50):
        one.next()
    other.restore(one.state())
    for _ in range(20):
        ahead, resumed = one.next(), other.next()
        assert ahead.dead_load.tobytes() == resumed.dead_load.tobytes() and ahead.row == resumed.row
