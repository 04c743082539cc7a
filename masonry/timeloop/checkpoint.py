"""`DIR/checkpoint/`: all that a run needs to go on after its process died. It is there as long as the run is not done.

scene.toml        the resolved scene, from the start
run.json          threads, and seconds between two checkpoints
HOW-TO-GO-ON.txt  the command that goes on, for who finds the folder
state-000012.npz  the last two checkpoints (runtime/state.py); the older one stands in where the newer one is damaged
"""

import contextlib
import json
import os
import re
import shutil
from pathlib import Path
from typing import Any

from geometry.files.atomic import WholeFiles
from masonry.runtime.folder import sweep_up
from masonry.runtime.state import Damaged, State, read, write

GENERATIONS = 2


class Checkpoints:
    """The checkpoints in a folder of results; whoever uses them holds the folder's lock."""

    def __init__(self, results: Path) -> None:
        self.results, self.folder = results, results / "checkpoint"
        self.scene = self.folder / "scene.toml"
        self.last = 0

    def begin(self, scene_toml: str, how: dict[str, Any]) -> None:
        """Make the folder for a new run, in place of what another one left. Raises OSError."""
        self.clear()
        with WholeFiles(self.folder) as files:
            files.text("run.json", json.dumps(how) + "\n")
            how_to = f"This run is not finished. To continue it:\n\n    masonry resume {self.results}\n"
            files.new("HOW-TO-GO-ON.txt").write_bytes(os.fsencode(how_to))  # a name of a folder may be no text
            files.text("scene.toml", scene_toml)

    def resolve(self, scene_toml: str) -> None:
        """Keep a scene in place of the one that the run was begun with. Raises OSError."""
        with WholeFiles(self.folder) as files:
            files.text("scene.toml", scene_toml)

    def how(self) -> dict[str, Any]:
        """What run.json says; nothing where it cannot be read."""
        try:
            found = json.loads((self.folder / "run.json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return {}
        return found if isinstance(found, dict) else {}

    def write(self, state: State) -> None:
        """Keep a state, whole or not at all, and drop what is older than the last two. Raises OSError."""
        name = _name(self.last + 1)
        try:
            with WholeFiles(self.folder) as files:
                write(files.new(name), state)
        except ValueError as error:  # zipfile, at the end of a file that could not be written
            raise OSError(str(error)) from None
        self.last += 1
        for _, path in self.states()[GENERATIONS:]:
            with contextlib.suppress(OSError):
                path.unlink()

    def newest(self) -> tuple[State | None, list[str]]:
        """The newest state that is whole, None where there is none; and what is wrong with newer ones, a line each."""
        wrong: list[str] = []
        for number, path in self.states():
            self.last = max(self.last, number)
            try:
                return _whole(read(path)), wrong
            except (Damaged, OSError) as error:
                wrong.append(f"'{path}' is damaged ({error})")
        return None, wrong

    def states(self) -> list[tuple[int, Path]]:
        """Number and path of the states that are there, newest first."""
        paths = self.folder.iterdir() if self.folder.is_dir() else ()
        found = [(int(m[1]), path) for path in paths if (m := re.fullmatch(r"state-(\d{6,})\.npz", path.name))]
        return sorted(found, reverse=True)

    def sweep_up(self) -> None:
        """Remove what a killed process left half-written."""
        sweep_up(self.results)
        if self.folder.is_dir():
            sweep_up(self.folder)

    def clear(self) -> None:
        """The run is done, or is none: nothing is left to go on from. Raises OSError."""
        if self.folder.is_dir():
            gone = self.results / f".{os.getpid()}-unfinished-checkpoint"
            os.replace(self.folder, gone)  # all at once: half a checkpoint is none
            shutil.rmtree(gone, ignore_errors=True)


def _whole(state: State) -> State:
    """The state, if it has what a checkpointer writes. Raises Damaged."""
    kinds = {"origin": dict, "model": str, "arrays": dict, "run": dict}
    for key, kind in kinds.items():
        if not isinstance(state.get(key), kind):
            raise Damaged(f"it has no '{key}'")
    return state


def _name(number: int) -> str:
    return f"state-{number:06d}.npz"
