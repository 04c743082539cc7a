"""What the commands share: exit codes, a parser that says what is wrong in one line, and how a complaint is said."""

import argparse
import re
import sys
from typing import NoReturn

OK, USAGE, STOPPED, INTERRUPTED = 0, 2, 3, 130
LONGEST_WORD = 1000
"""Letters of a word that a message repeats."""


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one line, as every other error of masonry."""

    def error(self, message: str) -> NoReturn:
        self.exit(USAGE, f"masonry: {message}; see `{self.prog} --help`\n")


def complain(message: str, code: int) -> int:
    """Say it so that no letter of a file can steer the terminal, and no word of it fills the screen."""
    short = re.sub(rf"(\S{{{LONGEST_WORD}}})\S+", r"\1...", message)
    plain = (c if c.isprintable() or c == "\n" else c.encode("unicode_escape").decode("ascii") for c in short)
    print(f"masonry: {''.join(plain)}", file=sys.stderr)
    return code
