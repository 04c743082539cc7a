"""Claims in short: the reason is kept only where it is needed, and percent signs stand off their numbers."""

import re

from verification.paper.experiment import Claim


def checked(says: str, source: str, check: str, measured: str, holds: bool, otherwise: str) -> Claim:
    """A claim that holds, or does not, for the reason `otherwise`."""
    return Claim(says, source, spaced(check), spaced(measured), bool(holds), "" if holds else spaced(otherwise))


def unknown(says: str, source: str, check: str, measured: str, why: str) -> Claim:
    """A claim that cannot be decided."""
    return Claim(says, source, spaced(check), spaced(measured), None, spaced(why))


def spaced(text: str) -> str:
    """5% as 5 %."""
    return re.sub(r"(?<=\d)%", " %", text)
