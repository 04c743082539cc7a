"""`masonry run` and `masonry resume`: one run from the shell, with its lock, checkpoints, results and exit code."""

import argparse
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

from masonry.errors import SceneError, Stopped
from masonry.runtime.ending import word_of, word_of_signal
from masonry.runtime.interrupts import Interrupts, interruptible
from masonry.runtime.processors import AUTO, processors
from masonry.runtime.shell import OK, STOPPED, complain

EVERY = 300.0
"""Seconds between two checkpoints where nothing is said."""
NEVER = ("0", "never")


def run(words: argparse.Namespace, begin: Callable[[Any, Path], None] | None = None) -> int:
    """`masonry run`: everything that the run got to is written, whatever ended it; `begin` is called with the scene and
    its folder before anything runs."""
    from masonry import scene
    from masonry.runtime.folder import claimed, scene_name, writing
    from masonry.timeloop.checkpoint import Checkpoints

    every = _every(words.checkpoint_every, EVERY)
    with interruptible() as interrupts:
        loaded = scene.load(words.scene, words.overrides)
        with claimed(words.scene, words.out, overwrite=words.overwrite) as out:
            checkpoints = Checkpoints(out)
            if begin is not None:
                begin(loaded, out)
            with writing(out):
                checkpoints.sweep_up()
                checkpoints.clear()
                if math.isfinite(every):
                    checkpoints.begin(scene.to_toml(loaded), {"threads": words.threads, "checkpoint_every": every})
            going = _Run(loaded, checkpoints, words.threads, every, interrupts, words.quiet)
            return going.carry_out(scene_name(words.scene))


def resume(words: argparse.Namespace) -> int:
    """`masonry resume`; returns the exit code."""
    return resume_in(words.folder, words.threads, words.checkpoint_every, words.quiet)


def resume_in(
    folder: Path, threads: int | str | None = None, checkpoint_every: str | None = None, quiet: bool = True
) -> int:
    """Go on from the last checkpoint in a folder to the end, with the bits that the run would have had; what is not
    told is as the run was begun. Returns the exit code. Raises SceneError where there is nothing to go on with."""
    from masonry import scene
    from masonry.runtime.lock import sole
    from masonry.timeloop.checkpoint import Checkpoints

    checkpoints = Checkpoints(folder)
    if not checkpoints.scene.is_file():
        return _nothing_to_resume(folder, quiet)
    with interruptible() as interrupts, sole(folder, "resumes the run in it"):
        if not checkpoints.scene.is_file():  # done by another process meanwhile
            return _nothing_to_resume(folder, quiet)
        checkpoints.sweep_up()
        how = checkpoints.how()
        threads = threads or _as_begun(how.get("threads"))
        before = how.get("checkpoint_every")
        every = _every(checkpoint_every, before if isinstance(before, float) and before > 0 else EVERY)
        loaded = scene.load(checkpoints.scene)
        going = _Run(loaded, checkpoints, threads, every, interrupts, quiet)
        going.find_checkpoint()
        return going.carry_out(loaded.name)


def _as_begun(threads: Any) -> int | str:
    """Those that a run was begun with, as far as there are as many here; 1 where that is not told."""
    if threads == AUTO:
        return AUTO
    return min(threads, processors()) if isinstance(threads, int) and threads > 0 else 1


