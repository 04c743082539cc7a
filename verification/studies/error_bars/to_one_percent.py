"""`masonry converge SCENE --to "1 %"` on packaged scenes, beside a truth by brute force.

    .venv/bin/python -m verification.studies.error_bars.to_one_percent [--scenes couplet,wall-tied] [--to "1 %"]

A line a number: its real error as shipped and with the settings that were chosen, and what the command said of it. Then
a table, a line a scene: the largest real errors of the numbers within reach, and seconds of processor of a run as
shipped, with the chosen settings, and of all runs of the search. The truth has all that moves a number four times as
fine as the chosen settings, or twice where that run is expected to take more than 40 s.
"""

import argparse
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from masonry.laboratory.cost import forecast
from masonry.runtime.tables import columns
from masonry.scene import Scene, changed, load
from masonry.sweeps.convergence.convergence import Convergence, converge
from masonry.sweeps.convergence.refinement.answers import value_of, with_derived
from masonry.sweeps.convergence.refinement.campaign import merged
from masonry.sweeps.convergence.refinement.numerical_errors import NumericalError
from masonry.sweeps.convergence.refinement.resolutions import resolutions_of
from masonry.sweeps.convergence.search.chosen_settings import Settings
from masonry.sweeps.convergence.search.next_settings import narrower
from masonry.sweeps.engine import run_alone
from masonry.sweeps.job import Job
from masonry.sweeps.run_store import Row
from masonry.sweeps.work import OK

SCENES = (
    "couplet",
    "couplet-cyclic",
    "triplet-dry",
    "prism-in-compression",
    "arch-spread",
    "vault-spreading",
    "column-pushed",
    "wall-tied",
    "wall-tilted",
    "house-tilted",
    "wallette-mode-1",
    "wallette-mode-2",
    "diagonal-compression",
    "shear-wall-size",
    "block-rocking",
)
BEYOND, SLOWEST = (4.0, 2.0), 40.0
"""Times as fine as the chosen settings is what counts as truth: the first whose run is expected to be no longer (s)."""
NARROW = 0.004
"""Error that the interval of a load factor of the truth is made for: it is a quarter as wide."""
HEADS = ("scene", "number", "as shipped", "chosen", "allowed", "s as shipped", "s chosen", "s in all", "verdict")


@dataclass(frozen=True)
class Reached:
    """One number: relative real errors as shipped and as chosen, the error that the command allows as chosen, and why
    it is not within reach, "" where it is."""

    words: str
    shipped: float
    chosen: float
    allowed: float
    why: str

    @property
    def sums(self) -> tuple[float, float, float]:
        """Errors in the order of the table."""
        return self.shipped, self.chosen, self.allowed


@dataclass(frozen=True)
class SceneStudy:
    """One scene: its numbers, seconds of processor as shipped, chosen and in all, and the verdict as chosen."""

    scene: str
    numbers: list[Reached]
    seconds: tuple[float, float, float]
    verdict: str

    @property
    def line(self) -> list[str]:
        """Of the table: the number within reach whose real error as shipped is largest."""
        within = [number for number in self.numbers if not number.why] or self.numbers
        worst = max(within, key=lambda number: number.shipped)
        errors = [f"{100 * error:.2g} %" for error in worst.sums]
        return [self.scene, worst.words, *errors, *(f"{seconds:.2g}" for seconds in self.seconds), self.verdict]


def study(name: str, to: str, folder: Path) -> SceneStudy:
    """Choose settings of a packaged scene, and hold its numbers against the truth."""
    scene = load(name)
    result = converge(scene, folder, to=to, workers=0)
    if result.chosen is None:
        raise SceneError(f"{name}: {result.runs[0][1]['reason'] or 'none of its numbers has an error'}")
    best = result.chosen.best
    finest = changed(scene, best.settings)
    (row,) = run_alone([Job(finest, _of_truth(finest, best))], folder, 0)
    if row["status"] != OK:
        raise SceneError(f"{name}: its truth: {row['reason']}")
    truth = with_derived(row, folder)
    numbers = list(_numbers(result, truth))
    runs = {run["key"]: run["seconds_processor_run"] for tried in result.chosen.tried for _, run in tried.runs}
    seconds = result.chosen.tried[0].seconds, best.seconds, sum(runs.values())
    return SceneStudy(name, numbers, seconds, best.verdict)


def _of_truth(scene: Scene, best: Settings) -> dict[str, Any]:
    """Settings of the truth of a scene of the chosen settings."""
    moved = {name for error in best.errors for name, part in error.parts.items() if part}
    fine: dict[str, Any] = {}
    for times in BEYOND:
        fine = narrower(scene, NARROW)
        for resolution in resolutions_of(scene):
            factor = times if resolution.factors[0] > 1.0 else times**0.5
            if resolution.name in moved and (finer := resolution.settings(factor)) is not None:
                fine = merged(fine, finer)
        if forecast(assemble(changed(scene, fine))).seconds[0] <= SLOWEST:
            break
    return fine


def _numbers(result: Convergence, truth: Row) -> Iterator[Reached]:
    assert result.chosen is not None
    shipped = {error.answer.key: error for error in result.errors}
    for error in result.chosen.best.errors:
        value = value_of(truth, error.answer)
        if value is not None and value.number and error.value and error.answer.key in shipped:
            right = value.number + value.interval
            before, after = _real(shipped[error.answer.key], right), _real(error, right)
            why = result.chosen.unreached.get(error.answer.key, "")
            yield Reached(error.answer.words, before, after, error.at_most / abs(error.value), why)


def _real(error: NumericalError, right: float) -> float:
    return abs(error.value - right) / abs(right)


def main() -> None:
    """Lines as they come, and the table."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--scenes", default=",".join(SCENES), help="with commas")
    words.add_argument("--to", default="1 %")
    chosen = words.parse_args()
    studies = []
    for name in chosen.scenes.split(","):
        with TemporaryDirectory() as folder:
            try:
                done = study(name, chosen.to, Path(folder) / "runs")
            except SceneError as error:
                print(f"     {name}: {error}"[:160], file=sys.stderr, flush=True)
                continue
        studies.append(done)
        for number in done.numbers:
            errors = "".join(f"{100 * error:10.3f}" for error in number.sums)
            print(f"{name:<22}{number.words:<24}{errors}  {number.why}", flush=True)
    print("\n".join(columns([HEADS, *(done.line for done in studies)])))


if __name__ == "__main__":
    main()
