"""`masonry record`: makes a record of the ground by seed and writes it as CSV; its numbers, and a picture of it."""

import tomllib
from pathlib import Path
from typing import Any

import numpy as np

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
    table = _table(words.keys)
    from masonry.scene.tables.dynamics.made_record import COMPONENTS

    if not 1 <= words.components <= len(COMPONENTS):
        raise SceneError(f"--components {words.components}: 1, 2 or 3")
    if words.file.suffix != ".csv":
        raise SceneError(f"'{words.file}': the record is a .csv file; nearest: '{words.file.stem or 'record'}.csv'")
    plot = None if words.plot is None else Path(words.plot or words.file.with_suffix(".png"))
    if plot is not None:
        require_picture(plot, "--plot")
    for path in filter(None, (words.file, plot)):
        require_free(path, words.overwrite)
    names = COMPONENTS[: words.components]
    records = {name: table.record(name) for name in names}
    _write(words.file, records)
    for name, record in records.items():
        print(_text(name, record))
    if plot is not None:
        _draw(plot, f"{words.file.stem}: {table.spectrum}, seed {table.seed}", records[names[0]])
    print("\n".join(str(path) for path in filter(None, (words.file, plot))))
    return OK


def _table(keys: list[str]) -> Any:
    """The table [ground.made] that the words make."""
    from pydantic import ValidationError, create_model

    from masonry.scene.messages import explain
    from masonry.scene.source import Source
    from masonry.scene.tables.dynamics.made_record import MadeGround

    raw: dict[str, Any] = {}
    for text in keys:
        key, equals, value = (part.strip() for part in text.partition("="))
        if not equals or not key.isidentifier():
            raise SceneError(f"{text[:80]}: write KEY=VALUE, such as {EXAMPLE}")
        try:
            raw[key] = tomllib.loads(f"it = {value}")["it"]
        except tomllib.TOMLDecodeError:
            raw[key] = value
    of_a_scene = {"ground": {"made": raw}}
    ground = create_model("GroundThatIsMade", made=(MadeGround, ...))
    scene: Any = create_model("SceneOfGround", ground=(ground, ...))
    try:
        return scene.model_validate(of_a_scene).ground.made
    except ValidationError as error:
        raise explain(error, Source("masonry record", "record", "", of_a_scene)) from None


def _write(path: Path, records: dict[str, Any]) -> None:
    from geometry.files.atomic import whole_file
    from masonry.runtime.folder import writing

    first = next(iter(records.values()))
    table = np.column_stack([first.time, *(record.acceleration for record in records.values())])
    head = ",".join(["time (s)", *(f"{name} (m/s2)" for name in records)])
    with writing(path), whole_file(path) as beside:
        np.savetxt(beside, table, fmt=["%.9g", *["%.6f"] * len(records)], delimiter=",", header=head, comments="")


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