class _Run:
    """One run of a scene into a folder that this process holds."""

    def __init__(
        self, scene: Any, checkpoints: Any, threads: int | str, every: float, interrupts: Interrupts, quiet: bool
    ) -> None:
        from masonry.laboratory.summary.provenance import provenance_of
        from masonry.scene import to_toml
        from masonry.timeloop.checkpointer import Checkpointer

        self.scene, self.checkpoints = scene, checkpoints
        self.threads, self.interrupts, self.quiet = threads, interrupts, quiet
        self.new = True
        self.out: Path = checkpoints.results
        self.provenance = provenance_of(to_toml(scene))
        self.checkpointer = Checkpointer(
            checkpoints if math.isfinite(every) else None, self.provenance, every, interrupts, _tell
        )

    def find_checkpoint(self) -> None:
        """Have the checkpointer go on from the newest checkpoint that is whole, if the run got to one."""
        from masonry.laboratory.summary.provenance import require_same

        self.new = False
        saved, wrong = self.checkpoints.newest()
        for line in wrong:
            _tell(line + ("; the one before it is used" if saved else ""))
        if saved is None and wrong:
            raise SceneError(
                f"no checkpoint in '{self.checkpoints.folder}' can be read; run the scene again: masonry run "
                f"{self.checkpoints.scene} --out ANOTHER"
            )
        if saved is not None:
            self.checkpointer.saved = saved
            self.checkpointer.remarks = require_same(saved["origin"], self.provenance, self.out)
            for line in self.checkpointer.remarks:
                _tell(line)
        elif not self.quiet:
            _tell("it did not reach its first checkpoint: starts again")

    def carry_out(self, label: str) -> int:
        """Run, write, say; the exit code."""
        try:
            return self._carry_out(label)
        except KeyboardInterrupt as ended:
            self._leave_nothing_begun()
            if not self.checkpoints.scene.is_file():
                return complain(f"{word_of(ended)} before there were results", self.interrupts.code)
            return complain(f"ended at once; {self._how_to_go_on()}", self.interrupts.code)
        except BaseException:
            self._leave_nothing_begun()
            raise

    def _leave_nothing_begun(self) -> None:
        """A new run that did not get anywhere leaves nothing to go on from."""
        if self.new and not self.checkpoints.states():
            self.checkpoints.clear()

    def _carry_out(self, label: str) -> int:
        try:
            result = self._result(label)
        except Stopped as error:
            if error.result is None:
                raise
            paths = self._save(error.result)
            self.checkpoints.clear()
            self._print(paths, error.result)
            return complain([f"{error}", f"masonry: the results up to there are in '{self.out}'"], STOPPED)
        paths = self._save(result)
        interrupted = result.summary.interrupted
        if not interrupted:
            self.checkpoints.clear()
        self._print(paths, result)
        if interrupted:
            words = f"interrupted; the results up to there are in '{self.out}'"
            return complain(
                f"{words}; {self._how_to_go_on()}" if self.checkpoints.states() else words, self.interrupts.code
            )
        if self.interrupts.number:
            done = f"the run had come to its end, and its results are in '{self.out}'"
            return complain(f"{word_of_signal(self.interrupts.number)}; {done}", self.interrupts.code)
        return OK

    def _print(self, paths: dict[str, Path], result: Any) -> None:
        if not self.quiet:
            from masonry.laboratory.text import paths_text, summary_text

            print(f"{paths_text(paths)}\n\n{summary_text(result.summary)}", flush=True)

    def _result(self, label: str) -> Any:
        from masonry.laboratory import laboratory
        from masonry.runtime.progress import Progress

        if self.quiet:
            return laboratory.run(self.scene, threads=self.threads, progress=None, checkpointer=self.checkpointer)
        with Progress(label=label) as progress:
            return laboratory.run(self.scene, threads=self.threads, progress=progress, checkpointer=self.checkpointer)

    def _save(self, result: Any) -> dict[str, Path]:
        from masonry.runtime.folder import writing

        more = f"; once it can, {self._how_to_go_on()}" if self.checkpoints.states() else ""
        with writing(self.out, more=more):
            paths: dict[str, Path] = result.save(self.out)
        return paths

    def _how_to_go_on(self) -> str:
        return f"resume with: masonry resume {self.out}"


def _nothing_to_resume(folder: Path, quiet: bool) -> int:
    """Why there is nothing to go on from: it is done, or it cannot be."""
    from masonry.runtime.text_files import json_of

    if not folder.is_dir():
        raise SceneError(f"'{folder}' is not a folder of results; `masonry run` writes one")
    try:
        summary = json_of(folder / "summary.json")
        stopped, interrupted = summary.get("stopped"), summary.get("interrupted")
    except (SceneError, AttributeError):
        raise SceneError(
            f"'{folder}' holds neither results nor a checkpoint; `masonry run SCENE --out {folder}` begins a run"
        ) from None
    if stopped:
        raise SceneError(
            f"the run in '{folder}' was stopped for good, as its numbers could no longer be trusted: {stopped}; change"
            " the scene and run it again"
        )
    if interrupted:
        raise SceneError(f"the run in '{folder}' was interrupted and kept no checkpoint; run its scene.toml again")
    if not quiet:
        print(f"the run in '{folder}' is finished")
    return OK


def _every(text: str | None, usual: float) -> float:
    """Seconds between two checkpoints, infinite for never. Raises SceneError."""
    from masonry.quantity import parse

    if text is None:
        return usual
    return math.inf if text in NEVER else parse(text, "time", "--checkpoint-every", "(0, 1e9] s")


def _tell(line: str) -> None:
    complain(line, OK)
