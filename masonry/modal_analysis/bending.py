"""How much stiffer closed joints bend by their contact points than by stresses spread over their areas."""

import numpy as np

from geometry.joints.second_moments import arms, lacking_flexibility
from masonry.modal_analysis.oscillator import Oscillator


def lacking_work(oscillator: Oscillator, lacks: np.ndarray, pull: np.ndarray) -> float:
    """J, twice: what moments would do besides at the turns that contact points keep joints from; pull (C,) N, and
    `lacking_flexibility` (J, 3, 3) of the joints."""
    joints, count = oscillator.joints, len(oscillator.joints.patch_start) - 1
    if not len(pull):
        return 0.0
    moment = np.stack([np.bincount(joints.patch, pull * along, count) for along in arms(joints).T], axis=1)
    stiffness = np.bincount(joints.patch, oscillator.normal, count) / np.bincount(joints.patch, joints.area, count)
    return max(float((np.einsum("ja,jab,jb->j", moment, lacks, moment) / stiffness).sum()), 0.0)


def frequencies_too_high(oscillator: Oscillator, shapes: np.ndarray, closed: np.ndarray) -> np.ndarray:
    """(m,) by what share the frequency of each mode (m, n) is too high for it, by Rayleigh's quotient."""
    off, lacks, stretches = [], lacking_flexibility(oscillator.joints), oscillator.closed(closed)
    for shape in shapes:
        scaled = stretches @ shape
        pull = scaled[: 3 * len(closed) : 3] * np.sqrt(oscillator.normal)
        more = lacking_work(oscillator, lacks, pull) / max(float(scaled @ scaled), 1e-300)
        off.append(np.sqrt(1.0 + more) - 1.0)
    return np.array(off)
