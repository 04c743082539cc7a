"""Common parts of the commands: exit codes, a parser that reports errors in one line, and the form of complaints."""

import argparse
import contextlib
import os
import re
import sys
from collections.abc import Sequence
from typing import Any, NoReturn

from masonry.errors import did_you_mean, nearest, visible
from masonry.runtime.named_file import FORMATS

OK, USAGE, STOPPED, INTERRUPTED = 0, 2, 3, 130
LONGEST_WORD, LONGEST_LINE, HEAD, TAIL = 500, 1600, 1000, 500
"""Letters of a word and of a line that a message repeats; of a longer line its head and its tail."""


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one line, as every other error of masonry."""

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> tuple[Any, list[str]]:
        """As argparse does it, but a command itself says which of its words it does not know, and where its help is."""
        words, unknown = super().parse_known_args(args, namespace)
        if unknown:
            word = unknown[0].partition("=")[0]
            hint = did_you_mean(word, self._option_string_actions, 0.7)
            if not hint and "--set" in self._option_string_actions and re.fullmatch(r"--\w[\w.-]*", word):
                hint = f"; a key of the scene is changed by --set {word[2:]}=VALUE"
            self.error(f"unrecognized arguments: {' '.join(unknown)}{hint}")
        return words, unknown

    def error(self, message: str) -> NoReturn:
        self.exit(complain(f"{message}; see `{self.prog} --help`", USAGE))


def add_format(words: argparse.ArgumentParser) -> None:
    """The option of all commands that draw."""
    words.add_argument(
        "--format", type=picture_format, default=FORMATS[0], metavar="|".join(FORMATS), help="of pictures (default png)"
    )


def picture_format(text: str) -> str:
    """One of FORMATS."""
    if text not in FORMATS:
        raise argparse.ArgumentTypeError(f"'{text}'; {nearest(text, FORMATS)}")
    return text


def complain(message: str | Sequence[str], code: int) -> int:
    """Say it, a line or some, so that no letter of a file can steer the terminal, no word fill the screen."""
    lines = [message] if isinstance(message, str) else message
    plain = [re.sub(rf"(\S{{{LONGEST_WORD}}})\S+", r"\1...", visible(line)) for line in lines]
    text = "\n".join(line if len(line) <= LONGEST_LINE else f"{line[:HEAD]} ... {line[-TAIL:]}" for line in plain)
    with contextlib.suppress(OSError):  # nobody can hear it; the code still tells
        print(f"masonry: {text}", file=sys.stderr, flush=True)
    return code


def tell(line: str) -> None:
    """Say it on standard error."""
    print(visible(line), file=sys.stderr, flush=True)


def flush_errors() -> None:
    """Write what standard error still holds; where it takes nothing, drop it, or Python tries again at its end and
    leaves with a code of its own (120)."""
    try:
        sys.stderr.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stderr.fileno())


def have_streams() -> None:
    """Nothing is said where standard output or error was closed; printing to them must not be an error."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115  open to the end


def let_go_of_output() -> None:
    """Standard output takes nothing more; what is left in its buffer must not be tried again at the end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
