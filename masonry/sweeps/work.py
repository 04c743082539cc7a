"""Task of a worker: one resolved scene is run to its end, or its modes computed, and whatever happens becomes a status
with a reason."""

import json
import time
import traceback
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from geometry.blocks import GeometryError
from masonry.errors import SceneError, Stopped

OK, REFUSED, STOPPED, ERROR = "OK", "REFUSED", "STOPPED", "ERROR"
STATUSES = (OK, REFUSED, STOPPED, ERROR)
MODES, SHAPES = "modes.json", "shapes.npy"
"""Files of a modal analysis: its numbers, and how the corners of the blocks move in each mode."""


class ModesTask(NamedTuple):
    """A resolved scene as TOML and the number of its slowest modes that are computed in place of a run."""

    toml: str
    modes: int


@dataclass(frozen=True)
class RunEnd:
    """Outcome of a run.

    status   OK; REFUSED before it began; STOPPED when its numbers could no longer be trusted; ERROR
    seconds  all in all: building, compiling, stepping
    files    name -> content of what `Result.save_numbers` writes; of a run that was stopped, up to there
    """

    status: str
    reason: str
    seconds: float
    files: dict[str, bytes] = field(default_factory=dict)


def compute(task: str | ModesTask) -> RunEnd:
    """Run a resolved scene, or compute its modes; raises nothing but KeyboardInterrupt. It may be far from the scene's
    file."""
    begun = time.perf_counter()

    def ended(status: str, error: BaseException | str, files: dict[str, bytes] | None = None) -> RunEnd:
        return RunEnd(status, str(error), time.perf_counter() - begun, files or {})

    try:
        if isinstance(task, ModesTask):
            return ended(OK, "", _modes(task))
        result = _run(task)
        if result.summary.interrupted:  # by Ctrl-C, where it runs in the user's own process
            raise KeyboardInterrupt
        return ended(OK, "", _files(result, begun))
    except (SceneError, GeometryError) as error:
        return ended(REFUSED, error)
    except Stopped as error:
        return ended(STOPPED, error, _files(error.result, begun) if error.result is not None else None)
    except MemoryError as error:
        return ended(ERROR, f"not enough memory: {error}")
    except Exception as error:
        last = traceback.extract_tb(error.__traceback__)[-1]
        return ended(ERROR, f"{type(error).__name__}: {error} ({last.filename}, line {last.lineno})")


def _run(toml: str) -> Any:
    from masonry.laboratory import laboratory

    return laboratory.run(_loaded(toml))


def _modes(task: ModesTask) -> dict[str, bytes]:
    import numpy as np

    from masonry.modal_analysis.vibration import ModesSettings, analyse

    begun, start = time.process_time(), time.perf_counter()
    modes = analyse(_loaded(task.toml), ModesSettings(task.modes))
    taken = {"seconds": time.perf_counter() - start, "seconds_processor_run": time.process_time() - begun}
    shapes = BytesIO()
    np.save(shapes, modes.corners)
    text = json.dumps(modes.as_data() | taken, indent=1, allow_nan=False) + "\n"
    return {MODES: text.encode(), SHAPES: shapes.getvalue(), "scene.toml": task.toml.encode()}


def _loaded(toml: str) -> Any:
    from masonry.scene import load

    with TemporaryDirectory(prefix="masonry-") as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(toml, encoding="utf-8", newline="\n")
        return load(path)


def _files(result: Any, begun: float) -> dict[str, bytes]:
    result.summary |= {"seconds": time.perf_counter() - begun}
    with TemporaryDirectory(prefix="masonry-") as folder:
        return {name: path.read_bytes() for name, path in result.save_numbers(Path(folder)).items()}
