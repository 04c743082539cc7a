"""Common style of all pictures: titles as they were written, axes, files without a display."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from masonry.runtime.named_file import MARK, require_picture

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from masonry.results.data import ResultData

MILLI, MEGA = 1e3, 1e-6
DPI = 160.0
"""Points of a picture an inch. Letters of 10 points on 7 inches can be read where it is 400 points wide."""
VECTORS = (".pdf", ".svg")


def drawn(figure: "Figure", path: Path | str | None) -> "Figure":
    """The figure, which is also written to a .png, .pdf or .svg file where one is named. Raises SceneError for
    others."""
    if path is not None:
        require_picture(Path(path))
        write_picture(figure, path)
    return figure


def write_picture(figure: Any, path: Path | str) -> None:
    """Draw a figure without a display to a PNG, PDF or SVG file, by the suffix of its path: the same bytes for the same
    figure, without dates."""
    if (suffix := Path(path).suffix) in VECTORS:
        _write_vectors(figure, Path(path), suffix[1:])
        return
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    canvas = FigureCanvasAgg(figure)
    figure.set_dpi(DPI)
    if (engine := figure.get_layout_engine()) is not None:
        engine.execute(figure)
        figure.set_layout_engine("none")
    # savefig would draw once more, to lay it out
    canvas.print_png(path, metadata={"Software": MARK}, pil_kwargs={"compress_level": 3})


def _write_vectors(figure: Any, path: Path, form: str) -> None:
    from matplotlib import rc_context

    date = {"pdf": "CreationDate", "svg": "Date"}[form]
    with rc_context({"svg.hashsalt": "masonry", "pdf.fonttype": 42}):
        figure.savefig(path, format=form, metadata={date: None, "Creator": MARK})
    if form == "pdf":  # what a file is marked by stands at one of its ends
        with path.open("ab") as file:
            file.write(f"% {MARK}\n".encode())


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


def number_logarithms(axis: Any) -> None:
    """Plain numbers at 1, 2, 3 and 5 of each decade of a logarithmic axis, in place of powers of ten."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 3.0, 5.0)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def _words(value: Any) -> str:
    """A word of the summary, or the different ones of a table of them: `elastic + exponential`."""
    return " + ".join(sorted(set(map(str, value.values())))) if isinstance(value, dict) else str(value or "")
