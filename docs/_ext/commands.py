"""The reference of the commands, made from their parsers as the site is built: it cannot fall behind them."""

import argparse
import re
import textwrap
from collections.abc import Iterator
from typing import Any

from masonry.cli.main import APART, module_of, parser

PAGE, MARK = "reference/commands", "<!-- commands -->"
WIDTH = 84
"""Letters of a line of usage."""
STAYS = "\x00"
"""Stands for a space at which no line of usage ends."""


def parsers() -> Iterator[tuple[str, str, argparse.ArgumentParser]]:
    """Name, help and parser of every command, those of other rooms and floors included."""
    main = parser()
    listed = next(action for action in main._actions if isinstance(action, argparse._SubParsersAction))
    helps = {choice.dest: choice.help or "" for choice in listed._choices_actions}
    for name, words in listed.choices.items():
        own = module_of(name).parser() if name in APART else words
        yield name, helps[name], own


def page() -> str:
    """Markdown: a section a command."""
    return "\n\n".join(_section(*command) for command in parsers())


def _section(name: str, says: str, words: argparse.ArgumentParser) -> str:
    words.prog = f"masonry {name}"
    usage = " ".join(words.format_usage().removeprefix("usage: ").split())
    usage = re.sub(r"\[[^][]*\]", lambda option: option[0].replace(" ", STAYS), usage)
    usage = "\n".join(textwrap.wrap(usage, WIDTH, subsequent_indent="    ", break_on_hyphens=False)).replace(STAYS, " ")
    lines = [f"## masonry {name}", "", f"{says[:1].upper()}{says[1:]}.", "", "```text", usage, "```"]
    rows = [_row(action) for action in words._actions if action.help and action.dest != "help"]
    if rows:
        lines += ["", "| word | meaning |", "|---|---|", *rows]
    if words.epilog:
        lines += ["", words.epilog]
    return "\n".join(lines)


def _row(action: argparse.Action) -> str:
    value = action.metavar or ("{" + ",".join(map(str, action.choices)) + "}" if action.choices else "")
    if isinstance(value, tuple):
        value = " ".join(value)
    names = ", ".join(f"`{' '.join(filter(None, (name, value)))}`" for name in action.option_strings) or f"`{value}`"
    return f"| {names} | {(action.help or '').replace('|', chr(92) + '|').replace('%%', '%')} |"


def _read(app: Any, name: str, source: list[str]) -> None:
    if name == PAGE:
        source[0] = source[0].replace(MARK, page())


def setup(app: Any) -> dict[str, bool]:
    """Fill the page as it is read, each time the site is built."""
    app.connect("source-read", _read)
    app.connect("env-get-outdated", lambda app, env, added, changed, removed: [PAGE])
    return {"parallel_read_safe": True, "parallel_write_safe": True}
