"""Services for notebooks: figures that show themselves, tables of words, and one line on how far a run is."""

import contextlib
import io
import sys
from collections.abc import Callable, Iterator
from typing import Any

from masonry.runtime.progress import Progress

Tell = Callable[[int, int, str], None]


def in_notebook() -> bool:
    """Whether the kernel of a notebook runs this, not a script or a terminal."""
    ipython = sys.modules.get("IPython")
    return ipython is not None and hasattr(ipython.get_ipython(), "kernel")


@contextlib.contextmanager
def telling(progress: Tell | bool | None, label: str) -> Iterator[Tell | None]:
    """Function to call between the chunks of a run.

    progress  a function of the user's own; True: say it, False: do not; None: say it in a notebook only
    """
    if callable(progress):
        yield progress
    elif progress is False or (progress is None and not in_notebook()):
        yield None
    else:
        where: Any = OneLine() if in_notebook() else contextlib.nullcontext(sys.stderr)
        with where as stream, Progress(label=label, stream=stream) as bar:
            yield bar


@contextlib.contextmanager
def telling_lines(progress: Callable[[str], None] | bool | None) -> Iterator[Callable[[str], None] | None]:
    """Function to call with a line for each of many runs that ends; `progress` as in `telling`."""
    if callable(progress):
        yield progress
    elif progress is False or (progress is None and not in_notebook()):
        yield None
    elif not in_notebook():
        yield lambda line: print(line, file=sys.stderr, flush=True)
    else:
        with OneLine() as stream:
            yield lambda line: print(line, file=stream)


class OneLine(io.TextIOBase):
    """A stream whose last line stands below the cell of a notebook, and goes when the stream is closed."""

    def __init__(self) -> None:
        from IPython.display import display

        self._shown = display({"text/plain": ""}, raw=True, display_id=True)

    def write(self, text: str) -> int:
        """Take the place of the line before."""
        if text.strip():
            self._shown.update({"text/plain": text.strip()}, raw=True)
        return len(text)

    def close(self) -> None:
        """Leave nothing behind."""
        if not self.closed:
            self._shown.update({"text/plain": ""}, raw=True)
        super().close()
