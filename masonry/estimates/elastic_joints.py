"""How much stiffer closed joints bend and twist by their contact points than by stresses spread over their areas."""

import numpy as np

from geometry.blocks import Joints
from geometry.joints.second_moments import Lacks


def lacking_work(joints: Joints, lacks: Lacks, stiffness: np.ndarray, force: np.ndarray) -> float:
    """J, twice: what moments would do besides at the turns that contact points keep joints from.

    stiffness  (C, 2) N/m of the contacts, along and across their normals      force  (C, 3) N
    """
    if not len(force):
        return 0.0
    pull = np.einsum("ci,ci->c", joints.normal, force)
    moment = lacks.moments(joints.normal, pull, force - pull[:, None] * joints.normal)
    face, count = lacks.face, len(lacks.whole)
    area = np.bincount(face, joints.area, count)
    none = (area <= 0.0).astype(float)  # polygons of a face whose number is that of another one
    normal, shear = ((np.bincount(face, values, count) + none) / (area + none) for values in stiffness.T)
    return max(float(np.einsum("ja,jab,jb->j", moment, lacks.over(normal, shear), moment).sum()), 0.0)
