"""By how much the frequencies of a scene are too high, as joints bend or twist too stiffly by their contact points.

By Rayleigh's quotient a frequency goes with the root of the stiffness that its mode shows.
"""

import numpy as np

from geometry.joints.faces.second_moments import lacking_flexibility
from masonry.estimates.elastic_joints import bend_or_twist, lacking_share
from masonry.modal_analysis.oscillator import Oscillator

TOO_HIGH = 0.02
"""Share of a frequency from which on it is told."""


def joint_words(oscillator: Oscillator, shapes: np.ndarray, closed: np.ndarray) -> list[str]:
    """A line, where a frequency is too high."""
    high = frequencies_too_high(oscillator, shapes, closed)
    if high.max(initial=0.0) <= TOO_HIGH:
        return []
    worst = int(np.argmax(high))
    return [
        f"joints {bend_or_twist(high[worst])}: the frequencies of {int((high > TOO_HIGH).sum())} of {len(high)} modes "
        f"are more than {100.0 * TOO_HIGH:g} % too high, that of mode {worst + 1} by about "
        f'{100.0 * high[worst]:.2g} %; specimen.contact_points = "gauss" has them right'
    ]


def frequencies_too_high(oscillator: Oscillator, shapes: np.ndarray, closed: np.ndarray) -> np.ndarray:
    """(m,) by what share the frequency of each mode (m, n) is too high."""
    joints, stretches = oscillator.joints, oscillator.closed(closed)
    lacks, stiffness = lacking_flexibility(joints), np.column_stack([oscillator.normal, oscillator.shear])
    scaled = [stretches @ shape for shape in shapes]
    shares = [lacking_share(joints, lacks, stiffness, oscillator.forces(s), float(s @ s)) for s in scaled]
    return np.sqrt(1.0 + np.array(shares)) - 1.0
