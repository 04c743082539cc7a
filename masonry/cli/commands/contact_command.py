"""`masonry contact`: from moduli, tests or the tables of Eurocode 6 to the contact table of a scene."""

from pathlib import Path
from typing import Any

from masonry.errors import SceneError
from masonry.materials.contact_data import KEYS, Amount, WordChoice
from masonry.runtime.named_file import require_free
from masonry.runtime.shell import OK, Parser

EPILOG = "Where each number is from: docs/contact-table.md."
OF_SCENE = ("law", "kinematics", "divisions", "contact", "basis", "strengths", "crushing")


def parser() -> Parser:
    """The words that the command knows: an option for each key of a contact's data."""
    words = Parser(
        prog="masonry contact",
        description="Make the contact table of a scene from moduli, laboratory tests, or the tables of EN 1996-1-1.",
        epilog=EPILOG,
    )
    data = words.add_argument_group("what is known; quantities with their unit: '16.7 GPa'")
    model = words.add_argument_group("what is made")
    for key, kind in KEYS.items():
        group = model if key in OF_SCENE else data
        option = f"--{key.replace('_', '-')}"
        if isinstance(kind, WordChoice):
            group.add_argument(option, dest=key, metavar="WORD", help=f"{kind.says}: {', '.join(kind.words)}")
        else:
            example = (kind.unit or "NUMBER") if isinstance(kind, Amount) else kind.example
            group.add_argument(option, dest=key, metavar=example, help=kind.says)
    model.add_argument("--scene", metavar="SCENE", help="the scene that it is for: kinematics, divisions and heights")
    model.add_argument("--out", type=Path, metavar="FILE.toml", help="write it; with --scene, the whole scene with it")
    model.add_argument("--overwrite", action="store_true", help="replace FILE.toml")
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message before anything is written."""
    words = parser().parse_args(arguments)
    known = {key: value for key in KEYS if (value := getattr(words, key)) is not None}
    if not known:
        raise SceneError("masonry contact: say what is known, such as --unit clay --unit-strength '20 MPa' --mortar M5")
    if words.out is not None:
        if words.out.suffix != ".toml":
            raise SceneError(f"--out '{words.out}': a scene is a .toml file; nearest: '{words.out.stem or 'my'}.toml'")
        require_free(words.out, words.overwrite)
    table, text = _made(known, words.scene, words.out is not None)
    if words.out is not None:
        _write(words.out, text)
    print(table if words.out is None else f"{table}\n# {words.out}")
    return OK


def _made(known: dict[str, Any], name: str | None, whole: bool) -> tuple[Any, str]:
    """The table, and what a file of it holds: itself, or the whole scene with it."""
    from masonry.materials.contact_data import ContactData
    from masonry.materials.contact_table import ContactTable

    if name is None:
        table = ContactTable(ContactData(known, dashes=True))
        return table, f"{table}\n"
    from masonry.materials.scene_data import with_scene
    from masonry.scene import load, to_toml

    scene = load(name)
    table = ContactTable(ContactData(with_scene(known, scene, dashes=True), dashes=True))
    return table, to_toml(scene.with_(table)) if whole else ""


def _write(path: Path, text: str) -> None:
    from geometry.files.atomic import whole_file
    from masonry.runtime.folder import writing

    with writing(path), whole_file(path) as beside:
        beside.write_text(text, encoding="utf-8", newline="\n")
