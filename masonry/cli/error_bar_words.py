"""`masonry run --error-bar`, and `masonry resume` of such a run: the run, then its refinements in a folder within."""

import argparse
from pathlib import Path
from typing import Any

from masonry.cli.study_words import require_workers
from masonry.errors import visible
from masonry.runtime.ending import code_of, word_of
from masonry.runtime.processors import processors
from masonry.runtime.shell import OK, complain, tell


def run_with_bar(words: argparse.Namespace) -> int:
    """Run a scene, then refine it; returns the exit code. Raises SceneError."""
    from masonry.laboratory.run_command import run
    from masonry.sweeps.error_bars.run_with_bar import begin_refinement, forget

    words.workers = processors() if words.workers is None else words.workers
    require_workers(words)
    folders: list[Path] = []

    def begin(scene: Any, out: Path) -> None:
        folders.append(out)
        begin_refinement(scene, out, words.overwrite)

    code = None
    try:
        code = run(words, begin)
    finally:
        if code != OK and folders:
            forget(folders[0])
    return _refine(folders[0], words.workers, words.quiet, is_new=True) if code == OK else code


def resume_with_bar(words: argparse.Namespace) -> int:
    """Go on with a run, if it is not done, then refine it; returns the exit code."""
    from masonry.laboratory.run_command import resume
    from masonry.runtime.folder import CHECKPOINT

    is_new = (words.folder / CHECKPOINT / "scene.toml").is_file()
    quiet = words.quiet or not is_new  # of a run that is done nothing need be said
    code = resume(argparse.Namespace(**vars(words) | {"quiet": quiet}))
    return _refine(words.folder, processors(), words.quiet, is_new) if code == OK else code


def _refine(results: Path, workers: int, quiet: bool, is_new: bool) -> int:
    from masonry.sweeps.error_bars.run_with_bar import refine

    if not quiet:
        print(flush=True)
    try:
        result = refine(results, workers, None if quiet else tell, is_new)
    except KeyboardInterrupt as ended:
        again = f"its results are in '{results}', without a bar; go on with: masonry resume {results}"
        return complain(f"{word_of(ended)}; {again}", code_of(ended))
    if not quiet:
        print(f"{result}\n")
        names = ("summary.json", "curve.png")
        print("\n".join(visible(f"{path}") for path in [*(results / name for name in names), result.folder]))
    return OK
