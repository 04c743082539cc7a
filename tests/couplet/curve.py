"""The curve of a couplet in series with what gives way beside its joint."""

import numpy as np
from numpy.typing import ArrayLike

from verification.references.closed_forms import Floats, Joint, shear


def couplet(
    law: str, joint: Joint, displacement: ArrayLike, compression: float, compliance: float = 0.0, points: int = 20001
) -> Floats:
    """Shear stress (Pa) of a couplet whose top is moved by a displacement (m) under constant compression.

    compliance  m/Pa of all that gives way in series with the joint: displacement = slip + compliance * tau(slip).
    Raises ValueError where that snaps back: the curve then is no function of the displacement.
    """
    wanted = np.asarray(displacement, dtype=float)
    if compliance == 0.0:
        return shear(law, joint, wanted, compression)
    most = float(wanted.max())
    us0 = float(joint.peak(compression)) / joint.ks
    slip = np.unique(np.concatenate([np.linspace(0.0, most, points), [min(us0, most)]]))
    moved = slip + compliance * shear(law, joint, slip, compression)
    if np.any(np.diff(moved) <= 0.0):
        raise ValueError(f"law '{law}' at {compression:g} Pa snaps back in series with {compliance:g} m/Pa")
    return shear(law, joint, np.interp(wanted, moved, slip), compression)
