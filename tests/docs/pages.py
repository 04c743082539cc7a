"""The pages of the documentation, and their blocks of code.

A block may have a word for the tests on the line before it, which no reader sees:
<!-- slow -->           run by `pytest -m slow` only
<!-- exit 2 -->         the commands end with this exit code
<!-- not run: why -->   looked at, but not run
The first block of text after one that runs is what that prints, or a part of it (`tests/docs/printed.py`), unless a
word says that it is not.
"""

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SHOWN = ("text", "csv")
"""Languages of what is only shown."""
RUN = ("python", "bash", "console", "toml", "json")
"""Languages that `Reader` has a method for."""
_FENCE = re.compile(
    r"^(?P<fence>`{3,})(?P<language>[^`\n]*)\n(?P<text>.*?)^(?P=fence)[ \t]*$", re.MULTILINE | re.DOTALL
)
_WORD = re.compile(r"<!-- (slow|exit (?P<code>\d+)|not run: (?P<why>[^>]+)) -->[ \t]*\n$")
_NAMED = re.compile(r"# (?P<name>[\w.-]+\.toml)\b")


@dataclass(frozen=True)
class Block:
    """A block of code: its language, text, first line on its page (from 1), and what the page says of it to tests."""

    language: str
    text: str
    line: int
    slow: bool = False
    code: int = 0
    why_not: str = ""

    @property
    def file(self) -> str | None:
        """The file that a block of TOML is, where its first line says so: `# own.toml`."""
        named = _NAMED.match(self.text)
        return named["name"] if named and self.language == "toml" else None


def pages() -> dict[str, Path]:
    """Every page, by its path in the repository."""
    files = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")]
    return {str(path.relative_to(ROOT)): path for path in sorted(files) if "_generated" not in path.parts}


def blocks(page: str) -> list[Block]:
    """All blocks of a page, in order."""
    return blocks_of(pages()[page].read_text(encoding="utf-8"))


def blocks_of(text: str) -> list[Block]:
    """All blocks of a text, in order."""
    blocks = []
    for match in _FENCE.finditer(text):
        said = _WORD.search(text[: match.start()])
        code, why = (said["code"], said["why"]) if said else (None, None)
        line = text.count("\n", 0, match.start("text")) + 1
        slow = bool(said and said[1] == "slow")
        blocks.append(Block(match["language"].strip(), match["text"], line, slow, int(code or 0), why or ""))
    return blocks
