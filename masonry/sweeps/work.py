"""Task of a worker: one resolved scene is run to its end, and whatever happens becomes a status with a reason."""

import time
import traceback
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from geometry.blocks import GeometryError
from masonry.errors import SceneError, Stopped

OK, REFUSED, STOPPED, ERROR = "OK", "REFUSED", "STOPPED", "ERROR"
STATUSES = (OK, REFUSED, STOPPED, ERROR)


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


def compute(toml: str) -> RunEnd:
    """Run a resolved scene; raises nothing but KeyboardInterrupt. It may be far from the scene's file."""
    begun = time.perf_counter()

    def ended(status: str, error: BaseException | str, files: dict[str, bytes] | None = None) -> RunEnd:
        return RunEnd(status, str(error), time.perf_counter() - begun, files or {})

    try:
        result = _run(toml)
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
    from masonry import scene
    from masonry.laboratory import laboratory

    with TemporaryDirectory(prefix="masonry-") as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(toml, encoding="utf-8", newline="\n")
        loaded = scene.load(path)
    return laboratory.run(loaded)


def _files(result: Any, begun: float) -> dict[str, bytes]:
    result.summary |= {"seconds": time.perf_counter() - begun}
    with TemporaryDirectory(prefix="masonry-") as folder:
        return {name: path.read_bytes() for name, path in result.save_numbers(Path(folder)).items()}
