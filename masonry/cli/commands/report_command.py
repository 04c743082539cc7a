"""`masonry report`: a folder of results as one page for others: specimen, curve, cracks, results, verdict, assumptions.

Exit codes: 0 written, 2 something wrong with the words or the folder; nothing is written then.
"""

from pathlib import Path

from masonry.errors import visible
from masonry.runtime.shell import OK, Parser


def parser() -> Parser:
    """The words that the command knows."""
    words = Parser(
        prog="masonry report",
        description="Write a folder of results as one page of HTML with its pictures in it, which prints on A4.",
    )
    words.add_argument("folder", type=Path, metavar="DIR", help="a folder of results")
    words.add_argument("--out", type=Path, metavar="FILE.html", help="default DIR/report.html")
    words.add_argument("--overwrite", action="store_true", help="replace FILE.html, even if masonry did not write it")
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message before anything is written."""
    words = parser().parse_args(arguments)
    from masonry.laboratory.result import load_result
    from masonry.reporting.run_report import write_report

    result, out = load_result(words.folder), words.out or words.folder / "report.html"
    print(visible(f"{write_report(result, out, words.overwrite)}"))
    return OK
