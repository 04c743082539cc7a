"""Runs the blocks of a page as a reader would: in order, in one empty folder, Python in one namespace."""

import io
import json
import re
import shlex
import tomllib
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

from masonry.cli.main import APART, main, module_of, parser
from masonry.laboratory import laboratory
from masonry.scene import load
from masonry.sweeps.planned_runs import plan
from masonry.sweeps.read import read
from tests.docs.pages import RUN, Block
from tests.docs.printed import not_printed

ELSEWHERE = ("make", "pip", "git", "cd", "dask", "apt-get", "jupyter", "python", ".venv/bin/python", ".venv/bin/pip")
"""What a line of a shell may begin with besides `masonry`; such lines are not run."""
MASONRY = ("masonry", ".venv/bin/masonry")
VARIABLE = re.compile(r"[A-Z_]+=")
"""What may stand before: a variable that is set for the line."""
PRINTS = ("python", "bash", "console")
"""Languages of blocks that print something."""
FOR_LIMIT_ANALYSIS = "a run leaves out the load of [limit]"
"""What a scene for `masonry limit` is warned of, beside which a page shows no run."""
SHELL = ("|", "||", "&", "&&", ";", ">", ">>", "<")


class Reader:
    """Someone who tries what a page says; `folder` is where, and is empty at first."""

    def __init__(self, page: str, blocks: list[Block], folder: Path) -> None:
        self.page, self.blocks, self.folder = page, blocks, folder
        self.names: dict[str, Any] = {"__name__": Path(page).stem}
        for block in blocks:
            if block.file:
                (folder / block.file).write_text(block.text, encoding="utf-8")

    def read(self, slow: bool) -> None:
        """Run every block; those that are slow only where asked for, else they are looked at."""
        output: str | None = None
        for block in self.blocks:
            if block.language in RUN:
                run = not block.why_not and (slow or not block.slow)
                with redirect_stdout(io.StringIO()) as printed:
                    getattr(self, block.language)(block, self.where(block), run)
                output = printed.getvalue() if run and block.language in PRINTS else None
                print(printed.getvalue(), end="")
            elif block.language == "text" and output is not None and not block.why_not:
                missing = not_printed(block.text, output)
                assert not missing, f"{self.where(block)}: what runs before does not print {missing}"
                output = None

    def where(self, block: Block) -> str:
        """The place of a block, for messages."""
        return f"{self.page}, line {block.line}"

    def python(self, block: Block, where: str, run: bool) -> None:
        """Python: compiled under its place on the page, and run."""
        code = compile("\n" * (block.line - 1) + block.text, str(self.page), "exec")
        if run:
            exec(code, self.names)

    def bash(self, block: Block, where: str, run: bool) -> None:
        """A shell: every line is a command."""
        for line in block.text.replace("\\\n", " ").splitlines():
            self.command(line, block, where, run)

    def console(self, block: Block, where: str, run: bool) -> None:
        """A shell and its answers: a command follows a dollar sign, or begins with `masonry `."""
        lines = block.text.replace("\\\n", " ").splitlines()
        commands = [line.removeprefix("$ ") for line in lines if line.startswith(("$ ", "masonry "))]
        assert commands, f"{where}: no command; one follows '$ ', or begins with 'masonry '"
        for line in commands:
            self.command(line, block, where, run)

    def command(self, line: str, block: Block, where: str, run: bool) -> None:
        """One line: `masonry` is called here, or its words are looked at; what else is known is left alone."""
        words = shlex.split(line, comments=True)
        while words and VARIABLE.match(words[0]):
            words.pop(0)
        if not words or words[0] in ELSEWHERE:
            return
        known = ", ".join((*MASONRY, *ELSEWHERE))
        assert words[0] in MASONRY, f"{where}: '{line}' begins with none of {known}"
        assert not set(words) & set(SHELL), f"{where}: '{line}' needs a shell; a line is one command"
        if run:
            code = main(words[1:])
            assert code == block.code, f"{where}: '{line}' ended with exit code {code}"
        elif words[1] in APART:
            module_of(words[1]).parser().parse_args(words[2:])
        else:
            parser().parse_args(words[1:])

    def toml(self, block: Block, where: str, run: bool) -> None:
        """A scene is built and checked, a sweep is planned, a part of a scene is put on the couplet."""
        try:
            tables = tomllib.loads(block.text)
        except tomllib.TOMLDecodeError as error:
            raise AssertionError(f"{where}: {error}") from None
        if "project" in tables:  # of a package that brings laws or specimens of its own
            return
        if "scene" in tables:
            assert plan(read(self.written(block))), where
        elif "base" in tables or "kind" in tables.get("specimen", {}):
            report = laboratory.check(load(self.written(block)))
            warnings = [line for line in report["warnings"] if not line.startswith(FOR_LIMIT_ANALYSIS)]
            assert report["blocks"] > 0 and warnings == [], f"{where}: {warnings}"
        else:
            load(self.written(block, 'base = "couplet"\n'))

    def written(self, block: Block, first: str = "") -> Path:
        """The block as a file, under its own name where it has one."""
        path = self.folder / (block.file or f"line-{block.line}.toml")
        if not block.file:
            path.write_text(first + block.text, encoding="utf-8")
        return path

    def json(self, block: Block, where: str, run: bool) -> None:
        """JSON: can be read."""
        try:
            json.loads(block.text)
        except ValueError as error:
            raise AssertionError(f"{where}: {error}") from None
