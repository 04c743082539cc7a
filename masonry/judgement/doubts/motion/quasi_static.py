"""Should the test be slow enough to be static? A load that grows need not, as it rests at each step, and neither need
a motion in real time.
"""

from collections.abc import Callable

from masonry.judgement.evidence import Evidence


def should_be_slow(evidence: Evidence) -> bool:
    """Whether the run is a test that should be quasi-static."""
    return not (evidence.in_real_time or evidence.grows)


def acts_slowly(key: str) -> Callable[[Evidence], bool]:
    """Whether it should be slow, and something acts after the settling: a drive, or whatever made a number there."""
    return lambda evidence: should_be_slow(evidence) and (evidence.has_drive or evidence.number(key) is not None)


def slower(evidence: Evidence) -> str:
    """Advice for a slower test, by what loads it."""
    how = "ask for a smaller accuracy, or lower the rate" if evidence.has_drive else "let its histories take longer"
    return f"load more slowly: {how}"
