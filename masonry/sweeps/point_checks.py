"""Whether the runs of a sweep can be built: each is assembled before the first one is run."""

import time
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from geometry.blocks import GeometryError
from masonry.errors import SceneError
from masonry.runtime.processes import work
from masonry.sweeps.planned_runs import Planned, faults

PATIENCE = 5.0
"""Seconds for which runs are assembled in this process; those that are left then go to several."""


def require_buildable(name: str, planned: Sequence[Planned], workers: int) -> None:
    """Raise SceneError where a run cannot be built: a line for each thing that is wrong, with its reason and what would
    work; `name` is the sweep's."""
    scenes = dict.fromkeys(run.job.resolved for run in planned)
    reasons = dict(zip(scenes, _reasons(list(scenes), workers), strict=True))
    wrong = {n: SceneError(reasons[run.job.resolved]) for n, run in enumerate(planned) if reasons[run.job.resolved]}
    if not wrong:
        return
    fine = len(planned) - len(wrong)
    more = f"{fine} of {len(planned)} runs can be built: --refused=keep runs them, and keeps the others as rows"
    raise faults(name, wrong, len(planned), more if fine else "")


def _reasons(scenes: Sequence[str], workers: int) -> list[str]:
    """Why each resolved scene cannot be built; "" where it can."""
    begun, reasons = time.perf_counter(), [""] * len(scenes)
    for number, toml in enumerate(scenes):
        if workers > 1 and len(scenes) - number > workers and time.perf_counter() - begun > PATIENCE:
            with closing(work(reason_against, scenes[number:], workers)) as answers:
                for place, answer in answers:
                    reasons[number + place] = _word(answer)
            break
        reasons[number] = reason_against(toml)
    return reasons


def _word(answer: Any) -> str:
    """A process that died says nothing of the scene: its run will."""
    return answer if isinstance(answer, str) else ""


def reason_against(toml: str) -> str:
    """Why a resolved scene cannot be built; "" where it can."""
    from masonry import scene
    from masonry.assembly.assemble import assemble
    from masonry.assembly.growing_loads import require_axles_to_load

    try:
        with TemporaryDirectory(prefix="masonry-") as folder:
            path = Path(folder) / "scene.toml"
            path.write_text(toml, encoding="utf-8", newline="\n")
            loaded = scene.load(path)
        require_axles_to_load(loaded)
        assemble(loaded)
    except (SceneError, GeometryError) as error:
        return str(error)
    return ""
