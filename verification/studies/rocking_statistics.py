"""Rocking as statistics: blocks on shaken ground against Housner's equation, integrated on its own.

A history that comes near to falling is chaotic: another restitution in its fourth digit gives another one. So counts
and distributions are compared, over motions that are made by seed, and the restitution is the one that a run of each
block measures, which is let go and rocks freely. It is worth 1 %, so the count of those that fall and the median are
held against those of integrations with up to 1 % less and more besides. Of 0.4 x 1.2 m at 0.5 g, seed 2 leans by 0.469
alpha with the restitution that was measured, by 0.032 with 1 % more or less, and by 0.032 again where the same
integration is less exact by 100 times; at 0.64 g 33 of 40 fall by one integration, 31 and 34 with 0.5 % more and less.
"""

from collections.abc import Callable, Sequence
from contextlib import closing
from typing import Any, NamedTuple

import numpy as np

from masonry.runtime.processes import Lost, work
from masonry.runtime.processors import processors
from masonry.scene.tables.dynamics.made_record import MadeGround
from verification.html import page
from verification.references.rocking import RockingBlock, rock
from verification.scene_runs import FOLDER, result_of

ORDER = 70
SCENE = str(FOLDER / "block-on-shaken-ground.toml")
DEPTH, LEAST_ANGLE = 0.5, 1e-3
"""m; the share of alpha below which a block has hardly lifted off: there springs matter, and peaks are called alike."""
MOTION = {"spectrum": "clough-penzien", "duration": "10 s", "soil_period": "0.8 s"}
BEGIN, UNTIL = 0.2, 13.0
"""s: after what time the ground moves, while the block sits down on its springs; until when it is looked at."""
COUNTS, MEDIAN, DISTANCE = 2, 0.10, 0.15
"""What may differ: blocks that fall, of 40; the median peak, as a share; the distributions (Kolmogorov, Smirnov)."""
SHARES = (1.0, 0.99, 0.995, 1.005, 1.01)
"""Of the measured restitution, by what that is worth: each is integrated."""


class Block(NamedTuple):
    """Width and height (m), and the peaks of the motions (g)."""

    width: float
    height: float
    peaks: tuple[float, ...]


BLOCKS = (Block(0.25, 1.0, (0.32, 0.37, 0.42)), Block(0.5, 2.0, (0.4, 0.5, 0.6)), Block(0.4, 1.2, (0.5, 0.57, 0.64)))
MOTIONS = 40


class Trial(NamedTuple):
    """A block on a motion of a seed, its peak (g), and the restitution (of the independent integration)."""

    block: Block
    peak: float
    seed: int
    restitution: float


class Peaks(NamedTuple):
    """The largest angles of a trial, in alpha, inf where the block fell: of the run, and of integrations by SHARES."""

    run: float
    integrated: tuple[float, ...]


def settings_of(block: Block) -> dict[str, Any]:
    """The keys of the scene that make it this block."""
    return {
        "specimen.box": [
            {
                "name": "block",
                "origin": [f"{-block.width} m", "0 m", "0 m"],
                "size": [f"{block.width} m", f"{DEPTH} m", f"{block.height} m"],
            }
        ]
    }


def alone(block: Block, restitution: float = 1.0) -> RockingBlock:
    """The same block for the integration."""
    return RockingBlock(0.5 * block.width, 0.5 * block.height, restitution)


def measured_restitution(block: Block) -> float:
    """The share of its spin that a block keeps as it rocks freely: the mean of its first four impacts."""
    form = alone(block)
    turned = {"about": "y", "angle": f"{0.5 * form.alpha!r} rad"}
    times = rock(alone(block, form.of_housner), np.linspace(0, 1, 101), np.zeros(101), 20.0, 0.5 * form.alpha).impacts
    ends = {"specimen.turned": turned, "ground": (), "solver.duration": f"{times[4]} s"}
    rows = result_of(SCENE, settings_of(block) | ends).history.rows
    mass = 2000.0 * block.width * DEPTH * block.height
    lean = np.hypot(form.half_width, form.half_height) * (np.cos(0.5 * form.alpha) - np.cos(form.alpha))
    energy = rows["kinetic"] - rows["external_work"] + mass * form.g * lean
    between = [0.5 * times[0], *(0.5 * (times[:4] + times[1:5]))]
    swings = np.interp(between, rows["time"], energy)
    return float(np.sqrt(swings[1:] / swings[:-1]).mean())


def compare(trial: Trial) -> Peaks:
    """The peaks of one trial."""
    block, form = trial.block, alone(trial.block, trial.restitution)
    made = MOTION | {"peak": f"{trial.peak} g", "seed": trial.seed}
    ground = {"x": "first", "begin": f"{BEGIN} s", "made": made}
    result = result_of(SCENE, settings_of(block) | {"ground": ground, "solver.duration": f"{BEGIN + UNTIL} s"})
    run = _angle(form, float(np.abs(result.history.rows["sway"]).max()))
    record = MadeGround.model_validate(made).record()
    forms = [alone(block, fraction * trial.restitution) for fraction in SHARES]
    integrated = (rock(form, record.time, record.acceleration, UNTIL).peak for form in forms)
    return Peaks(_in_alpha(run, form), tuple(_in_alpha(angle, form) for angle in integrated))


