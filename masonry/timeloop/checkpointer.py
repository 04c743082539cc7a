"""Looks after a run between its chunks: writes a checkpoint when one is due, and ends it when it was asked to."""

import math
import time
from collections.abc import Callable

from masonry.configuration import model_state
from masonry.errors import SceneError
from masonry.model.model import Model
from masonry.runtime.state_file import Remembers, State
from masonry.timeloop.checkpoint import Checkpoints

FIRST = 60.0
"""Seconds of stepping after which the first checkpoint is due at the latest."""


class Checkpointer:
    """Checkpoints of one run.

    checkpoints  where they go; None: nothing is kept
    provenance   what the bits of a run depend on besides the model, in words; a run goes on from the same only
    every        seconds from one checkpoint to the next, infinite: only when asked to end; the first comes after FIRST
                 seconds, or after `every` where that is shorter
    asked        whether the run is to end now
    tell         is called with a sentence when a checkpoint could not be written
    """

    def __init__(
        self,
        checkpoints: Checkpoints | None,
        provenance: dict[str, str],
        every: float,
        asked: Callable[[], bool] = lambda: False,
        tell: Callable[[str], None] = lambda words: None,
    ) -> None:
        self.checkpoints, self.provenance, self.every = checkpoints, provenance, every
        self.asked, self.tell = asked, tell
        self.saved: State | None = None
        self.remarks: list[str] = []
        self.due = math.inf
        self.seconds = 0.0
        self.written = 0
        self.failing = False

    def run_another(self, toml: str, provenance: dict[str, str]) -> None:
        """Before the start: the scene (TOML) that is run, where it is not just the one that was asked for. Raises
        SceneError where it cannot be kept."""
        self.provenance = provenance
        try:
            if self.checkpoints is not None:
                self.checkpoints.resolve(toml)
        except OSError as error:
            folder = self.checkpoints.folder if self.checkpoints is not None else ""
            raise SceneError(f"cannot write the scene to '{folder}': {error.strerror or error}") from None

    def start(self, model: Model, run: Remembers) -> bool:
        """Before the first chunk: put back what was saved, if anything was; returns whether something was.

        Raises SceneError where it is of another model, KeyboardInterrupt where the run has been asked to end already.
        """
        if self.asked():
            raise KeyboardInterrupt
        self.model = model
        self.due = time.monotonic() + min(FIRST, self.every)
        if self.saved is None:
            return False
        if self.saved["model"] != model_state.fingerprint(model):
            raise SceneError(
                "the checkpoint belongs to another model: blocks, joints or meshes differ here from those at its start "
                "(another processor, or other versions of libraries); run the scene again"
            )
        try:
            model_state.restore(model, self.saved["arrays"])
            run.restore(self.saved["run"])
        except (KeyError, TypeError, ValueError, AttributeError, IndexError) as error:
            raise SceneError(f"the checkpoint does not fit this run ({error}); run the scene again") from None
        self.saved = None
        return True

    def look(self, run: Remembers) -> bool:
        """After a chunk: write a checkpoint if one is due; returns whether the run is to end."""
        ends = self.asked()
        if self.checkpoints is not None and (ends or time.monotonic() >= self.due):
            begun = time.monotonic()
            self._write(self.checkpoints, run)
            now = time.monotonic()
            self.seconds += now - begun
            self.due = now + self.every
        return ends

    def _write(self, checkpoints: Checkpoints, run: Remembers) -> None:
        whole: State = {
            "origin": self.provenance,
            "model": model_state.fingerprint(self.model),
            "arrays": model_state.state(self.model),
            "run": run.state(),
        }
        try:
            checkpoints.write(whole)
            self.written += 1
            self.failing = False
        except OSError as error:
            if not self.failing:
                older = "the one before is kept" if checkpoints.states() else "there is none yet"
                self.tell(f"no checkpoint could be written: {error.strerror or error}; {older}, and the run goes on")
            self.failing = True
