"""How a process of Python is started that finds the modules of this one, and runs nothing that lies beside the data.

`python -m` and `python -c` look into the current folder first, for modules of the standard library too: a `pickle.py`
beside a scene would be run. Such a process is started with `-P`, and takes over where this one looks.
"""

import os
import sys
import threading
from collections.abc import Callable
from pathlib import Path

HOUSE = Path(__file__).resolve().parents[1]
"""The folder that `geometry` lies in."""


def child_command(module: str, *words: str) -> list[str]:
    """The command of a process that calls `main()` of a module with these words as `sys.argv[1:]`."""
    code = f"import sys; sys.path[:] = {_search_path()!r}; from {module} import main; main()"
    return [sys.executable, "-P", "-c", code, *words]


def _search_path() -> list[str]:
    """Where this process looks for modules, whichever folder another one works in; "" is the current folder, which is
    looked into only where this program lies there."""
    here = [str(HOUSE)] if "" in sys.path and Path.cwd() == HOUSE else []
    return [place for entry in sys.path for place in ([os.path.abspath(entry)] if entry else here)]


def end_with_parent(last: Callable[[], object] = lambda: None) -> None:
    """Have this process end where the one that began it is gone, which holds the other end of standard input and writes
    nothing more to it; `last` is called before. From now on standard input is empty."""
    alive, nothing = os.dup(0), os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)

    def watch() -> None:
        os.read(alive, 1)
        last()
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
