"""What all pictures share: titles as they were written, axes, PNG files without a display."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from masonry.runtime.named_file import MARK

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from masonry.results.data import ResultData

MILLI, MEGA = 1e3, 1e-6


def drawn(figure: "Figure", path: Path | str | None) -> "Figure":
    """The figure, which is also written to a PNG file where one is named."""
    if path is not None:
        write_png(figure, path)
    return figure


def write_png(figure: Any, path: Path | str) -> None:
    """Draw a figure to a PNG file without a display."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    canvas = FigureCanvasAgg(figure)
    figure.set_dpi(120.0)
    if (engine := figure.get_layout_engine()) is not None:
        engine.execute(figure)
        figure.set_layout_engine("none")
    # savefig would draw once more, to lay it out
    canvas.print_png(path, metadata={"Software": MARK}, pil_kwargs={"compress_level": 3})


LONGEST_TITLE = 300
"""Letters of a title that are drawn: laying out a long one takes longer than the run."""


def plain(title: str) -> str:
    """A title as it was written: no control characters, no dollar sign that would begin a formula."""
    short = title if len(title) <= LONGEST_TITLE else title[: LONGEST_TITLE - 3] + "..."
    return "".join(c if c.isprintable() else " " for c in short).replace("$", r"\$")


def heading(figure: Any, result: "ResultData") -> None:
    """Title of the scene, its laws and kinds of motion."""
    words = [result.title, _words(result.summary.law), _words(result.summary.kinematics)]
    figure.suptitle(plain(", ".join(filter(None, words))), fontsize=13, wrap=True)


def tidy(axes: Any) -> None:
    """A light grid behind the curves, no frame at the top and right."""
    axes.grid(color="0.9", linewidth=0.8)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)


def _words(value: Any) -> str:
    """A word of the summary, or the different ones of a table of them: `elastic + exponential`."""
    return " + ".join(sorted(set(map(str, value.values())))) if isinstance(value, dict) else str(value or "")
