"""`masonry law`: lists the laws, or shows what one does."""

from pathlib import Path

from masonry.drawings.law_report import list_of_laws, report_of
from masonry.errors import SceneError
from masonry.runtime.named_file import require_free
from masonry.runtime.shell import OK, Parser


def parser() -> Parser:
    """The words that the command knows."""
    words = Parser(prog="masonry law", description="List the laws, or show what one does. More: docs/own-laws.md.")
    words.add_argument("name", nargs="?", metavar="NAME", help="a law; without it, all are listed")
    words.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        dest="changes",
        help="a key of the contact; the others are those of the couplet (Table 1 of the paper) and the law's examples",
    )
    words.add_argument(
        "--plot", nargs="?", const="", metavar="FILE.png", help="draw a picture of it (default law-NAME.png)"
    )
    words.add_argument("--overwrite", action="store_true", help="replace FILE.png, even if masonry did not draw it")
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message."""
    words = parser().parse_args(arguments)
    if words.name is None:
        if words.changes or words.plot is not None:
            raise SceneError("masonry law: --set and --plot go with the NAME of a law")
        print("\n".join(list_of_laws()))
        return OK
    plot = None if words.plot is None else Path(words.plot or f"law-{words.name}.png")
    if plot is not None:
        require_free(plot, words.overwrite)
    report = report_of(words.name, words.changes)
    print(report)
    if plot is not None:
        print(report.draw(plot))
    return OK
