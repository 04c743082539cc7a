"""`DIR/checkpoint/`: all that a run needs to go on after its process died. It is there as long as the run is not done.

scene.toml        the resolved scene, from the start
run.json          threads, and seconds between two checkpoints
HOW-TO-GO-ON.txt  the command that goes on, for who finds the folder
state-000012.npz  the last two checkpoints (state_file.py); the older one stands in where the newer one is damaged
"""

import contextlib
import json
import os
import re
import shutil
from pathlib import Path
from typing import Any

from geometry.files.atomic import WholeFiles, is_unfinished, unfinished
from geometry.operating_system import SYSTEM
from masonry.errors import SceneError
from masonry.runtime.folder import CHECKPOINT, HOW_TO, UNFINISHED, foreign_checkpoint, is_checkpoint, sweep_up
from masonry.runtime.state_file import Damaged, State, read, write

GENERATIONS = 2
SCENE, HOW = "scene.toml", "run.json"
"""Files beside the checkpoints: the first makes it a run to go on with."""


class Checkpoints:
    """The checkpoints in a folder of results; whoever uses them holds the folder's lock."""

    def __init__(self, results: Path) -> None:
        self.results, self.folder = results, results / CHECKPOINT
        self.scene = self.folder / SCENE
        self.last = 0

    def begin(self, scene_toml: str, how: dict[str, Any]) -> None:
        """Make the folder for a new run, in place of what another one left. Raises OSError."""
        self.clear()
        with WholeFiles(self.folder) as files:
            how_to = f" To continue it:\n\n    masonry resume {self.results}\n"
            files.new(HOW_TO).write_bytes(UNFINISHED + os.fsencode(how_to))  # a name of a folder may be no text
            files.text(HOW, json.dumps(how) + "\n")
            files.text(SCENE, scene_toml)

    def resolve(self, scene_toml: str) -> None:
        """Keep a scene in place of the one that the run was begun with. Raises OSError."""
        with WholeFiles(self.folder) as files:
            files.text(SCENE, scene_toml)

    def how(self) -> dict[str, Any]:
        """Content of run.json; empty where it cannot be read."""
        try:
            found = json.loads((self.folder / HOW).read_text(encoding="utf-8"))
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
        return sorted(((_number(path.name), path) for path in paths if _number(path.name)), reverse=True)

    def sweep_up(self) -> None:
        """Remove what a killed process left half-written."""
        sweep_up(self.results)
        if is_checkpoint(self.folder):
            sweep_up(self.folder)

    def clear(self) -> None:
        """The run is done, or is none: nothing is left to go on from, and what others put there stays. Raises OSError;
        SceneError where a folder of this name is not ours."""
        if not os.path.lexists(self.folder):
            return
        if not is_checkpoint(self.folder):
            raise SceneError(foreign_checkpoint(self.folder))
        there = {path.name for path in self.folder.iterdir()}
        ours = {name for name in there if name in (SCENE, HOW, HOW_TO) or _number(name) or is_unfinished(name)}
        if ours == there:
            gone = self.results / unfinished("checkpoint")
            SYSTEM.replace(self.folder, gone)  # all at once: half a checkpoint is none
            shutil.rmtree(gone, ignore_errors=True)
            return
        for name in sorted(ours, key=lambda name: (name != SCENE, name == HOW_TO)):  # as long as it lasts it is ours
            (self.folder / name).unlink()


def _whole(state: State) -> State:
    """The state, if it has what a checkpointer writes. Raises Damaged."""
    kinds = {"origin": dict, "model": str, "arrays": dict, "run": dict}
    for key, kind in kinds.items():
        if not isinstance(state.get(key), kind):
            raise Damaged(f"it has no '{key}'")
    return state


def _name(number: int) -> str:
    return f"state-{number:06d}.npz"


def _number(name: str) -> int:
    """Of a checkpoint, from 1; 0 for what is none."""
    named = re.fullmatch(r"state-(\d{6,})\.npz", name)
    return int(named[1]) if named else 0
