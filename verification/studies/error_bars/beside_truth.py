"""Error bars of `masonry converge` on random scenes, beside a truth by brute force.

    .venv/bin/python -m verification.studies.error_bars.beside_truth [--seeds 0-2] [--kinds couplet,wallette]

Of each scene all settings that matter are made at least four times as fine as the finest that its error bar comes from
(tets twice as fine). A line a number: whether the bar holds that value, the error told and the real one, the bar over
the real error, and what all runs took over the scene itself.
"""

import argparse
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

from masonry.errors import SceneError, nearest
from masonry.runtime.tables import columns
from masonry.scene import Scene
from masonry.sweeps.convergence.answers import value_of, with_derived
from masonry.sweeps.convergence.campaign import TOGETHER, merged
from masonry.sweeps.convergence.convergence import Convergence, converge
from masonry.sweeps.convergence.resolutions import resolutions_of
from masonry.sweeps.engine import run_alone
from masonry.sweeps.job import Job
from masonry.sweeps.work import OK
from verification.studies.error_bars.random_scenes import KINDS, scene_of

VISIBLE = 1e-5
"""Relative error from which on a bar is compared with it."""
BEYOND = 4.0
"""Times as fine as the finest run of the bar is what counts as truth; of tets the square root."""


@dataclass(frozen=True)
class Compared:
    """One number of one scene, relative to its value: the error told, its bar, and the real error."""

    kind: str
    seed: int
    words: str
    stated: float
    half_width: float
    real: float
    cost: float

    @property
    def holds(self) -> bool:
        """Whether the bar holds the truth, rounding apart."""
        return abs(self.real - self.stated) <= self.half_width + 1e-6

    def __str__(self) -> str:
        mark = "     " if self.holds else "MISS "
        numbers = "".join(f"{100 * x:10.3f}" for x in (self.stated, self.half_width, self.real))
        return f"{mark}{self.kind:<34}{self.seed:>4}  {self.words:<22}{numbers}{self.cost:7.1f}"


def truth_settings(scene: Scene, result: Convergence) -> dict[str, object]:
    """Settings of the truth: what moved a number BEYOND what it was made; the rest as fine as it was made."""
    moved = {name for error in result.errors for name, part in error.parts.items() if part}
    finest = {trial.name: trial.factor for trial, _ in result.runs if trial.name != TOGETHER and trial.factor > 1.0}
    settings: dict[str, object] = {}
    for resolution in resolutions_of(scene):
        factor = finest.get(resolution.name, 1.0)
        if resolution.name in moved:
            factor *= BEYOND if resolution.factors[0] > 1.0 else BEYOND**0.5
        while factor > 1.0 and (finer := resolution.settings(factor)) is None:
            factor /= 2.0
        if factor > 1.0 and finer is not None:
            settings = merged(settings, finer)
    return settings


def compare(kind: str, seed: int, folder: Path) -> Iterator[Compared]:
    """Each number of a scene, and its truth."""
    scene = scene_of(kind, seed)
    result = converge(scene, folder, workers=0)
    if not result.has_come_to_its_end:
        raise SceneError(f"{kind} {seed}: {result.runs[0][1]['reason']}")
    (row,) = run_alone([Job(scene, truth_settings(scene, result))], folder, 0)
    if row["status"] != OK:
        raise SceneError(f"{kind} {seed}: its truth: {row['reason']}")
    truth = with_derived(row, folder)
    seconds = [row["seconds_processor_run"] for _, row in result.runs if row["status"] == OK]
    for error in result.errors:
        value = value_of(truth, error.answer)
        if value is not None and error.value:
            size, real = abs(error.value), error.value - value.number - value.interval
            numbers = error.error / size, error.half_width / size, real / size
            yield Compared(kind, seed, error.answer.words, *numbers, sum(seconds[1:]) / seconds[0])


def main() -> None:
    """The table, and how many bars hold."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--seeds", default="0-2", help="first and last")
    words.add_argument("--kinds", help="with commas (default: all)")
    chosen = words.parse_args()
    first, last = map(int, chosen.seeds.split("-"))
    kinds = chosen.kinds.split(",") if chosen.kinds else list(KINDS)
    if unknown := [kind for kind in kinds if kind not in KINDS]:
        words.error(f"--kinds {unknown[0]}: {nearest(unknown[0], KINDS)}")
    print(f"     {'kind':<34}{'seed':>4}  {'number':<22}{'told %':>10}{'bar %':>10}{'real %':>10}{'cost':>7}")
    rows: list[Compared] = []
    for kind in kinds:
        for seed in range(first, last + 1):
            with TemporaryDirectory() as folder:
                try:
                    for row in compare(kind, seed, Path(folder) / "runs"):
                        rows.append(row)
                        print(row, flush=True)
                except SceneError as error:
                    print(f"     {error}"[:160], file=sys.stderr, flush=True)
    print(summary(rows))


def summary(rows: Sequence[Compared]) -> str:
    """By kind and in all: how many bars hold, of all numbers and of the first of each scene, how wide they are in the
    middle beside the real error, and what they cost."""
    kinds = [[row for row in rows if row.kind == kind] for kind in dict.fromkeys(row.kind for row in rows)]
    heads = ["kind", "numbers", "held", "first numbers", "held", "bar over real error", "cost"]
    return "\n".join(columns([heads, *(_of(of_kind, of_kind[0].kind) for of_kind in kinds), _of(rows, "all")]))


def _of(rows: Sequence[Compared], kind: str) -> list[str]:
    first = [
        row for k, row in enumerate(rows) if k == 0 or (rows[k - 1].kind, rows[k - 1].seed) != (row.kind, row.seed)
    ]
    wide = [row.half_width / abs(row.real) for row in rows if abs(row.real) > VISIBLE]
    counts = [len(rows), sum(row.holds for row in rows), len(first), sum(row.holds for row in first)]
    middle = f"{median(wide):.2g}" if wide else "-"
    return [kind, *map(str, counts), middle, f"{median(row.cost for row in first):.2g}"]


if __name__ == "__main__":
    main()
