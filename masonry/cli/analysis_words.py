"""Common parts of `masonry limit` and `masonry modes`, which analyse a scene without a run: words, folder of files."""

import argparse
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Protocol

from masonry.errors import visible
from masonry.runtime.shell import Parser, add_format


class Analysis(Protocol):
    """A result that is printed, or told as data, or saved in a folder with its pictures."""

    def as_data(self) -> dict[str, Any]: ...

    def save(self, folder: Path, view: str | None, form: str) -> list[Path]: ...


def analysis_parser(name: str, description: str, epilog: str, views: Sequence[str]) -> Parser:
    """The words of `masonry NAME SCENE`, to which the command adds its own."""
    words = Parser(prog=f"masonry {name}", description=description, epilog=epilog)
    words.add_argument("scene", metavar="SCENE", help="a scene file, or the name of a packaged scene")
    words.add_argument(
        "--set", action="append", default=[], metavar="KEY=VALUE", dest="overrides", help="change a key of the scene"
    )
    words.add_argument(
        "--out", type=Path, metavar="DIR", help=f"folder for the results (default results/SCENE-{name}-N)"
    )
    words.add_argument("--overwrite", action="store_true", help="replace results that are in DIR already")
    json_alone = f"print {name}.json, and write no files unless DIR is given"
    words.add_argument("--json", action="store_true", help=json_alone)
    words.add_argument("--view", choices=views, help="of the pictures; default: the one that shows what moves")
    add_format(words)
    return words


def tell_and_save(name: str, words: argparse.Namespace, result: Analysis) -> None:
    """Print the result, and leave its files where the words say. Raises SceneError where the folder is in use."""
    from masonry.runtime.folder import claimed, scene_name, writing

    print(json.dumps(result.as_data(), indent=1) if words.json else result)
    if words.json and words.out is None:
        return
    default = f"{scene_name(words.scene)}-{name}"
    with claimed(default, words.out, overwrite=words.overwrite) as folder, writing(folder):
        paths = result.save(folder, words.view, words.format)
    if not words.json:
        print("\n".join(visible(f"{path}") for path in paths))
