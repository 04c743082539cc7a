"""Outcome of a load that grew, and of the branch behind its collapse."""

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from masonry.loading.collapse.catching import CaughtFall
from masonry.loading.collapse.factor_path import FactorPath
from masonry.loading.loading import LoadingOutcome, Rows
from masonry.rows.columns import FACTOR

MOVING = 0.05
"""Of the block that moves most: from which on a block belongs to the mechanism."""


@dataclass(frozen=True)
class BranchOutcome:
    """How a branch went, in SI; up to the reading `near_to_m` all rows are as near to equilibrium as the accuracy
    asks."""

    gauge: str
    until_m: float
    ends: str
    led: bool
    from_m: float
    steps: int
    leaps: int
    out_of_balance_max: float
    near_to_m: float

    def summary(self, rows: Rows) -> dict[str, Any]:
        """All of it, where the rows end, and the largest factor behind the collapse."""
        factors = rows[FACTOR][rows["step"] > rows["step"][-1] - self.steps]
        return asdict(self) | {
            "reached_m": float(rows[self.gauge][-1]),
            "factor_at_end": float(rows[FACTOR][-1]),
            "factor_max": float(factors.max(initial=0.0)),
        }


@dataclass(frozen=True, kw_only=True)
class CollapseOutcome(LoadingOutcome):
    """The factor of a load that grew: the greatest that was borne, the least that was not, and how they were found.

    undecided         trials that neither came to rest nor fell in the time that they had
    falls_by_turning  whether the least factor that was not borne turned a block too far, and no more is known
    swayed            over the smallest block: the most that anything had moved at the last rest
    freely            whether blocks turn as far as they like
    mechanism         (B,) how far each block moved at the end, over the one that moved most
    branch            what became of the gauge that was to be led on behind the collapse; None without one
    travel            m, after which what has not come to rest has fallen     caught  falls that came to rest before
    later             m, the travel after which a slack bar would have borne the last fall; None: none
    """

    pattern: str
    path: FactorPath
    loops_over: str | None
    borne: float
    falls: float | None
    trials: int
    leg: int
    undecided: int
    falls_by_turning: bool
    swayed: float
    freely: bool
    mechanism: np.ndarray
    branch: BranchOutcome | None
    travel: float
    caught: tuple[CaughtFall, ...]
    later: float | None

    def control(self) -> dict[str, float]:
        """The interval, and how it was found; `factor_falls` is missing where nothing fell."""
        return {
            "accuracy": self.path.accuracy,
            "factor": self.borne,
            "trials": self.trials,
            "leg": self.leg,
            **({} if self.falls is None else {"factor_falls": self.falls}),
            "undecided": self.undecided,
            "falls_by_turning": float(self.falls_by_turning),
            "swayed": self.swayed,
        }

    def collapse_load(self, rows: Rows, sets: dict[str, np.ndarray]) -> dict[str, Any]:
        """The factors, and who moves then."""
        first = int(self.mechanism.argmax())
        loops = {"gauge": self.loops_over, "history": list(self.path.reversals), "leg": self.leg}
        return {
            "pattern": self.pattern,
            "borne": self.borne,
            "falls": self.falls,
            "accuracy": self.path.accuracy,
            "trials": self.trials,
            "undecided": self.undecided,
            "falls_by_turning": self.falls_by_turning,
            "swayed_over_block": None if self.freely else self.swayed,
            "moving": int((self.mechanism > MOVING).sum()),
            "first": first,
            "sets": sorted(name for name, members in sets.items() if first in members),
            "moved": self.mechanism.tolist(),
            "travel_m": self.travel,
            "moves_from": self.caught[0].borne if self.caught else None,
            "caught": [fall._asdict() for fall in self.caught],
            "later_m": self.later,
            **({} if self.branch is None else {"branch": self.branch.summary(rows)}),
            **({"loops": loops} if self.path.reversals else {}),
        }
