"""The map in CONTRIBUTING.md names what is there, and leaves out no room."""

import re
from importlib.util import find_spec
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
TREE = TEXT.split("```text\n")[1].split("```")[0]
BEGINS = ["geometry", "masonry", "verification", "tests", "benchmarks", "docs"]


def test_every_path_in_the_text_exists() -> None:
    paths = re.findall(rf"`((?:{'|'.join(BEGINS)})/[\w./*]*)", TEXT)
    assert len(paths) > 30
    assert [path for path in paths if not list(ROOT.glob(path.rstrip("/")))] == []


def test_every_module_in_the_text_exists() -> None:
    names = re.findall(rf"`(?:python -m )?((?:{'|'.join(BEGINS)})(?:\.\w+)+)", TEXT)
    assert len(names) >= 5
    missing = [name for name in names if find_spec(name.rpartition(".")[0]) is None]
    assert missing == []


def test_the_tree_names_every_room_and_nothing_else() -> None:
    drawn, house = set(), ""
    for line in TREE.splitlines():
        indent = len(line) - len(line.lstrip())
        words = [word for word in line[: 28 if indent == 0 else 28].split() if word.endswith(("/", ".py"))]
        if indent == 0:
            house = words[0]
            drawn |= set(words)
        else:
            drawn |= {house + word for word in words}
    assert [path for path in sorted(drawn) if not (ROOT / path).exists()] == []
    rooms = {f"{path.parent.relative_to(ROOT)}/" for top in BEGINS[:3] for path in (ROOT / top).glob("*/__init__.py")}
    assert rooms - drawn == set()
