"""What the commands share: exit codes, a parser that says what is wrong in one line, and how a complaint is said."""

import argparse
import re
import sys
from collections.abc import Sequence
from typing import NoReturn

from masonry.errors import visible

OK, USAGE, STOPPED, INTERRUPTED, TERMINATED = 0, 2, 3, 130, 143
LONGEST_WORD, LONGEST_LINE, HEAD, TAIL = 500, 1600, 1000, 500
"""Letters of a word and of a line that a message repeats; of a longer line its head and its tail."""


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one line, as every other error of masonry."""

    def error(self, message: str) -> NoReturn:
        self.exit(complain(f"{message}; see `{self.prog} --help`", USAGE))


def complain(message: str | Sequence[str], code: int) -> int:
    """Say it, a line or some, so that no letter of a file can steer the terminal, no word fill the screen."""
    lines = [message] if isinstance(message, str) else message
    plain = [re.sub(rf"(\S{{{LONGEST_WORD}}})\S+", r"\1...", visible(line)) for line in lines]
    text = "\n".join(line if len(line) <= LONGEST_LINE else f"{line[:HEAD]} ... {line[-TAIL:]}" for line in plain)
    print(f"masonry: {text}", file=sys.stderr)
    return code
