"""How much stiffer closed joints bend by their contact points than by stresses spread over their areas."""

import numpy as np

from geometry.joints.second_moments import lacking_flexibility
from masonry.modal_analysis.oscillator import Oscillator


def lacking_work(oscillator: Oscillator, pull: np.ndarray) -> float:
    """J, twice: what moments would do besides at the turns that contact points keep joints from; pull (C,) N."""
    joints, count = oscillator.joints, len(oscillator.joints.patch_start) - 1
    if not len(pull):
        return 0.0
    moment = np.stack([np.bincount(joints.patch, pull * along, count) for along in _arms(oscillator).T], axis=1)
    stiffness = np.bincount(joints.patch, oscillator.normal, count) / np.bincount(joints.patch, joints.area, count)
    lacks = np.einsum("ja,jab,jb->j", moment, lacking_flexibility(joints), moment)
    return max(float((lacks / stiffness).sum()), 0.0)


def _arms(oscillator: Oscillator) -> np.ndarray:
    """(C, 3) m, from the middle of each joint face to its points."""
    joints, count = oscillator.joints, len(oscillator.joints.patch_start) - 1
    area = np.bincount(joints.patch, joints.area, count)
    middle = np.stack([np.bincount(joints.patch, joints.area * along, count) for along in joints.point.T], axis=1)
    return np.asarray(joints.point - (middle / area[:, None])[joints.patch])


def frequencies_too_high(oscillator: Oscillator, shapes: np.ndarray, closed: np.ndarray) -> np.ndarray:
    """(m,) by what share the frequency of each mode (m, n) is too high for it, by Rayleigh's quotient."""
    off = []
    for shape in shapes:
        scaled = oscillator.closed(closed) @ shape
        pull = scaled[: 3 * len(closed) : 3] * np.sqrt(oscillator.normal)
        off.append(np.sqrt(1.0 + lacking_work(oscillator, pull) / max(float(scaled @ scaled), 1e-300)) - 1.0)
    return np.array(off)