def _angle(form: RockingBlock, sway: float) -> float:
    """rad, of a block whose middle has moved sideways by `sway` as it turned about a corner."""
    return form.alpha - float(
        np.arcsin(max(-1.0, np.sin(form.alpha) - sway / np.hypot(form.half_width, form.half_height)))
    )


def _in_alpha(angle: float, form: RockingBlock) -> float:
    """It fell where it leans by far more than its balance; a block that comes back has not gone beyond 1.5 alpha."""
    return np.inf if angle > 1.5 * form.alpha else angle / form.alpha


class Statistics(NamedTuple):
    """How many fell, and the medians (alpha): of the runs, and of the integrations by SHARES; the distance of the
    distributions of runs and of integrations with the restitution as it was measured."""

    fell: tuple[int, ...]
    medians: tuple[float, ...]
    distance: float

    @property
    def more_fell(self) -> int:
        """How many more or fewer of the runs than of all integrations; 0 where the count lies between theirs."""
        run, *integrated = self.fell
        return max(run - max(integrated), min(integrated) - run, 0)

    @property
    def median_off(self) -> float:
        """Of the runs, as a share, beyond those of all integrations; 0 where it lies between them."""
        run, *integrated = self.medians
        minimum, maximum = min(integrated), max(integrated)
        return 0.0 if minimum <= run <= maximum else abs(run / min(max(run, minimum), maximum) - 1.0)

    def holds(self, trials: int) -> bool:
        """Whether they are alike within what was stated for MOTIONS trials; of fewer the median says little."""
        near = self.more_fell <= COUNTS and self.distance < DISTANCE * np.sqrt(MOTIONS / trials)
        return near and (trials < MOTIONS or self.median_off <= MEDIAN)


def statistics_of(peaks: Sequence[Peaks]) -> Statistics:
    """Of the trials of one block and one size of motion."""
    angles = np.maximum(np.array([(trial.run, *trial.integrated) for trial in peaks]), LEAST_ANGLE).T
    at = np.unique(angles[:2])
    runs, integrated = (np.searchsorted(np.sort(sample), at, side="right") / len(sample) for sample in angles[:2])
    fell = tuple(int(np.isinf(sample).sum()) for sample in angles)
    medians = tuple(float(np.quantile(sample, 0.5, method="lower")) for sample in angles)
    return Statistics(fell, medians, float(np.abs(runs - integrated).max()))


def chapter(tell: Callable[[str], None], quick: bool = False) -> page.Chapter:
    """All blocks, peaks and motions; quick: ten motions of one peak on one block."""
    made = page.Chapter("Rocking as statistics")
    blocks, motions = (BLOCKS[:1], 10) if quick else (BLOCKS, MOTIONS)
    rows, holds = [], []
    for block in blocks:
        restitution = measured_restitution(block)
        for peak in block.peaks[1:2] if quick else block.peaks:
            tell(f"rocking as statistics: {block.width} x {block.height} m, {peak} g")
            trials = [Trial(block, peak, seed, restitution) for seed in range(1, motions + 1)]
            statistics = statistics_of(all_of(trials))
            holds.append(statistics.holds(motions))
            rows.append(_row(block, peak, restitution, statistics, motions, holds[-1]))
    made.add(__doc__.partition("\n\n")[2], page.table(HEADER, rows))
    made.judge(
        "Rocking as statistics",
        "ok" if all(holds) else "bad",
        f"{sum(holds)} of {len(holds)} sets of {motions} motions agree with Housner's equation: blocks that fall "
        f"within {COUNTS} of {MOTIONS}, the median within {page.percent(MEDIAN)}, the distributions within {DISTANCE}.",
    )
    return made


HEADER = [
    "block",
    "peak",
    "restitution measured",
    "fell: run, integrated (restitution within 1 %)",
    "median in alpha (likewise)",
    "distance",
    "",
]


def _row(block: Block, peak: float, restitution: float, statistics: Statistics, motions: int, holds: bool) -> list[Any]:
    fell, medians = statistics.fell, statistics.medians
    return [
        f"{block.width} x {block.height} m",
        f"{peak} g",
        f"{restitution:.4f}",
        f"{fell[0]}, {fell[1]} ({min(fell[1:])} to {max(fell[1:])}) of {motions}",
        f"{medians[0]:.3f}, {medians[1]:.3f} ({min(medians[1:]):.3f} to {max(medians[1:]):.3f})",
        f"{statistics.distance:.3f}",
        page.judged("agrees" if holds else "differs", "ok" if holds else "bad"),
    ]


def all_of(trials: Sequence[Trial]) -> list[Peaks]:
    """Their peaks, several at once. Raises RuntimeError where a process dies."""
    done: dict[int, Peaks] = {}
    with closing(work(compare, trials, processors())) as ends:
        for number, end in ends:
            if isinstance(end, Lost):
                raise RuntimeError(f"trial {number}: {end.reason}")
            done[number] = end
    return [done[number] for number in range(len(trials))]
