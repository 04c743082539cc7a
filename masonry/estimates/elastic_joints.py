"""How much stiffer closed joints bend and twist by their contact points than by stresses spread over their areas."""

import numpy as np

from geometry.blocks import Joints
from geometry.joints.faces.second_moments import Lacks


def bend_or_twist(error: float) -> str:
    """In words, of joints whose movement is too small by an error, or too large where it is below 0."""
    return f"bend or twist too {'stiffly' if error > 0.0 else 'softly'} by their contact points"


def lacking_share(joints: Joints, lacks: Lacks, stiffness: np.ndarray, force: np.ndarray, stored: float) -> float:
    """By how much more joints would move, over how far they do: work of their moments at the turns that contact points
    keep them from, over what they store, each twice.

    stiffness  (C, 2) N/m of the contacts, along and across their normals      force  (C, 3) N      stored  J, twice
    """
    if not len(force):
        return 0.0
    pull = np.einsum("ci,ci->c", joints.normal, force)
    moment, points = lacks.moments(joints.normal, pull, force - pull[:, None] * joints.normal), lacks.points
    none = (points.area <= 0.0).astype(float)  # polygons of a face whose number is that of another one
    normal, shear = ((column + none) / (points.area + none) for column in points.sums(stiffness).T)
    work = float(np.einsum("ja,jab,jb->j", moment, lacks.over(normal, shear), moment).sum())
    return max(work, 0.0) / max(stored, 1e-300)
