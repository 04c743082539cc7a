"""Doubts that estimate an error of resolution, beside what refinement says of it on random scenes.

    .venv/bin/python -m verification.studies.error_bars.indicators FILE [--seeds 0-3] [--kinds couplet,wallette]

Of each scene its resolutions are made four times as fine, one after the other (tets twice). Seeds above 0 draw how
coarse a scene is as well, as scenes that are fine enough raise no doubt. FILE gets a line of JSON a scene, and what it
has is not run again. The table has a line a doubt: in how many scenes it is asked, hits, misses (silent, and the error
is beyond its limit), false alarms (told, and the error is below half the limit), and the median of the size told over
the real one.
"""

import argparse
import json
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from geometry.blocks import GeometryError
from masonry.assembly.assemble import assemble
from masonry.errors import SceneError, Stopped, nearest
from masonry.estimates.inspection import Inspection
from masonry.judgement.catalogue import criteria
from masonry.judgement.evidence import Evidence
from masonry.laboratory.cost import forecast
from masonry.laboratory.laboratory import result_of
from masonry.laboratory.settling_search import settled
from masonry.runtime.tables import columns
from masonry.scene import Scene, changed
from masonry.sweeps.convergence.refinement.answers import answers_of, value_of, with_derived
from masonry.sweeps.convergence.refinement.campaign import Campaign, merged
from masonry.sweeps.convergence.refinement.resolutions import Resolution
from masonry.sweeps.engine import run_alone
from masonry.sweeps.job import Job
from masonry.sweeps.work import OK
from masonry.timeloop import timeloop
from verification.studies.error_bars.coarse_scenes import COARSE, coarse_scene_of
from verification.studies.error_bars.indicator_sizes import CLAIMS, POINTS, TETS, error_of, sizes_of
from verification.studies.error_bars.random_scenes import KINDS, scene_of

FACTORS = (4.0, 3.0, 2.0)
OF_TETS = (2.0, 1.5)
"""Factors of refinement, of which the first counts that a run may take."""
LONGEST = 12.0
"""Seconds of processor by forecast that a run may take."""
STEPS = "pace"
ALL = (*COARSE, *KINDS)
"""Kinds of scenes, those of the study of error bars last."""


def coarsened(scene: Scene, kind: str, seed: int) -> dict[str, Any]:
    """Settings by which a scene is coarser, by seed; none of seed 0."""
    kinds, settings, number = list(COARSE if kind in COARSE else KINDS), dict[str, Any](), scene.points_per_edge
    draw = np.random.default_rng([seed, kinds.index(kind), 58])
    for resolution in Campaign(scene).resolutions if seed else ():
        factor = float(draw.choice([1.0, 0.5, 0.25, 0.1] if resolution.name == STEPS else [1.0, 0.6, 0.4]))
        steps = round(10.0 ** draw.uniform(2.3, 4.3))
        if resolution.name == STEPS and scene.drive is not None and draw.random() < 0.4:
            settings["drive.steps"] = steps
        elif factor < 1.0:
            settings = merged_least(settings, resolution.settings(factor) or {})
    if seed and number is not None and draw.random() < 0.15:
        settings["specimen.points_per_edge"] = number._asdict() | {str(draw.choice(["x", "z"])): 1}
    return settings


def merged_least(first: dict[str, Any], second: dict[str, Any]) -> dict[str, Any]:
    """Settings of both; numbers of points by axis are the smaller of each."""
    merged = dict(first)
    for key, value in second.items():
        old = merged.get(key)
        if isinstance(value, dict) and isinstance(old, dict):
            value = {axis: min(n, old[axis]) for axis, n in value.items()}
        merged[key] = value
    return merged


def variant(kind: str, seed: int) -> Scene:
    """The scene of a kind and a seed, coarser as the seed says, as far as it takes that."""
    scene = coarse_scene_of(kind, seed) if kind in COARSE else scene_of(kind, seed)
    settings = coarsened(scene, kind, seed)
    if scene.drive is not None and scene.drive.accuracy is not None and "drive.accuracy" in settings:
        settings["drive.accuracy"] = min(settings["drive.accuracy"], 0.2)
    for key in list(settings):
        try:
            scene = changed(scene, {key: settings[key]})
            assemble(scene)
        except (SceneError, GeometryError):
            continue
    return scene


def parts_of(scene: Scene) -> dict[str, dict[str, Any]]:
    """By part of the error, settings by which it is as much finer as a run may take; points of all axes are one."""
    campaign, parts = Campaign(scene), {}
    for name in dict.fromkeys(map(_part, campaign.resolutions)):
        for factor in OF_TETS if name == TETS else FACTORS:
            settings: dict[str, Any] = {}
            for resolution in campaign.resolutions:
                if _part(resolution) == name:
                    settings = merged(settings, resolution.settings(factor) or {})
            if settings and _is_cheap(scene, settings):
                parts[name] = settings
                break
    return parts


