"""Error bars of `masonry converge` on random scenes, beside a truth by brute force.

    .venv/bin/python -m verification.studies.error_bars.beside_truth [--seeds 0-2] [--kinds KIND,KIND] [--out FILE]

Of each scene all settings are made at least four times as fine as the finest that its error bar comes from (tets twice
as fine). A line a number: whether the bar holds that value, the error told and the real one, and what all runs took
over the scene itself. With `--out` each number stands in a file, with what each run said and what the scene's own run
measured of each doubt; the same command goes on where it was stopped.
"""

import argparse
import json
import sys
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any

from masonry.errors import SceneError, nearest
from masonry.runtime.folders.own_files import RUNS
from masonry.runtime.tables import columns
from masonry.scene import Scene, changed
from masonry.sweeps.convergence.convergence import Convergence, converge
from masonry.sweeps.convergence.refinement.analyses import RefinedAnalysis, analysis_of
from masonry.sweeps.convergence.refinement.answers import value_of
from masonry.sweeps.convergence.refinement.campaign import TOGETHER, Campaign, merged
from masonry.sweeps.convergence.refinement.edge_points import STRENGTHS, unresolved
from masonry.sweeps.engine import run_alone
from masonry.sweeps.work import OK
from verification.studies.error_bars.compared import VISIBLE, Compared, append, compared_of, lines_of
from verification.studies.error_bars.measured_doubts import indicators_of
from verification.studies.error_bars.random_scenes import KINDS, OF, scene_of

BEYOND = 4.0
"""Times as fine as the finest run of the bar is what counts as truth; of tets the square root."""
SLOWEST = 5.0
"""Seconds that a truth is forecast to take, beyond which what moved nothing is left as fine as it was made."""
NOTHING = 1e-6
"""Relative change that is none."""


def truth_settings(scene: Scene, result: Convergence, analysis: RefinedAnalysis) -> dict[str, Any]:
    """Settings of the truth: BEYOND as fine as the finest run of each, and the interval of a load factor as much
    narrower."""
    everything = _settings(scene, result, analysis, {trial.name for trial, _ in result.runs})
    if analysis.size(changed(scene, everything)).seconds <= SLOWEST:
        return everything
    moved = {
        name for error in result.errors for name, part in error.parts.items() if abs(part) > NOTHING * abs(error.value)
    }
    return _settings(scene, result, analysis, moved)


def _settings(scene: Scene, result: Convergence, analysis: RefinedAnalysis, refined: Collection[str]) -> dict[str, Any]:
    finest = {trial.name: trial.factor for trial, _ in result.runs if trial.name != TOGETHER and trial.factor > 1.0}
    accuracy = None if scene.limit is None else scene.limit.accuracy
    settings: dict[str, Any] = {"limit.accuracy": accuracy / BEYOND} if isinstance(accuracy, float) else {}
    for resolution in Campaign(scene, analysis=analysis).resolutions:
        factor = finest.get(resolution.name, 1.0)
        if resolution.name in refined:
            factor *= BEYOND if resolution.factors[0] > 1.0 else BEYOND**0.5
        while factor > 1.0 and (finer := resolution.settings(factor)) is None:
            factor /= 2.0
        if factor > 1.0 and finer is not None:
            settings = merged(settings, finer)
    return settings


def compare(kind: str, seed: int, folder: Path) -> Iterator[Compared]:
    """Each number of a scene, and its truth."""
    scene, of = scene_of(kind, seed), OF.get(kind, [])
    analysis = analysis_of(of)
    result = converge(scene, folder, of, workers=0)
    base = result.runs[0][1]
    if not result.has_come_to_its_end:
        raise SceneError(base["reason"])
    settings = truth_settings(scene, result, analysis)
    (row,) = run_alone([analysis.job(scene, settings, "truth")], folder, 0)
    if row["status"] != OK:
        raise SceneError(f"its truth: {row['reason']}")
    (truth,), blind = analysis.measured([row], base, folder), unresolved(result.runs)
    indicators = () if kind in OF else indicators_of(folder / RUNS / base["key"])
    seconds = [row["seconds_processor_run"] for _, row in result.runs if row["status"] == OK]
    for error in result.errors:
        value = value_of(truth, error.answer)
        if value is not None and error.value:
            runs = tuple((t, known) for t, row in result.runs if (known := value_of(row, error.answer)) is not None)
            cost, both = sum(seconds[1:]) / seconds[0], (seconds[0], row["seconds_processor_run"])
            unseen = blind if error.answer.key in STRENGTHS else {}
            yield Compared(
                kind, seed, error.answer, value, cost, both, runs, settings, base["verdict"] or "", indicators, unseen
            )


def main() -> None:
    """The table, and how many bars hold."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--seeds", default="0-2", help="first and last")
    words.add_argument("--kinds", help="with commas (default: all)")
    words.add_argument("--out", type=Path, help="a file of a line a number; scenes that stand in it are not run again")
    words.add_argument("--no-runs", action="store_true", help="only scenes of --out, by the rules of today")
    chosen = words.parse_args()
    first, last = map(int, chosen.seeds.split("-"))
    kinds = chosen.kinds.split(",") if chosen.kinds else list(KINDS)
    if unknown := [kind for kind in kinds if kind not in KINDS]:
        words.error(f"--kinds {unknown[0]}: {nearest(unknown[0], KINDS)}")
    print(f"     {'kind':<34}{'seed':>4}  {'number':<22}{'told %':>10}{'bar %':>10}{'real %':>10}{'cost':>7}")
    rows: list[Compared] = []
    scenes = [(kind, seed) for seed in range(first, last + 1) for kind in kinds]
    for kind, seed in scenes:
        for row in numbers_of(kind, seed, chosen.out, chosen.no_runs):
            rows.append(row)
            print(row, flush=True)
    print(summary(rows) if rows else "no number")


def numbers_of(kind: str, seed: int, out: Path | None = None, is_done: bool = False) -> list[Compared]:
    """Its numbers, from the file, or run and written there."""
    lines = [line for line in lines_of(out) if (line["kind"], line["seed"]) == (kind, seed)] if out else []
    if lines or is_done:
        return [compared_of(line) for line in lines if "failed" not in line]
    with TemporaryDirectory() as folder:
        try:
            rows = list(compare(kind, seed, Path(folder) / "runs"))
        except SceneError as error:
            print(f"     {kind} {seed}: {error}"[:160], file=sys.stderr, flush=True)
            append(out, [json.dumps({"kind": kind, "seed": seed, "failed": str(error)}) + "\n"])
            return []
    append(out, [row.as_line() for row in rows])
    return rows


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
