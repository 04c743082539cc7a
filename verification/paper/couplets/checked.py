"""Claims in short: the reason is kept only where it is needed."""

from verification.paper.experiment import Claim


def checked(says: str, source: str, check: str, measured: str, holds: bool, otherwise: str) -> Claim:
    """A claim that holds, or does not, for the reason `otherwise`."""
    return Claim(says, source, check, measured, bool(holds), "" if holds else otherwise)


def unknown(says: str, source: str, check: str, measured: str, why: str) -> Claim:
    """A claim that cannot be told."""
    return Claim(says, source, check, measured, None, why)
