"""Lines of thrust in half an arch, by moments: the greatest load on its crown that one of them bears."""

import numpy as np
from scipy.optimize import linprog


def greatest_crown_load(weight: np.ndarray, out: np.ndarray, cap: float, inner: np.ndarray, outer: np.ndarray) -> float:
    """N on the crown of the half.

    weight, out   (n,) N and m: of the pieces from the springing to the crown, and how far out each acts; cap N, of what
                  is beyond the last joint, on the axis
    inner, outer  (n + 1, 2) m: x and z of the two ends of each joint, from the springing to the crown
    Found over the thrust and its height at the crown: about the inner end of a joint what is above must not turn in,
    about the outer end not out.
    """
    rows, most = [], []
    for k in range(len(inner)):
        for (x, z), sign in ((inner[k], 1.0), (outer[k], -1.0)):
            turns_in = (weight[k:] * (x - out[k:])).sum() + cap * x
            rows.append(sign * np.array([z, -1.0, x]))  # of the thrust, of its moment about the axis, of the load
            most.append(-sign * turns_in)
    optimum = linprog([0.0, 0.0, -1.0], A_ub=rows, b_ub=most, bounds=[(0, None), (None, None), (0, None)])
    return float(optimum.x[2])
