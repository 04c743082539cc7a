"""How a process of Python is started that finds the modules of this one, and runs nothing that lies beside the data.

`python -m` and `python -c` look into the current folder first, for modules of the standard library too: a `pickle.py`
beside a scene would be run. Such a process is started with `-P`, and takes over where this one looks.
"""

import os
import sys
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
