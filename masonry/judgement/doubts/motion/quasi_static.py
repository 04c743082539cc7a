"""Should the test be slow enough to be static? A load that grows need not, as it rests at each step, and neither need
a motion in real time.
"""

from masonry.judgement.evidence import Evidence


def should_be_slow(evidence: Evidence) -> bool:
    """Whether the run is a test that should be quasi-static."""
    return not (evidence.in_real_time or evidence.grows)
