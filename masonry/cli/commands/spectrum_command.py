"""`masonry spectrum`: response spectra of the ground and of gauges of a folder of results, as a table and a picture.

Exit codes: 0 written, 2 something wrong with the words or the folder; nothing is written then.
"""

from pathlib import Path

from masonry.errors import SceneError
from masonry.runtime.shell import OK, Parser, add_format


def parser() -> Parser:
    """The words that the command knows."""
    words = Parser(
        prog="masonry spectrum",
        description="Response spectra of the ground and of gauges of an acceleration: spectrum.csv and .png in DIR.",
    )
    words.add_argument("folder", type=Path, metavar="DIR", help="a folder of results")
    words.add_argument("--of", action="append", default=[], metavar="NAME", help="a gauge, or ground_x; default all")
    words.add_argument("--damping", default="5 %", metavar="SHARE", help="of the critical: '5 %%' (default) or 0.05")
    add_format(words)
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message before anything is written."""
    words = parser().parse_args(arguments)
    damping = _damping(words.damping)
    from masonry.curves.response_spectra import spectra_csv, spectra_of
    from masonry.curves.spectrum_picture import spectra_figure
    from masonry.laboratory.result import load_result
    from masonry.pictures.style import write_picture
    from masonry.rows.columns import GRAVITY
    from masonry.runtime.folder import writing
    from masonry.runtime.folders.own_files import ResultFiles

    result = load_result(words.folder)
    spectra = spectra_of(result, tuple(words.of), damping)
    with writing(words.folder, "spectra"), ResultFiles(words.folder) as files:
        files.text("spectrum.csv", spectra_csv(spectra))
        write_picture(spectra_figure(result, spectra), files.new(f"spectrum.{words.format}"))
    for name, answers, shortest in spectra:
        most = int(answers.pseudo_acceleration.argmax())
        print(
            f"{name}: {answers.pseudo_acceleration[most] / GRAVITY:.3g} g at most, at {answers.periods[most]:.3g} s; "
            f"rows show periods from {shortest:.2g} s on"
        )
    print(f"{words.folder / 'spectrum.csv'}\n{words.folder / f'spectrum.{words.format}'}")
    return OK


def _damping(text: str) -> float:
    """A share of the critical damping."""
    try:
        value = float(text.rstrip(" %")) / (100.0 if text.rstrip().endswith("%") else 1.0)
    except ValueError:
        value = -1.0
    if not 0.0 <= value <= 0.5:
        raise SceneError(f"--damping '{text[:20]}' is no share of the critical damping; give 0 to 50 %, such as '5 %'")
    return value
