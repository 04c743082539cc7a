"""`masonry record`: makes a record of the ground by seed and writes it as CSV; its numbers, and a picture of it."""

import tomllib
from pathlib import Path
from typing import Any

from masonry.errors import SceneError
from masonry.runtime.named_file import require_free, require_picture
from masonry.runtime.shell import OK, Parser

EPILOG = "The keys are those of [ground.made] in a scene: docs/scene.md, docs/fragility.md."
EXAMPLE = "spectrum=eurocode-8-1 soil=B a_g='0.2 g' duration='20 s' seed=1"
G = 9.80665


def parser() -> Parser:
    """The words that the command knows."""
    words = Parser(prog="masonry record", description="Make a record of the ground by seed.", epilog=EPILOG)
    words.add_argument("file", type=Path, metavar="FILE.csv", help="the record to write: time and acceleration")
    words.add_argument("keys", nargs="+", metavar="KEY=VALUE", help=f"what it is made of: {EXAMPLE}")
    words.add_argument("--components", type=int, default=1, metavar="N", help="independent ones: 1 (default) to 3")
    words.add_argument("--plot", nargs="?", const="", metavar="FILE.png", help="draw it (default: beside FILE.csv)")
    words.add_argument("--overwrite", action="store_true", help="replace files that are there already")
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message."""
    words = parser().parse_args(arguments)
    from masonry.curves.made_record_files import made_records, require_csv, table_of, write_records

    plot = None if words.plot is None else Path(words.plot or words.file.with_suffix(".png"))
    if plot is not None:
        require_picture(plot, "--plot")
    keys = _keys(words.keys)
    require_csv(words.file, words.overwrite)
    if plot is not None:
        require_free(plot, words.overwrite)
    records = made_records(keys, words.components, "--components")
    write_records(words.file, records)
    for name, record in records.items():
        print(_text(name, record))
    if plot is not None:
        table = table_of(keys)
        _draw(plot, f"{words.file.stem}: {table.spectrum}, seed {table.seed}", next(iter(records.values())))
    print("\n".join(str(path) for path in filter(None, (words.file, plot))))
    return OK


def _keys(texts: list[str]) -> dict[str, Any]:
    """Words KEY=VALUE as a table."""
    raw: dict[str, Any] = {}
    for text in texts:
        key, equals, value = (part.strip() for part in text.partition("="))
        if not equals or not key.isidentifier():
            raise SceneError(f"{text[:80]}: write KEY=VALUE, such as {EXAMPLE}")
        try:
            raw[key] = tomllib.loads(f"it = {value}")["it"]
        except tomllib.TOMLDecodeError:
            raw[key] = value
    return raw


def _text(name: str, record: Any) -> str:
    from masonry.ground.ground_motion import from_acceleration

    motion = from_acceleration(record.time, record.acceleration)
    off = "" if record.mismatch is None else f"; its spectrum is within {100.0 * record.mismatch:.1f} % of the target"
    return (
        f"{name}: {motion.duration:g} s, peaks {motion.peak_acceleration / G:.3g} g, "
        f"{100.0 * motion.peak_velocity:.3g} cm/s, {100.0 * motion.peak_displacement:.3g} cm{off}"
    )


def _draw(path: Path, title: str, record: Any) -> None:
    from geometry.files.atomic import whole_file
    from masonry.curves.record_picture import record_figure
    from masonry.ground.ground_motion import from_acceleration
    from masonry.pictures.style import write_picture
    from masonry.runtime.folder import writing

    motion = from_acceleration(record.time, record.acceleration)
    with writing(path), whole_file(path) as beside:
        write_picture(record_figure(title, motion, record.spectrum, record.target), beside)