def _part(resolution: Resolution) -> str:
    return POINTS if "point" in resolution.name else resolution.name


def _is_cheap(scene: Scene, settings: dict[str, Any]) -> bool:
    """Whether a run is taken, and short enough."""
    try:
        return forecast(assemble(changed(scene, settings))).seconds[0] <= LONGEST
    except (SceneError, GeometryError):
        return False


def numbers_of(row: dict[str, Any], scene: Scene, folder: Path) -> dict[str, float]:
    """By key, the numbers of a run whose error is asked, and what crushing took."""
    row = with_derived(row, folder)
    numbers = {}
    for answer in answers_of(row, [gauge.name for gauge in scene.gauge]):
        value = value_of(row, answer)
        if value is not None:
            numbers[answer.key] = value.number + value.interval
    return numbers | {key: row[key] for key in ("energy_j.crushing", "energy_j.external_work") if row.get(key)}


def measured(kind: str, seed: int, folder: Path) -> dict[str, Any]:
    """The line of a scene: sizes told, doubts, and numbers of the runs."""
    scene = variant(kind, seed)
    if (seconds := forecast(assemble(scene)).seconds[0]) > LONGEST:
        raise SceneError(f"it takes {seconds:.0f} s")
    assembly = assemble(scene)
    if scene.has_dead_loads and scene.settle is None:
        assembly = settled(assembly, 1, None, lambda: False)
    outcome = timeloop.run(assembly.model, assembly.plan, assembly.recording, 1)
    if outcome.stopped:
        raise SceneError(outcome.stopped)
    result = result_of(assembly, outcome)
    sizes = sizes_of(Inspection(assembly, outcome), Evidence(result.summary), criteria())
    parts = parts_of(scene)
    jobs = [Job(scene, settings) for settings in ({}, *parts.values())]
    rows = run_alone(jobs, folder, 0)
    runs = {
        name: numbers_of(row, scene, folder)
        for name, row in zip(("", *parts), rows, strict=True)
        if row["status"] == OK
    }
    doubts = [doubt["name"] for doubt in result.summary["doubts"]]
    return {"kind": kind, "seed": seed, "sizes": sizes, "doubts": doubts, "runs": runs, "parts": parts}


def rows_of(lines: Sequence[dict[str, Any]]) -> Iterator[list[str]]:
    """Of each doubt: scenes that are asked, hits, misses, false alarms, size by the doubt over the real error."""
    yield ["doubt", "of", "scenes", "told", "hits", "misses", "false alarms", "told over real"]
    for name, claim in CLAIMS.items():
        pairs = [(line["sizes"].get(name), error_of(claim, line["runs"])) for line in lines]
        cases = [(abs(size[0]), size[1], abs(real)) for size, real in pairs if size is not None and real is not None]
        doubts = [case for case in cases if case[0] > case[1]]
        hits = [size / real for size, limit, real in doubts if real > 0.5 * limit]
        misses = sum(size <= limit < real for size, limit, real in cases)
        counts = len(cases), len(doubts), len(hits), misses, len(doubts) - len(hits)
        yield [name, claim.part, *map(str, counts), f"{median(hits):.2g}" if hits else "-"]


def main() -> None:
    """Scenes that are missing, then the table of all."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("file", type=Path, metavar="FILE", help="lines of JSON, one a scene; those it has are kept")
    words.add_argument("--seeds", default="0-3", help="first and last")
    words.add_argument("--kinds", help="with commas (default: all)")
    chosen = words.parse_args()
    first, last = map(int, chosen.seeds.split("-"))
    kinds = chosen.kinds.split(",") if chosen.kinds else list(ALL)
    if unknown := [kind for kind in kinds if kind not in ALL]:
        words.error(f"--kinds {unknown[0]}: {nearest(unknown[0], ALL)}")
    lines = (
        [json.loads(line) for line in chosen.file.read_text(encoding="utf-8").splitlines()]
        if chosen.file.exists()
        else []
    )
    done = {(line["kind"], line["seed"]) for line in lines}
    with chosen.file.open("a", encoding="utf-8") as file:
        for seed in range(first, last + 1):
            for kind in kinds:
                if (kind, seed) not in done:
                    lines.append(_line(kind, seed))
                    print(json.dumps(lines[-1]), file=file, flush=True)
    print("\n".join(columns(list(rows_of([line for line in lines if "runs" in line])))))


def _line(kind: str, seed: int) -> dict[str, Any]:
    with TemporaryDirectory() as folder:
        try:
            return measured(kind, seed, Path(folder) / "runs")
        except (SceneError, GeometryError, Stopped) as error:
            print(f"{kind} {seed}: {error}"[:160], file=sys.stderr, flush=True)
            return {"kind": kind, "seed": seed, "reason": str(error)}


if __name__ == "__main__":
    main()
